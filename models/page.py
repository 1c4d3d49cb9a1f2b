#!/usr/bin/env python3
"""Writes page.png: a printed page, 150 × 200 mm at 8 pixels a millimetre, grey. Needs python3-matplotlib.

Usage: page.py      The picture is committed: another matplotlib may set the type a little differently.
"""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.image
import matplotlib.pyplot as plt
import numpy

TITLE = "On Burning Mirrors and Lenses"
TEXT = """About the year 984 Ibn Sahl, a geometer
in Baghdad, asked what shape a piece of
crystal must have to gather the light of
the sun in one point. He used no sines. He
drew a right-angled triangle at the face
of the crystal, one side along the ray as
it would have gone, one along the ray as
it goes, and found that the two stand in
a ratio that is the same for every slope.

That ratio is what we call the index of
refraction. With it he found the lens of
two hyperboloids, which has no spherical
aberration; six hundred years passed
before the law was written down again.

What is printed here is straight and
even. Whatever is bent or coloured in
the picture was done by the glass."""
WIDTH_MM, HEIGHT_MM, PER_MM = 150, 200, 8


def main():
    figure = plt.figure(figsize=(WIDTH_MM / 25.4, HEIGHT_MM / 25.4), dpi=PER_MM * 25.4, facecolor="white")
    figure.text(0.5, 0.93, TITLE, family="DejaVu Serif", size=17, ha="center", va="top", weight="bold")
    figure.text(0.1, 0.845, TEXT, family="DejaVu Serif", size=14.2, va="top", linespacing=1.55)
    figure.canvas.draw()
    pixels = numpy.asarray(figure.canvas.buffer_rgba())[:, :, 0]
    levels = numpy.round(pixels / 17).astype(numpy.uint8) * 17  # sixteen greys are enough for type, and pack well
    path = Path(__file__).resolve().parent / "page.png"
    from PIL import Image  # comes with matplotlib

    Image.fromarray(levels, "L").save(path, optimize=True)


if __name__ == "__main__":
    main()
