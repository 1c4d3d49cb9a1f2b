#!/usr/bin/env python3
"""Traces mesh-lens.toml with the lens at four finenesses and by each method; prints a table and draws convergence.svg.

Usage: convergence.py [SAHL]     SAHL: the program; build/release/sahl where it is not given

The two beams have the same rays in the same order, so that ray i of the one meets the exact lens where ray i of the
other meets the mesh: the angle between the two as they leave is the mesh's error. Needs Python alone.
"""

import csv
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
RINGS = {6: "singlet-504", 12: "singlet-1872", 18: "singlet-4104", 36: "singlet-15984"}
METHODS = {"facet": "#c2410c", "interpolated": "#0f766e"}
RADIUS, HALF_DIAMETER, INDEX = 50.0, 15.0, 1.5168  # mm


def trace(sahl, model, method):
    """RMS angle between the two lenses' rays, and how far apart their focal spots' RMS radii are in mm."""
    with tempfile.TemporaryDirectory() as out:
        settings = [f"object.mesh lens.model={ROOT}/models/{model}.glb", "trace.log=true", "trace.min_power=0.5"]
        command = [sahl, "trace", HERE / "mesh-lens.toml", "--out", out, "--method", method, "--quiet"]
        subprocess.run(command + [f"--set={s}" for s in settings], check=True)
        subprocess.run([sahl, "export", out, "--to", f"{out}/paths.csv"], check=True, stdout=subprocess.DEVNULL)
        last = {}  # of each ray, the last direction: with this min_power none but the direct path is left
        with open(f"{out}/paths.csv") as file:
            for row in csv.DictReader(file):
                if row["ended"] == "detected":
                    last[int(row["ray"])] = [float(row[axis]) for axis in ("dx", "dy", "dz")]
        detectors = json.loads(Path(out, "summary.json").read_text())["detectors"]
    exact, mesh = (detectors[f"focus of the {which} lens"] for which in ("exact", "mesh"))
    half = len(last) // 2
    squares = [sum((a - b) ** 2 for a, b in zip(last[i], last[i + half])) for i in range(half)]
    return math.sqrt(sum(squares) / half), abs(exact["rms_radius_mm"] - mesh["rms_radius_mm"])


def estimate(method, h):
    """What README.md derives for triangles with edges of h mm, in rad."""
    if method == "facet":
        return (INDEX - 1) * h / (math.sqrt(6) * RADIUS)
    beam = 10 / math.sqrt(2)  # RMS height in a round beam of 10 mm radius
    return 2 * (INDEX - 1) * beam / RADIUS**2 * h**2 / (8 * RADIUS)


def draw(sizes, errors):
    """Both axes logarithmic; beside the points the estimates of README.md."""
    low, high = -6.0, -1.0
    left, top, width, height = 90, 20, 420, 330

    def x(h):
        return left + width * (math.log10(h) + 0.5) / 1.0

    def y(e):
        return top + height * (high - math.log10(e)) / (high - low)

    parts = [
        '<svg xmlns="http://www.w3.org/2000/svg" width="640" height="410" font-family="sans-serif" font-size="13">',
        '<rect width="640" height="410" fill="white"/>',
        f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#999"/>',
    ]
    for e in range(int(low), int(high) + 1):
        parts.append(f'<path d="M{left} {y(10.0**e):.1f}h{width}" stroke="#ddd"/>')
        parts.append(f'<text x="{left - 8}" y="{y(10.0**e) + 4:.1f}" text-anchor="end">1e{e}</text>')
    for h in (0.5, 1.0, 2.0):
        parts.append(f'<path d="M{x(h):.1f} {top}v{height}" stroke="#ddd"/>')
        parts.append(f'<text x="{x(h):.1f}" y="{top + height + 18}" text-anchor="middle">{h:g}</text>')
    below = f'x="{left + width / 2}" y="{top + height + 40}"'
    beside = f'transform="translate(22 {top + height / 2}) rotate(-90)"'
    for place, label in {below: "edge of a triangle, mm", beside: "RMS error of direction, rad"}.items():
        parts.append(f'<text {place} text-anchor="middle">{label}</text>')
    for method, colour in METHODS.items():
        line = "L".join(f"{x(h):.1f} {y(estimate(method, h)):.1f}" for h in (sizes[-1], sizes[0]))
        parts.append(f'<path d="M{line}" stroke="{colour}" stroke-dasharray="4 4" fill="none"/>')
        for h, e in zip(sizes, errors[method]):
            parts.append(f'<circle cx="{x(h):.1f}" cy="{y(e):.1f}" r="4" fill="{colour}"/>')
        place = f'x="{x(sizes[1]):.1f}" y="{y(errors[method][1]) - 16:.1f}" text-anchor="end"'
        parts.append(f'<text {place} fill="{colour}">{method}</text>')
    return "\n".join(parts + ["</svg>"]) + "\n"


def main():
    sahl = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/sahl"
    sizes = [HALF_DIAMETER / rings for rings in RINGS]
    errors = {}
    print("method        edge mm  RMS error rad  estimate  order  error of the spot's RMS radius mm")
    for method in METHODS:
        errors[method] = []
        for size, model in zip(sizes, RINGS.values()):
            error, spot = trace(sahl, model, method)
            order = "    -"
            if errors[method]:
                coarser = sizes[len(errors[method]) - 1]
                order = f"{math.log(errors[method][-1] / error) / math.log(coarser / size):5.2f}"
            errors[method].append(error)
            print(f"{method:12}  {size:7.4f}  {error:13.2e}  {estimate(method, size):8.1e}  {order}  {spot:.1e}")
    (HERE / "convergence.svg").write_text(draw(sizes, errors))


if __name__ == "__main__":
    main()
