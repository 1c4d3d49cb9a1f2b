"""Writes an experiment of Sahl as a scene of POV-Ray that means the same, as far as POV-Ray can.

Spheres, rectangles, planes and OBJ meshes; glass of one index; paint, its checker too; lamps at points; a background of
one colour. What it does not know is refused. Colours are linear in both; lengths stay in millimetres.
"""

import math
import sys

import numpy as np

import meshes


def vector(v):
    return "<" + ",".join("%.12g" % x for x in v) + ">"


def unit(v):
    return np.asarray(v, float) / np.linalg.norm(v)


def placed(entry):
    """POV-Ray's matrix for scale, then turns about x, y and z, then a move."""
    scale = entry.get("scale", 1.0)
    linear = np.diag([scale] * 3 if isinstance(scale, (int, float)) else scale).astype(float)
    for axis, degrees in enumerate(entry.get("turn_deg", [0, 0, 0])):
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        turn = np.eye(3)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn[i, i], turn[j, j], turn[i, j], turn[j, i] = c, c, -s, s
        linear = turn @ linear
    move = entry.get("move_mm", [0, 0, 0])
    return "matrix <" + ",".join("%.12g" % x for x in [*linear.T.reshape(-1), *move]) + ">"


def camera(c):
    width, height = c.get("resolution", [640, 480])
    forward = unit(np.subtract(c["look_at_mm"], c["at_mm"]))
    right = unit(np.cross(forward, c.get("up", [0, 1, 0])))
    up = np.cross(right, forward)
    distance = 0.5 / math.tan(math.radians(c.get("fov_deg", 35)) / 2)
    return (
        f"camera {{ perspective location {vector(c['at_mm'])} direction {vector(distance * forward)} "
        f"right {vector(width / height * right)} up {vector(up)} }}\n"
    )


def glass(index):
    """Fresnel's mean of s and p, and what is not reflected goes through."""
    return (
        "pigment { rgbf 1 } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel on } conserve_energy } "
        f"interior {{ ior {index:.12g} }}"
    )


def paint(p):
    """POV-Ray multiplies all by the pigment, and its `diffuse` is one number."""
    diffuse, ambient = np.array(p.get("diffuse", [0, 0, 0]), float), np.array(p.get("ambient", [0, 0, 0]), float)
    lit = diffuse.max() > 0
    pigment = diffuse if lit else np.ones(3)
    if (pigment == 0).any():
        sys.exit("pov_scene.py: a diffuse colour with a 0 in it cannot be divided by")
    finish = f"ambient rgb {vector(ambient / pigment)} diffuse {int(lit)}"
    if max(p.get("specular", [0])) > 0:
        finish += f" phong {max(p['specular'])} phong_size {p.get('shininess', 1)}"
    if p.get("reflect", 0) > 0:
        finish += f" reflection {p['reflect']}"
    colour = f"rgb {vector(pigment)}"
    if "checker" in p:
        other = pigment * np.array(p["checker"].get("other", [0, 0, 0]))
        # a face between two cubes shows the one below it, as in Sahl
        colour = f"checker {colour}, rgb {vector(other)} scale {p['checker']['size_mm']} translate 1e-4*z"
    return f"pigment {{ {colour} }} finish {{ {finish} }}"


def index_of(medium, named):
    medium = named.get(medium, medium) if isinstance(medium, str) else medium
    if not isinstance(medium, dict) or "n" not in medium:
        sys.exit(f"pov_scene.py: the medium {medium} is not one of a single index n")
    return medium["n"]


def shape(entry, folder):
    (kind, sizes), = entry["shape"].items() if "shape" in entry else [("model", None)]
    if kind == "sphere":
        return f"sphere {{ 0, {sizes['radius_mm']:.12g} "
    if kind == "plane":
        return "plane { z, 0 "
    if kind == "rectangle":
        x, y = (s / 2 for s in sizes["size_mm"])
        corners = [(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0), (-x, -y, 0)]
        return "polygon { 5, " + ", ".join(map(vector, corners)) + " "
    if kind == "model":
        return meshes.pov_mesh(*read_mesh(folder / entry["model"]))
    sys.exit(f"pov_scene.py: there is no {kind} here")


def read_mesh(path):
    """As meshes.write_obj wrote it."""
    tables = {"v": [], "vn": [], "f": []}
    for line in open(path):
        key, *words = line.split()
        if key in tables:
            tables[key].append([int(w.split("/")[0]) - 1 if key == "f" else float(w) for w in words])
    return np.array(tables["v"]), np.array(tables["vn"]), np.array(tables["f"])


def scene(experiment, folder):
    """The text of the scene. Shadows are hard: a body of glass gets a black twin that only shadows see."""
    trace, named, surfaces = experiment["trace"], experiment.get("medium", {}), experiment.get("surface", {})
    text = "#version 3.7;\nglobal_settings { assumed_gamma 1 ambient_light rgb 1 "
    text += f"max_trace_level {trace['max_depth']} adc_bailout {trace['min_power']} }}\n" + camera(experiment["camera"])
    text += f"background {{ rgb {vector(experiment['background']['color'])} }}\n"
    for light in experiment.get("light", []):
        text += f"light_source {{ {vector(light['point']['at_mm'])}, rgb {vector(light.get('intensity', [1, 1, 1]))} }}\n"
    for entry in experiment["object"]:
        body, place = shape(entry, folder), placed(entry)
        if "surface" in entry:
            kind = surfaces[entry["surface"]]
            look = paint(kind["paint"] if "paint" in kind else {"reflect": kind["reflect"]})
        else:
            look = glass(index_of(entry["medium"], named))
            if experiment.get("light"):
                text += f"{body} pigment {{ rgb 0 }} no_image no_reflection {place} }}\n"
        text += f"{body} {look} {place} }}\n"
    return text
