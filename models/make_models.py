#!/usr/bin/env python3
"""Writes the models of this folder but for the bunny: balls, biconvex lenses, prisms, light guides, a wine glass. See README.md.

Usage: make_models.py [--check]     --check compares with the files that are there, and writes nothing

Positions and normals are computed in double from the exact surface and rounded once to the floats of glTF. Each place
is computed once and shared, so that surfaces are closed when equal positions are welded. Needs Python alone.
"""

import math
import sys
from pathlib import Path

import polyhedra
from glassware import wine_glass
from light_guides import bent_guide, box
from model_files import INDEX, Body, Face, document, glb, gltf, obj, unit

FOLDER = Path(__file__).resolve().parent
MM = 1e-3  # glTF is in metres


def ball(radius, subdivisions):
    """An icosahedron, each triangle split in four `subdivisions` times, pushed out to the sphere."""
    golden = (1 + math.sqrt(5)) / 2
    corners = [(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0)]
    corners += [(z, x, y) for x, y, z in corners] + [(y, z, x) for x, y, z in corners]
    points = [unit(p) for p in corners]

    def is_face(a, b, c):
        edges = ((a, b), (b, c), (c, a))
        return all(sum(x * y for x, y in zip(points[i], points[j])) > 0.4 for i, j in edges)  # neighbours: 1/√5

    def outwards(a, b, c):
        u, v = ([q - p for p, q in zip(points[a], points[i])] for i in (b, c))
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        return (a, b, c) if sum(x * y for x, y in zip(n, points[a])) > 0 else (a, c, b)

    triangles = [outwards(a, b, c) for a in range(12) for b in range(a) for c in range(b) if is_face(a, b, c)]
    for _ in range(subdivisions):
        middles, split = {}, []

        def middle(a, b):
            edge = (min(a, b), max(a, b))
            if edge not in middles:
                middles[edge] = len(points)
                points.append(unit([x + y for x, y in zip(points[edge[0]], points[edge[1]])]))
            return middles[edge]

        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            split += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = split
    face = Face("surface")
    for p in points:
        face.vertex([radius * x for x in p], p)
    face.triangles = triangles
    return [face]


def disc_of_rings(rings):
    """A hexagon's rings: ring k has 6k points. Returns (share of the radius, angle) of each, and the triangles."""
    points = [(0.0, 0.0)] + [
        (k / rings, 2 * math.pi * j / (6 * k)) for k in range(1, rings + 1) for j in range(6 * k)
    ]

    def number(k, j):
        return 0 if k == 0 else 1 + 3 * k * (k - 1) + j % (6 * k)

    triangles = []
    for k in range(1, rings + 1):
        for sector in range(6):
            for j in range(k):
                outer, inner = sector * k + j, sector * (k - 1) + j
                triangles.append((number(k, outer), number(k, outer + 1), number(k - 1, inner)))
                if j > 0:
                    triangles.append((number(k, outer), number(k - 1, inner), number(k - 1, inner - 1)))
    return points, triangles


def biconvex_lens(radius, thickness, diameter, rings):
    """Both radii alike; the first vertex at the origin, the axis along +z; a cylinder at the edge."""
    points, triangles = disc_of_rings(rings)
    half = diameter / 2
    front, back, edge = Face("front"), Face("back"), Face("edge")
    for share, angle in points:
        x, y = half * share * math.cos(angle), half * share * math.sin(angle)
        r2 = x * x + y * y
        sag = r2 / (radius + math.sqrt(radius * radius - r2))
        front.vertex((x, y, sag), (x / radius, y / radius, (sag - radius) / radius))
        back.vertex((x, y, thickness - sag), (x / radius, y / radius, (radius - sag) / radius))
    front.triangles = [(a, c, b) for a, b, c in triangles]
    back.triangles = triangles
    rim = range(len(points) - 6 * rings, len(points))
    for i in rim:
        normal = (math.cos(points[i][1]), math.sin(points[i][1]), 0.0)
        edge.vertex(front.positions[i], normal)
        edge.vertex(back.positions[i], normal)
    for j in range(6 * rings):
        a, b = 2 * j, 2 * ((j + 1) % (6 * rings))
        edge.triangles += [(a, b, b + 1), (a, b + 1, a + 1)]
    return [front, back, edge]


def prism(apex, side, length):
    """Two faces of `side` meet at the apex edge, along z at the top; centred by its bounding box."""
    width, height = 2 * side * math.sin(apex / 2), side * math.cos(apex / 2)
    left, right, top = (-width / 2, -height / 2), (width / 2, -height / 2), (0.0, height / 2)
    c, s, z = math.cos(apex / 2), math.sin(apex / 2), length / 2

    def flat(name, normal, corners):
        face = Face(name)
        for corner in corners:
            face.vertex(corner, normal)
        face.triangles = [(0, i, i + 1) for i in range(1, len(corners) - 1)]
        return face

    def wall(name, normal, a, b):  # from a to b counter-clockwise seen from +z
        return flat(name, normal, [(*a, -z), (*b, -z), (*b, z), (*a, z)])

    return [
        wall("left", (-c, s, 0.0), top, left),
        wall("right", (c, s, 0.0), right, top),
        wall("base", (0.0, -1.0, 0.0), left, right),
        flat("near", (0.0, 0.0, -1.0), [(*left, -z), (*top, -z), (*right, -z)]),
        flat("far", (0.0, 0.0, 1.0), [(*left, z), (*right, z), (*top, z)]),
    ]


def models():
    """File name → bytes."""
    files = {}
    for subdivisions in (2, 3, 4, 5):
        name = f"ball-{20 * 4**subdivisions}"
        files[name + ".glb"] = glb(*document([Body(name, ball(5 * MM, subdivisions), 10 * MM)]))
    for rings in (6, 12, 18, 36):
        name = f"singlet-{12 * rings * (rings + 1)}"
        files[name + ".glb"] = glb(*document([Body(name, biconvex_lens(50 * MM, 10 * MM, 30 * MM, rings), 10 * MM)]))
    files["prism.gltf"] = gltf(*document([Body("prism", prism(math.radians(60), 25 * MM, 25 * MM), 25 * MM)]))
    core = Body("core", box("core", 5 * MM, 100 * MM), 5 * MM, 1.492)
    cladding = Body("cladding", box("cladding", 7 * MM, 100 * MM), 7 * MM, 1.402)
    files["clad-rod.gltf"] = gltf(*document([cladding, core]))
    guide = Body("bent-guide", bent_guide(5 * MM, 10 * MM, 10 * MM, 64), 5 * MM)
    files["bent-guide.glb"] = glb(*document([guide]))
    files["bent-guide.obj"], files["bent-guide.mtl"] = obj(guide, "bent-guide.mtl")
    files["wine-glass.glb"] = glb(*document(wine_glass()))
    files[polyhedra.LIBRARY] = polyhedra.library(INDEX)
    files["dove.obj"] = polyhedra.obj("dove", polyhedra.dove(42.6, 10.0760411697982, 12))
    files["pellin-broca.obj"] = polyhedra.obj("pellin-broca", polyhedra.pellin_broca(40, 16.7, 20))
    files["penta.obj"] = polyhedra.obj("penta", polyhedra.penta(20, 20), ("first", "second"))
    files["roof.obj"] = polyhedra.obj("roof", polyhedra.roof(20))
    crown = polyhedra.brilliant_crown(3.25, 0.53, math.tan(math.radians(34.5)), 0.05)
    files["brilliant-crown.obj"] = polyhedra.obj("crown", crown)
    files["brilliant-pavilion.obj"] = polyhedra.obj("pavilion", polyhedra.brilliant_pavilion(3.25, 0.77, 0.05))
    return files


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    differ = []
    for name, data in models().items():
        path = FOLDER / name
        if not sys.argv[1:]:
            path.write_bytes(data)
        elif not path.exists() or path.read_bytes() != data:
            differ.append(name)
    if differ:
        sys.exit("these differ from what the script makes; run it without --check: " + ", ".join(differ))


if __name__ == "__main__":
    main()
