#!/usr/bin/env python3
"""Traces achromat.toml at many wavelengths, one ray for each, and draws plot.svg: where it crosses the axis.

Usage: colour.py [SAHL]     SAHL: the program; build/release/sahl where it is not given. Needs Python alone.
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
BACK = 8.5  # mm, of the last vertex of either lens
LENSES = {"doublet": (0.0, 95.9519105047974468), "single lens": (-40.0, 96.0442972116331831)}  # axis, focus of d; mm
CURVES = {"single lens": "#c2410c", "doublet": "#0f766e"}
RAY = 7.0  # mm, from the axis: the zone that stands for a beam of 10 mm
WAVELENGTHS = list(range(420, 721, 10))  # nm
LEFT, TOP, WIDTH, HEIGHT = 90, 20, 420, 330
LOW, HIGH = -3.0, 1.0  # mm


def crossings(sahl, lens):
    """mm from the last vertex, for each wavelength."""
    axis = LENSES[lens][0]
    beam = f"source.light for the {lens}.beam"
    settings = ["trace.log=true", f"{beam}.from_mm=[0, {axis + RAY}, -10]", f"{beam}.radius_mm=0", f"{beam}.rays=1"]
    settings += [f"source.light for the {lens}.wavelengths_nm={WAVELENGTHS}"]
    with tempfile.TemporaryDirectory() as out:
        command = [sahl, "trace", HERE / "achromat.toml", "--out", out, "--quiet"]
        subprocess.run(command + [f"--set={s}" for s in settings], check=True)
        subprocess.run([sahl, "export", out, "--to", f"{out}/paths.csv"], check=True, stdout=subprocess.DEVNULL)
        found = {}  # of each wavelength the strongest arrival: light that went straight through
        with open(f"{out}/paths.csv") as file:
            for row in csv.DictReader(file):
                x = {key: float(row[key]) for key in ("wavelength_nm", "power_start_W", "y_mm", "z_mm", "dy", "dz")}
                if row["ended"] == "detected" and abs(x["y_mm"] - axis) < 13 and abs(x["dy"]) > 0:
                    at = x["z_mm"] - (x["y_mm"] - axis) * x["dz"] / x["dy"] - BACK
                    found.setdefault(x["wavelength_nm"], []).append((x["power_start_W"], at))
    return [max(found[float(w)])[1] for w in WAVELENGTHS]


def draw(curves):
    def x(nm):
        return LEFT + WIDTH * (nm - WAVELENGTHS[0]) / (WAVELENGTHS[-1] - WAVELENGTHS[0])

    def y(mm):
        return TOP + HEIGHT * (HIGH - mm) / (HIGH - LOW)

    parts = [
        '<svg xmlns="http://www.w3.org/2000/svg" width="640" height="410" font-family="sans-serif" font-size="13">',
        '<rect width="640" height="410" fill="white"/>',
        f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#999"/>',
    ]
    for mm in (-3, -2, -1, 0, 1):
        parts.append(f'<path d="M{LEFT} {y(mm):.1f}h{WIDTH}" stroke="#ddd"/>')
        parts.append(f'<text x="{LEFT - 8}" y="{y(mm) + 4:.1f}" text-anchor="end">{mm}</text>')
    for nm in range(450, 701, 50):
        parts.append(f'<path d="M{x(nm):.1f} {TOP}v{HEIGHT}" stroke="#ddd"/>')
        parts.append(f'<text x="{x(nm):.1f}" y="{TOP + HEIGHT + 18}" text-anchor="middle">{nm}</text>')
    below = f'x="{LEFT + WIDTH / 2}" y="{TOP + HEIGHT + 40}"'
    beside = f'transform="translate(30 {TOP + HEIGHT / 2}) rotate(-90)"'
    for place, label in {below: "wavelength, nm", beside: "from the paraxial focus of d, mm"}.items():
        parts.append(f'<text {place} text-anchor="middle">{label}</text>')
    for (name, colour), shifts in zip(CURVES.items(), curves):
        line = "L".join(f"{x(nm):.1f} {y(mm):.1f}" for nm, mm in zip(WAVELENGTHS, shifts))
        parts.append(f'<path d="M{line}" stroke="{colour}" fill="none" stroke-width="1.8"/>')
        parts.append(f'<text x="{LEFT + WIDTH + 8}" y="{y(shifts[-1]) + 4:.1f}" fill="{colour}">{name}</text>')
    return "\n".join(parts + ["</svg>"]) + "\n"


def main():
    sahl = sys.argv[1] if len(sys.argv) > 1 else HERE.parent.parent / "build" / "release" / "sahl"
    curves = []
    for name in CURVES:
        curves.append([at - LENSES[name][1] for at in crossings(sahl, name)])
        print(name, " ".join(f"{shift:.3f}" for shift in curves[-1]))
    (HERE / "plot.svg").write_text(draw(curves))


if __name__ == "__main__":
    main()
