#!/usr/bin/env python3
"""Renders the scenes of this folder by Sahl and by POV-Ray, compares the pictures and times the rendering.

Usage: judge.py [--program FILE] [--runs N] [--threads N] [NAME...]     NAME: knot, spheres

Times are of rendering alone: parsing, building and writing are in neither. Runs alternate; medians are given. Needs
POV-Ray 3.7 (Debian's povray), python3-numpy and Pillow. See README.md.
"""

import argparse
import json
import re
import shutil
import statistics
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
from PIL import Image

import meshes
import pov_scene

FOLDER = Path(__file__).resolve().parent
TOLERANCE = 3  # of 255: each program rounds to 8 bits, after sums in single precision


def sahl(program, name, threads, out):
    picture = out / f"{name}-sahl.png"
    command = [program, "render", FOLDER / f"{name}.toml", "--out", picture, "--threads", str(threads), "--json", "--quiet"]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    summary = json.loads(done.stdout)
    return picture, summary["seconds"], summary["segments"] + summary["cut"]


def povray(name, size, threads, out):
    picture = out / f"{name}-povray.png"
    command = ["povray", f"+I{out / name}.pov", f"+O{picture}", f"+W{size[0]}", f"+H{size[1]}", f"+WT{threads}"]
    command += ["-D", "-A", "-V", "+FN8", "File_Gamma=srgb"]
    text = subprocess.run(command, capture_output=True, text=True).stderr
    numbers = lambda pattern: [float(n) for n in re.findall(pattern, text)]
    seconds = numbers(r"Trace Time:.*?\(([\d.]+) seconds\)")
    rays = numbers(r"(?m)^Rays:\s+(\d+)")
    if not seconds or not rays:
        sys.exit(text)
    return picture, seconds[-1], rays[-1]


def differences(first, second):
    a, b = (np.asarray(Image.open(p).convert("RGB")).astype(int) for p in (first, second))
    return np.abs(a - b).max(2)


def judge(name, arguments, out):
    experiment = tomllib.loads((FOLDER / f"{name}.toml").read_text())
    (out / f"{name}.pov").write_text(pov_scene.scene(experiment, FOLDER))
    size = experiment["camera"]["resolution"]
    times = {"sahl": [], "povray": []}
    for _ in range(arguments.runs):
        ours, seconds, segments = sahl(arguments.program, name, arguments.threads, out)
        times["sahl"].append(seconds)
        theirs, seconds, rays = povray(name, size, arguments.threads, out)
        times["povray"].append(seconds)
    off = differences(ours, theirs)
    Image.fromarray(np.clip(off * 8, 0, 255).astype(np.uint8)).save(out / f"{name}-difference.png")
    medians = {key: statistics.median(values) for key, values in times.items()}
    print(f"{name}: {arguments.runs} runs each, {arguments.threads} threads, {size[0]} × {size[1]}")
    print(f"  segments            sahl {segments:.0f}, POV-Ray {rays:.0f}: {segments / rays - 1:+.1%}")
    print(f"  rendering, median   sahl {medians['sahl']:.3f} s, POV-Ray {medians['povray']:.3f} s: {medians['povray'] / medians['sahl']:.2f} times")
    print(f"  million a second    sahl {segments / medians['sahl'] / 1e6:.2f}, POV-Ray {rays / medians['povray'] / 1e6:.2f}")
    print(f"  pixels that differ by more than {TOLERANCE} of 255: {(off > TOLERANCE).mean():.3%}; mean difference {off.mean():.3f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", default=["knot", "spheres"])
    parser.add_argument("--program", default=FOLDER.parent.parent / "build/release/sahl")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    if not shutil.which("povray"):
        sys.exit("judge.py: povray is not here. On Debian: apt-get install povray")
    if not (FOLDER / "knot.obj").exists():
        meshes.write_obj(FOLDER / "knot.obj", *meshes.knot())
    out = Path("out/judged")
    out.mkdir(parents=True, exist_ok=True)
    for name in arguments.names:
        judge(name, arguments, out)


if __name__ == "__main__":
    main()
