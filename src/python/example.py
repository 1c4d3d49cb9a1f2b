"""A spot diagram, and how the spot grows when the screen is moved: a plano-convex lens of N-BK7, F, d and C lines.

PYTHONPATH=build/release/python python3 src/python/example.py [PICTURE.png]
"""

import sys
import tempfile

import matplotlib
matplotlib.use("Agg")  # a file, no window
import matplotlib.pyplot as plt
import numpy as np
import sahl

experiment = {
    "trace": {"min_power": 1e-3, "log": True},
    "object": [
        {"name": "lens", "medium": "N-BK7",
         "shape": {"lens": {"r1_mm": 51.68, "r2_mm": 0, "thickness_mm": 5, "diameter_mm": 25}}}
    ],
    "source": [
        {"name": "beam", "lines": ["F", "d", "C"],
         "beam": {"from_mm": [0, 0, -10], "toward": [0, 0, 1], "radius_mm": 8, "pattern": "hexagonal", "rays": 300}}
    ],
    "detector": [{"name": "screen", "at_mm": [0, 0, 98.5], "facing": [0, 0, -1], "size_mm": [10, 10]}],
}

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.5))

with tempfile.TemporaryDirectory() as folder:
    sahl.run(experiment, out=folder + "/run")
    log = sahl.read_log(folder + "/run", where="path(2 refracted(lens), detected(screen))")
last = log["ended"] == sahl.events.index("detected")
x = (log["x_mm"] + log["length_mm"] * log["dx"])[last]
y = (log["y_mm"] + log["length_mm"] * log["dy"])[last]
for wavelength, colour in zip(np.unique(log["wavelength_nm"]), ["tab:blue", "tab:olive", "tab:red"]):
    of_line = log["wavelength_nm"][last] == wavelength
    left.plot(1e3 * x[of_line], 1e3 * y[of_line], ".", ms=3, color=colour, label=f"{wavelength:g} nm")
left.set(title="spot at z = 98.5 mm", xlabel="x / µm", ylabel="y / µm", aspect="equal")
left.legend()

experiment["trace"]["log"] = False
places = np.linspace(90, 104, 29)
radii = [sahl.run(experiment, set=[f"detector.screen.at_mm[2]={z}"])[0]["detectors"]["screen"]["rms_radius_mm"]
         for z in places]
right.plot(places, 1e3 * np.array(radii), ".-")
right.set(title="sweep", xlabel="screen at z / mm", ylabel="RMS radius of the spot / µm", ylim=(0, None))
print(f"least RMS radius {1e3 * min(radii):.1f} µm, at z = {places[np.argmin(radii)]:g} mm")

figure.tight_layout()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "spot.png", dpi=120)
