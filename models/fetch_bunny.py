#!/usr/bin/env python3
"""Fetches the Stanford bunny (npm package `bunny`) and writes bunny.glb and bunny.obj beside this file. See README.md.

Usage: fetch_bunny.py [PACKAGE.tgz]     PACKAGE.tgz: the package where it is at hand already; otherwise npm is asked

One unit of the package is taken as 1 cm: the bunny stands 97 mm high. OBJ keeps the package's own numbers (give it
length_unit = "cm"), glTF is in metres and has a normal at each vertex. Needs Python, and npm for the fetching.
"""

import base64
import hashlib
import json
import math
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

from model_files import Body, Face, document, glb

FOLDER = Path(__file__).resolve().parent
PACKAGE = "bunny@1.0.1"
SHA512 = "KsMt755E0AVYjeUnQeOPtVNGuDLiWjJ6VIoyywLmVx5R6QliuL5AS0X/gi+ORDDlBZfOaDBAqdqCv5XAlF9tCQ=="
CENTIMETRE = 1e-2  # glTF is in metres
CREDIT = "Stanford Computer Graphics Laboratory (scan); npm package bunny 1.0.1, declared public domain"


def fetch(folder):
    """The package's file, by the npm client."""
    if not shutil.which("npm"):
        sys.exit("fetch_bunny.py: npm is not here. Install it, or name the package's file: fetch_bunny.py FILE.tgz")
    command = ["npm", "pack", PACKAGE, "--silent", "--pack-destination", str(folder)]
    try:
        subprocess.run(command, check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, timeout=120)
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired):
        sys.exit(f"fetch_bunny.py: npm did not bring {PACKAGE}; is there a network? Nothing was written")
    return next(folder.glob("*.tgz"))


def read(package):
    """Positions and triangles, as the package has them."""
    if not package.is_file():
        sys.exit(f"fetch_bunny.py: {package} is not a file. Nothing was written")
    if base64.b64encode(hashlib.sha512(package.read_bytes()).digest()).decode() != SHA512:
        sys.exit(f"fetch_bunny.py: {package} is not the package {PACKAGE}: its SHA-512 differs. Nothing was written")
    with tarfile.open(package) as archive:
        text = archive.extractfile("package/index.js").read().decode()

    def table(key):
        return json.loads(re.search(rf"exports\.{key}\s*=\s*(\[.*?\]\])", text, re.S)[1])

    return table("positions"), table("cells")


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def vertex_normals(positions, cells):
    """Σ (e1 × e2) / (|e1|² |e2|²) over the corners at a vertex, unit vectors (N. Max, J. Graphics Tools 4 (1999) 1)."""
    sums = [[0.0] * 3 for _ in positions]
    for cell in cells:
        for i in range(3):
            at, after, before = (cell[(i + k) % 3] for k in range(3))
            e1, e2 = minus(positions[after], positions[at]), minus(positions[before], positions[at])
            weight = 1.0 / (dot(e1, e1) * dot(e2, e2))
            sums[at] = [s + weight * x for s, x in zip(sums[at], cross(e1, e2))]
    return [[x / math.sqrt(dot(s, s)) for x in s] for s in sums]


def inspect(positions, cells):
    """Edges that have not exactly one triangle on each side, and the volume, in the package's units."""
    edges = {}
    for cell in cells:
        for i in range(3):
            edge = (cell[i], cell[(i + 1) % 3])
            edges[edge] = edges.get(edge, 0) + 1
    bad = sum(count != 1 or edges.get((b, a)) != 1 for (a, b), count in edges.items())
    volume = sum(dot(positions[a], cross(positions[b], positions[c])) for a, b, c in cells) / 6
    return bad, volume


def as_obj(positions, cells):
    lines = [f"# The Stanford bunny. {CREDIT}", "# Give it length_unit = \"cm\"", "g bunny"]
    lines += ["v " + " ".join(map(repr, p)) for p in positions]
    lines += ["f " + " ".join(str(i + 1) for i in cell) for cell in cells]
    return ("\n".join(lines) + "\n").encode()


def as_glb(positions, cells):
    face = Face("bunny")
    for position, normal in zip(positions, vertex_normals(positions, cells)):
        face.vertex([CENTIMETRE * x for x in position], normal)
    face.triangles = cells
    body = Body("bunny", [face], 10 * CENTIMETRE)
    return glb(*document([body], copyright=CREDIT, generator="Sahl models/fetch_bunny.py"))


def main():
    arguments = sys.argv[1:]
    if len(arguments) > 1 or arguments and arguments[0].startswith("-"):
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        positions, cells = read(Path(arguments[0]) if arguments else fetch(Path(folder)))
    bad, volume = inspect(positions, cells)
    for name, data in {"bunny.obj": as_obj(positions, cells), "bunny.glb": as_glb(positions, cells)}.items():
        (FOLDER / name).write_bytes(data)
    closed = "closed" if bad == 0 else f"not closed: {bad} edges without exactly one neighbour"
    print(f"bunny.obj, bunny.glb: {len(cells)} triangles, {closed}; {volume:.3f} cm³ if one unit is 1 cm")


if __name__ == "__main__":
    main()
