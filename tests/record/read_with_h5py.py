"""Reads rays.h5 as a stranger would, with h5py alone, and prints what a test compares.

usage: read_with_h5py.py RAYS_H5; prints: rows, power of the roots in W, names of what ended the first ray's segments
"""
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1], "r") as log:
    segments = log["segments"]
    rows = segments["ray"].shape[0]
    assert all(column.shape == (rows,) for column in segments.values())
    assert all("unit" in column.attrs and "meaning" in column.attrs for column in segments.values())
    assert log.attrs["schema_version"] == 2 and isinstance(log.attrs["experiment"], str)
    roots = segments["parent"][:] == -1
    power = np.sum(segments["power_start_W"][:][roots])
    names = log["surfaces/name"].asstr()[:]
    ended_on = [names[i] if i >= 0 else "-" for i in segments["surface"][:][segments["ray"][:] == 0]]
    print(rows, repr(float(power)), log["media/refractive_index"][1, 0], "|".join(ended_on))
