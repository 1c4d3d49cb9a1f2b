#!/usr/bin/env python3
"""Runs experiments and cuts a drawing or a chart out of the report that the program writes, NAME/plot.svg, or takes a
picture of a detector, NAME/plot.png.

Usage: plot.py [--sahl PROGRAM] NAME...     PROGRAM: build/release/sahl where it is not given

Only what the report's style sheet says of drawings is kept, in its light colours. Needs Python alone.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent

# NAME: (a detector's picture, or one of the report's drawings by the beginning of its label; what to set, so that few
# rays are drawn)
PLOTS = {
    "aplanatic-ball": (
        "The scene seen from +x",
        ["source.fan.power_W=1", "source.lamp.power_W=1e-9", "source.lamp.point.rays=1", "trace.min_power=0.3"],
    ),
    "ball-lens": ("The scene seen from +y", ["source.fan.power_W=1", "source.beam.beam.rays=1", "trace.min_power=0.3"]),
    "brilliant": ("power (W) against object.pavilion", []),
    "bunny-in-a-bright-room": (
        "The scene seen from +z",
        [f"source.{wall}.lambertian.rays=6" for wall in ("left", "right", "bottom", "top", "back", "front")]
        + ["trace.branch=dominant", "trace.max_depth=12"],
    ),
    "cartesian-oval": (
        "The scene seen from −x",
        ["source.fan to the oval.power_W=1", "source.fan to the ellipsoid.power_W=1", "trace.min_power=0.3"]
        + ["source.point.point.rays=1", "source.point.power_W=1e-9", "source.beam.beam.rays=1"],
    ),
    "cassegrain": (
        "The scene seen from +y",
        ["source.fan.power_W=1", "source.star.beam.rays=1", "source.companion.beam.rays=1"],
    ),
    "cemented-doublet": (
        "The scene seen from −x",
        ["source.beam.beam.pattern=fan", "source.beam.beam.up=[0, 1, 0]", "source.beam.beam.rays=11"]
        + ["trace.min_power=0.5"],
    ),
    "clad-rod": ("power (W) against group.lamp", []),
    "concentrator": (
        "The scene seen from +y",
        ["sweep={}", "group.sun.turn_deg[1]=28", "source.sky.lambertian.rays=1"]
        + [f"object.{end} end.shape.rectangle.size_mm=[0.1, 0.1]" for end in ("near", "far")]
        + ["source.sunlight.beam.rays=31", "source.sunlight.beam.size_mm=[60, 0]", "source.sunlight.beam.pattern=grid"],
    ),
    "corner-cube": ("detectors/far away.png", []),
    "dove-prism": ("detectors/image.png", []),
    "fibre": ("power (W) against group.lamp", []),
    "light-pipe": (
        "The scene seen from −x",
        ["source.lamp.lambertian.rays=30", "trace.min_power=0.5", "source.ray.power_W=1e-9"],
    ),
    "mirror-caustic": ("The scene seen from −y", []),
    "pellin-broca": ("The scene seen from +z", ["trace.min_power=0.1", "source.lamp.beam.rays=1"]),
    "penta-prism": ("The scene seen from +z", ["sweep={}", "trace.min_power=0.1"]),
    "prism-minimum-deviation": (
        "The scene seen from +z",
        ["sweep={}", "source.laser.beam.rays=1", "source.laser.beam.radius_mm=0", "trace.min_power=0.1"],
    ),
    "roof-prism": ("runs/000/detectors/far away.png", []),
}
CLASSES = "middle end halo grid axis body sheet detector rays source curve dot cell w[0-9]+".split()
DRAWN = re.compile(rf":root|svg|line|\.({'|'.join(CLASSES)})\b")


def light_rules(page):
    """The rules that concern drawings, without those for dark pages."""
    style = "".join(re.findall(r"<style>(.*?)</style>", page, re.DOTALL)).replace("color-scheme:light dark;", "")
    style = re.sub(r"@media[^{]*\{(?:[^{}]*\{[^{}]*\})*\s*\}", "", style)
    rules = [rule.strip() for rule in re.findall(r"[^{}]+\{[^{}]*\}", style)]
    return "\n".join(rule for rule in rules if DRAWN.match(rule))


def plot(page, label):
    found = re.search(rf'<svg([^>]*)aria-label="({re.escape(label)}[^"]*)">(.*?)</svg>', page, re.DOTALL)
    if not found:
        sys.exit(f"the report has no drawing whose label begins with: {label}")
    drawing = re.sub("<style>.*?</style>", "", found.group(3), flags=re.DOTALL)
    size = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', found.group(1)).groups()
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size[0]}" height="{size[1]}"{found.group(1)}'
        f'aria-label="{found.group(2)}">\n<style>{light_rules(page)}\nsvg{{font-family:sans-serif}}</style>\n'
        f'<rect width="100%" height="100%" fill="#fff"/>{drawing}</svg>\n'
    )


def main():
    names = sys.argv[1:]
    sahl = HERE.parent / "build" / "release" / "sahl"
    if names[:1] == ["--sahl"]:
        sahl, names = names[1], names[2:]
    if not names or any(name not in PLOTS for name in names):
        sys.exit(f"{__doc__}\nNAME: {', '.join(PLOTS)}")
    for name in names:
        what, settings = PLOTS[name]
        with tempfile.TemporaryDirectory() as scratch:
            command = [sahl, "trace", HERE / name / f"{name}.toml", "--out", f"{scratch}/out", "--quiet"]
            subprocess.run(command + [f"--set={s}" for s in settings], check=True)
            out = Path(scratch) / "out"
            if what.endswith(".png"):
                (HERE / name / "plot.png").write_bytes((out / what).read_bytes())
            else:
                (HERE / name / "plot.svg").write_text(plot((out / "report.html").read_text(), what))


if __name__ == "__main__":
    main()
