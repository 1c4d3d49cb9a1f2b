#!/usr/bin/env python3
"""Renders scan.toml by Sahl and by Cycles (Blender 3.4), compares the pictures and times the rendering.

Usage: cycles.py [--program FILE] [--runs N] [--threads N]

Cycles follows one random branch at each surface, and so does Sahl with `branch = "roulette"`: equal samples, no denoising,
no lamp, no path ended by chance. Cycles' time is that of a picture whose data stay from the one before: its tree is built.
Needs Blender (Debian's blender), python3-numpy and Pillow, and the bunny: models/fetch_bunny.py.
"""

import argparse
import json
import shutil
import statistics
import subprocess
import sys
import tomllib
from pathlib import Path

import judge
import meshes

FOLDER = Path(__file__).resolve().parent


def scan():
    """The bunny in millimetres, its feet on y = 0, each triangle split in 64."""
    source = FOLDER.parent.parent / "models/bunny.obj"
    if not source.exists():
        sys.exit("cycles.py: models/bunny.obj is not here; models/fetch_bunny.py brings it")
    places, normals, triangles = meshes.read_obj(source)
    mesh = (places * 10, normals, triangles)
    for _ in range(3):
        mesh = meshes.split(*mesh)
    places = mesh[0] - [mesh[0][:, 0].mean(), mesh[0][:, 1].min() - 0.5, mesh[0][:, 2].mean()]
    return places, mesh[1], mesh[2]


def for_blender(experiment, mesh):
    camera, floor = experiment["camera"], experiment["surface"]["floor"]["paint"]
    return {
        "places": mesh[0].tolist(), "normals": mesh[1].tolist(), "triangles": mesh[2].tolist(),
        "index": experiment["medium"]["glass"]["n"], "background": experiment["background"]["color"],
        "floor": [floor["ambient"], [a * b for a, b in zip(floor["ambient"], floor["checker"]["other"])]],
        "checker": floor["checker"]["size_mm"], "floor_size": experiment["object"][0]["shape"]["rectangle"]["size_mm"][0],
        "at": camera["at_mm"], "look_at": camera["look_at_mm"], "fov": camera["fov_deg"],
        "resolution": camera["resolution"], "samples": camera["samples"], "depth": experiment["trace"]["max_depth"],
    }  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=FOLDER.parent.parent / "build/release/sahl")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    if not shutil.which("blender"):
        sys.exit("cycles.py: blender is not here. On Debian: apt-get install blender")
    out = Path("out/judged").resolve()
    out.mkdir(parents=True, exist_ok=True)
    mesh = scan()
    meshes.write_obj(FOLDER / "scan.obj", *mesh)
    experiment = tomllib.loads((FOLDER / "scan.toml").read_text())
    (out / "scan.json").write_text(json.dumps(for_blender(experiment, mesh)))
    command = ["blender", "-b", "--factory-startup", "--python", FOLDER / "in_blender.py", "--"]
    command += [out / "scan.json", out / "scan-cycles.png", arguments.threads, arguments.runs]
    text = subprocess.run(list(map(str, command)), capture_output=True, text=True).stdout
    theirs = [float(line.split()[2]) for line in text.splitlines() if line.startswith("CYCLES")][1:]
    if not theirs:
        sys.exit(text)
    ours = [judge.sahl(arguments.program, "scan", arguments.threads, out) for _ in range(arguments.runs)]
    seconds, segments = statistics.median(s for _, s, _ in ours), ours[0][2]
    print(f"scan: {arguments.runs} runs each, {arguments.threads} threads, {experiment['camera']['samples']} samples a pixel")
    print(f"  rendering, median   sahl {seconds:.3f} s, Cycles {statistics.median(theirs):.3f} s: {statistics.median(theirs) / seconds:.2f} times")
    print(f"  sahl                {segments:.0f} segments, {segments / seconds / 1e6:.2f} million a second")
    off = judge.differences(ours[0][0], out / "scan-cycles.png")
    print(f"  mean difference of the pictures, both of them noisy: {off.mean():.2f} of 255")


if __name__ == "__main__":
    main()
