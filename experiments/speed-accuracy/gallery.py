#!/usr/bin/env python3
"""Charts what accuracy costs by each method: ball, singlet, asphere, torus, prism and bunny as meshes of 1k to 1M
triangles. Writes gallery.csv and a chart of each, NAME.svg, beside this file. See README.md.

Usage: gallery.py [--sahl PROGRAM] [--most TRIANGLES] [NAME ...]

Models are made by `sahl export` from the exact shapes of NAME.toml, as glTF carries them, the torus by this script; the
bunny must have been fetched by models/fetch_bunny.py and is left out where it was not. Needs Python alone.
"""

import argparse
import csv
import json
import math
import struct
import subprocess
import sys
import tempfile
from array import array
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "models"))
from model_files import glb  # noqa: E402

SIZES = [1_000, 4_000, 16_000, 64_000, 250_000, 1_000_000]
COLOURS = {
    "facet": "#c2410c",
    "interpolated": "#0f766e",
    "quadratic": "#7c3aed",
    "fitted": "#1d4ed8",
    "recognised": "#a16207",
    "exact": "#222",
}
BEAMS = {  # of what has no exact shape
    "torus": 'beam = {from_mm = [6, 0, -10], toward = [0, 0, 1], radius_mm = 2, pattern = "hexagonal", rays = 20000}',
    "bunny": 'beam = {from_mm = [0, 50, -200], toward = [0, 0, 1], radius_mm = 20, pattern = "hexagonal", rays = 20000}',
}
RING, TUBE = 6e-3, 2.5e-3  # m, of the torus


def triangles_in(model):
    """How many triangles a .glb has."""
    data = model.read_bytes()
    tree = json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])
    indices = (p["indices"] for mesh in tree["meshes"] for p in mesh["primitives"])
    return sum(tree["accessors"][i]["count"] for i in indices) // 3


def torus(around, across):
    """Places, normals and corners, row by row."""
    places, normals, corners = [], [], array("I")
    for i in range(around):
        for j in range(across):
            u, v = 2 * math.pi * i / around, 2 * math.pi * j / across
            n = (math.cos(v) * math.cos(u), math.cos(v) * math.sin(u), math.sin(v))
            r = RING + TUBE * math.cos(v)
            places.append((r * math.cos(u), r * math.sin(u), TUBE * math.sin(v)))
            normals.append(n)
            here, beside = i * across + j, i * across + (j + 1) % across
            there = (i + 1) % around * across
            corners.extend((here, there + j, there + (j + 1) % across, here, there + (j + 1) % across, beside))
    return places, normals, corners


def write_torus_glb(file, triangles):
    across = max(8, round(math.sqrt(triangles / 2 * TUBE / RING)))
    places, normals, corners = torus(round(triangles / 2 / across), across)
    columns = [array("f", (x for v in values for x in v)) for values in (places, normals)]
    data = columns[0].tobytes() + columns[1].tobytes() + corners.tobytes()
    size = 12 * len(places)
    limits = {k: [f(columns[0][axis::3]) for axis in range(3)] for k, f in (("min", min), ("max", max))}
    vectors = {"componentType": 5126, "count": len(places), "type": "VEC3"}
    tree = {
        "asset": {"version": "2.0", "generator": "Sahl experiments/speed-accuracy/gallery.py"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "torus", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}],
        "accessors": [
            {**vectors, "bufferView": 0, **limits},
            {**vectors, "bufferView": 1},
            {"bufferView": 2, "componentType": 5125, "count": len(corners), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": size, "target": 34962},
            {"buffer": 0, "byteOffset": size, "byteLength": size, "target": 34962},
            {"buffer": 0, "byteOffset": 2 * size, "byteLength": 4 * len(corners), "target": 34963},
        ],
        "buffers": [{"byteLength": len(data)}],
    }
    file.write_bytes(glb(tree, data))


def write_torus_obj(file, around, across):
    """In millimetres and all digits of a double, for a truth beyond what floats carry."""
    places, normals, corners = torus(around, across)
    with open(file, "w") as out:
        out.writelines(f"v {1e3 * x!r} {1e3 * y!r} {1e3 * z!r}\n" for x, y, z in places)
        out.writelines(f"vn {x!r} {y!r} {z!r}\n" for x, y, z in normals)
        for t in range(0, len(corners), 3):
            out.write("f " + " ".join(f"{c + 1}//{c + 1}" for c in corners[t : t + 3]) + "\n")


class Gallery:
    def __init__(self, sahl, most, folder):
        self.sahl, self.most, self.folder, self.rows = sahl, most, Path(folder), []

    def run(self, *arguments):
        subprocess.run([self.sahl, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)

    def experiment(self, name, body, trace=""):
        """NAME.toml with another body, in the folder of models; torus and bunny are the ball's with another beam."""
        beam = BEAMS.get(name)
        lines = (HERE / f"{'ball' if beam else name}.toml").read_text().splitlines()
        lines = [body if line.startswith("shape =") else beam if beam and line.startswith("beam =") else line for line in lines]
        file = self.folder / "mesh.toml"
        file.write_text("\n".join(lines).replace("[trace]", f"[trace]\n{trace}") + "\n")
        return file

    def chart(self, name, model, exact):
        out = self.folder / "chart"
        self.run("chart", self.experiment(name, f'model = "{model}"'), *(["--exact", exact] if exact else []), "--out", out)
        chart = json.loads((out / "chart.json").read_text())
        for method in chart["methods"]:
            if name == "torus" and method["method"] == "exact":
                continue  # it is a finer mesh
            self.rows.append({"model": name, "triangles": triangles_in(Path(model)), **method})
            print(f"{name:8} {self.rows[-1]['triangles']:8} {method['method']:13} {method['ns_per_segment']:8.1f} ns"
                  f"  RMS on leaving {method['leaving_rms_rad']:.2e}  greatest {method['max_rad']:.2e} rad", flush=True)

    def shape(self, name):
        """As `sahl export` makes it of NAME.toml, finer and finer."""
        exact, model = HERE / f"{name}.toml", self.folder / f"{name}.glb"
        self.run("export", exact, "--to", model, "--fineness", 120)
        at_120, done = triangles_in(model), set()
        for size in (s for s in SIZES if s <= self.most):
            fineness = round(120 * math.sqrt(size / at_120))
            self.run("export", exact, "--to", model, "--fineness", min(max(6, fineness), 3000))
            if triangles_in(model) not in done:  # planes do not get finer
                self.chart(name, model, exact)
            done.add(triangles_in(model))

    def torus(self):
        truth = self.folder / "truth.obj"
        write_torus_obj(truth, 900, 360)
        exact = self.folder / "torus.toml"
        body = f'model = "{truth}"\nlength_unit = "mm"'
        exact.write_text(self.experiment("torus", body, 'method = "fitted"').read_text())
        for size in (s for s in SIZES if s <= self.most):
            write_torus_glb(self.folder / "torus.glb", size)
            self.chart("torus", self.folder / "torus.glb", exact)

    def bunny(self):
        model = ROOT / "models/bunny.glb"
        if model.exists():
            self.chart("bunny", model, None)
        else:
            print("bunny: left out; python3 models/fetch_bunny.py brings it")


def decades(values):
    values = [v for v in values if v > 0]
    return math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))


def draw(name, rows):
    """Error on leaving against time, both in powers of ten; a line a method, from few triangles to many."""
    left, top, width, height = 70, 36, 420, 330
    x0, x1 = decades(r["ns_per_segment"] for r in rows)
    y0, y1 = decades(r["leaving_rms_rad"] for r in rows if r["leaving_rms_rad"] > 1e-14) if any(
        r["leaving_rms_rad"] > 1e-14 for r in rows) else (-16, -15)

    def place(row):
        x = (math.log10(row["ns_per_segment"]) - x0) / (x1 - x0)
        y = (math.log10(max(row["leaving_rms_rad"], 10.0**y0)) - y0) / max(y1 - y0, 1)
        return left + width * x, top + height * (1 - y)

    parts = [
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 430" font-family="sans-serif" font-size="12">',
        '<rect width="640" height="430" fill="#fff"/>',
        f'<text x="{left}" y="22" font-size="14" font-weight="bold">{name}</text>',
        f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#999"/>',
    ]
    for e in range(x0, x1 + 1):
        x = left + width * (e - x0) / (x1 - x0)
        parts.append(f'<path d="M{x:.1f} {top}v{height}" stroke="#ddd"/>')
        parts.append(f'<text x="{x:.1f}" y="{top + height + 16}" text-anchor="middle">1e{e}</text>')
    for e in range(y0, y1 + 1):
        y = top + height * (1 - (e - y0) / max(y1 - y0, 1))
        parts.append(f'<path d="M{left} {y:.1f}h{width}" stroke="#ddd"/>')
        parts.append(f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">1e{e}</text>')
    below = f'x="{left + width / 2}" y="{top + height + 36}"'
    beside = f'transform="translate(18 {top + height / 2}) rotate(-90)"'
    for where, label in {below: "CPU nanoseconds per segment", beside: "error on leaving, RMS, rad"}.items():
        parts.append(f'<text {where} text-anchor="middle">{label}</text>')
    for number, (method, colour) in enumerate(COLOURS.items()):
        mine = [r for r in rows if r["method"] == method]
        if not mine:
            continue
        points = [place(r) for r in mine]
        line = "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        parts.append(f'<path d="M{line}" stroke="{colour}" fill="none"/>')
        for i, (x, y) in enumerate(points):
            parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{2 + 0.8 * i:.1f}" fill="{colour}" fill-opacity="0.7"/>')
        y = top + 14 + 18 * number
        parts.append(f'<rect x="{left + width + 14}" y="{y - 9}" width="10" height="10" fill="{colour}"/>')
        parts.append(f'<text x="{left + width + 30}" y="{y}">{method}</text>')
    sizes = sorted({r["triangles"] for r in rows})
    span = f"{sizes[0]} triangles" if len(sizes) == 1 else f"{sizes[0]} (small) to {sizes[-1]} triangles (large)"
    parts.append(f'<text x="{left}" y="{top + height + 54}" fill="#555">{span}; no error is drawn at the foot</text>')
    return "\n".join(parts + ["</svg>"]) + "\n"


def main():
    names = ["ball", "singlet", "asphere", "torus", "prism", "bunny"]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sahl", default=ROOT / "build/release/sahl")
    parser.add_argument("--most", type=int, default=SIZES[-1])
    parser.add_argument("--out", type=Path, default=HERE)
    parser.add_argument("names", nargs="*", default=names, metavar="NAME")
    arguments = parser.parse_args()
    if unknown := set(arguments.names) - set(names):
        parser.error(f"there is no {', '.join(unknown)}; there are {', '.join(names)}")
    with tempfile.TemporaryDirectory() as folder:
        gallery = Gallery(arguments.sahl, arguments.most, folder)
        for name in arguments.names:
            if name in ("torus", "bunny"):
                getattr(gallery, name)()
            else:
                gallery.shape(name)
    table = arguments.out / "gallery.csv"
    known = []
    if table.exists():  # of models that were not asked for
        with open(table) as file:
            known = [row for row in csv.DictReader(file) if row["model"] not in arguments.names]
    columns = ["model", "triangles", "method", "ns_per_segment", "leaving_rms_rad", "rms_rad", "max_rad", "sequence_changed"]
    with open(table, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(known)
        for row in gallery.rows:
            writer.writerow({k: f"{v:.4g}" if isinstance(v, float) else v for k, v in row.items()})
    for name in arguments.names:
        if rows := [r for r in gallery.rows if r["model"] == name]:
            (arguments.out / f"{name}.svg").write_text(draw(name, rows))


if __name__ == "__main__":
    main()
