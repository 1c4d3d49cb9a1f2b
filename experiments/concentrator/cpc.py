#!/usr/bin/env python3
"""Prints the mirrors of concentrator.toml, a compound parabolic trough of a given acceptance angle and exit.

A wall is a quadric: what lies behind its parabola, within a box from the exit's edge outwards. Needs Python alone.
"""

import math

ACCEPTANCE = math.radians(30)
EXIT = 10.0  # mm, half its width
LENGTH, THICK = 100.0, 12.0  # mm: of the trough along y, of the box along x


def wall():
    """Of the right wall: coefficients of xx, yy, zz, xy, xz, yz, x, y, z, 1 about the box's middle; that; its sizes."""
    s, c = math.sin(ACCEPTANCE), math.cos(ACCEPTANCE)
    height = (EXIT + EXIT / s) * c / s
    f = EXIT * (1 + s)
    middle = (EXIT + THICK / 2, 0.0, height / 2)
    # With q = (x + EXIT, z), from the focus in the left edge of the exit, and the axis u = (-s, c), the parabola is
    # |q| = q·u + 2 f; behind it (q·u + 2 f)² - |q|² <= 0
    x, z = middle[0] + EXIT, middle[2]
    along = -s * x + c * z + 2 * f
    return (
        [s * s - 1, 0.0, c * c - 1, 0.0, -2 * s * c, 0.0]
        + [-2 * s * along - 2 * x, 0.0, 2 * c * along - 2 * z, along * along - x * x - z * z],
        middle,
        (THICK, LENGTH, height),
    )


def main():
    coefficients, middle, size = wall()
    print("coefficients =", [0.0 if abs(k) < 1e-12 else k for k in coefficients])
    print("clip_mm =", list(size))
    print("move_mm =", list(middle))


if __name__ == "__main__":
    main()
