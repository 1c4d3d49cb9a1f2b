"""A wine glass and the wine in it, as bodies of revolution about y. Lengths in metres. Needs Python alone.

The liquid's wall has the very places of the glass's inner wall below its level, so that the two touch face to face:
nothing lies between them, and nothing of one is in the other.
"""

import math

from model_files import Body, Face

MM = 1e-3
AROUND = 96

# Radius and height in mm, of smooth curves through these points.
UNDER = [(0, 0), (17, 0), (34, 0)]
EDGE = [(34, 0), (35.2, 0.5), (35.7, 1.2), (35.2, 1.9), (34, 2.4)]
FOOT = [(34, 2.4), (20, 4), (8, 8), (4.4, 16), (3.8, 30)]
STEM = [(3.8, 30), (3.6, 50), (3.9, 70), (6, 79), (14, 87), (26, 99), (35, 117), (37.5, 137), (36, 160), (31.6, 194)]
RIM = [(31.6, 194), (31.3, 194.8), (30.7, 195), (30.2, 194.6), (30.1, 194)]
INSIDE = [(30.1, 194), (34.5, 160), (36, 137), (33.4, 117.5), (24.5, 101.5), (13, 92), (5, 88.8), (0, 88)]
LEVEL = 128  # mm, of the liquid


def tangents(points, first, last):
    """Of a Catmull–Rom curve, by the length of the chords; at the ends as given."""
    chord = [math.dist(p, q) for p, q in zip(points, points[1:])]
    result = [first]
    for i in range(1, len(points) - 1):
        a, b = chord[i - 1], chord[i]
        slopes = [
            ((q - p) / a * b + (r - q) / b * a) / (a + b) for p, q, r in zip(points[i - 1], points[i], points[i + 1])
        ]
        result.append(slopes)
    return [*result, last], chord


def curve(points, first, last, fineness):
    """Places and directions along a cubic curve through the points: `fineness` pieces between each two."""
    slopes, chord = tangents(points, first, last)
    out = []
    for (p, q), (m, n), h in zip(zip(points, points[1:]), zip(slopes, slopes[1:]), chord):
        for k in range(fineness + (q is points[-1])):
            t = k / fineness
            place, way = [], []
            for a, b, c, d in zip(p, q, m, n):
                c, d = c * h, d * h
                place.append(a + t * (c + t * (3 * (b - a) - 2 * c - d + t * (2 * (a - b) + c + d))))
                way.append(c + t * (6 * (b - a) - 4 * c - 2 * d + t * (6 * (a - b) + 3 * c + 3 * d)))
            out.append((tuple(place), tuple(way)))
    return out


def cut_at(profile, height):
    """A profile that falls, in two parts that share a place at exactly this height."""
    i = next(i for i, (place, _) in enumerate(profile) if place[1] < height)
    (above, way_above), (below, way_below) = profile[i - 1], profile[i]
    share = (above[1] - height) / (above[1] - below[1])
    mix = lambda a, b: tuple(x + share * (y - x) for x, y in zip(a, b))
    middle = ((mix(above, below)[0], height), mix(way_above, way_below))
    # no sliver beside the cut: a place close to it gives way
    upper = [*profile[: i - (share < 0.3)], middle]
    return upper, [middle, *profile[i + (share > 0.7) :]]


def revolve(name, profile, side):
    """The surface that a profile sweeps about y. `side`: +1, the outside is to the right of its way; −1, to the left."""
    face, rings = Face(name), []
    for (r, y), (way_r, way_y) in profile:
        size = math.hypot(way_r, way_y)
        out, up = side * way_y / size, -side * way_r / size
        ring = []
        for k in range(AROUND if r > 1e-9 else 1):
            c, s = math.cos(2 * math.pi * k / AROUND), math.sin(2 * math.pi * k / AROUND)
            position = (r * MM * c, y * MM, r * MM * s)
            ring.append(face.vertex(position, (out * c, up, out * s) if r > 1e-9 else (0.0, math.copysign(1, up), 0.0)))
        rings.append(ring)
    for lower, upper in zip(rings, rings[1:]):
        for k in range(AROUND):
            a, b = (ring[k % len(ring)] for ring in (lower, upper))
            c, d = (ring[(k + 1) % len(ring)] for ring in (lower, upper))
            for triangle in ((a, b, c), (c, b, d)):
                if len(set(triangle)) == 3:
                    face.triangles.append(triangle if side > 0 else triangle[::-1])
    return face


def wine_glass():
    """The glass, and the liquid that fills it up to LEVEL."""
    down, up = (0.0, -1.0), (0.0, 1.0)
    flat_out, flat_in = (1.0, 0.0), (-1.0, 0.0)
    lean = [(b - a) / math.dist(STEM[-2], STEM[-1]) for a, b in zip(STEM[-2], STEM[-1])]
    back = [(b - a) / math.dist(INSIDE[0], INSIDE[1]) for a, b in zip(INSIDE[0], INSIDE[1])]
    inwards = [(b - a) / math.dist(FOOT[0], FOOT[1]) for a, b in zip(FOOT[0], FOOT[1])]
    outside = curve(UNDER, flat_out, flat_out, 1) + curve(EDGE, flat_out, inwards, 3)[1:]
    outside += curve(FOOT, inwards, up, 4)[1:] + curve(STEM, up, lean, 3)[1:] + curve(RIM, lean, back, 3)[1:]
    dry, wet = cut_at(curve(INSIDE, back, flat_in, 4), LEVEL)
    glass = [revolve("outside", outside, 1), revolve("inside", dry, 1), revolve("filled", wet, 1)]
    radius = wet[0][0][0]
    surface = [((radius * x, float(LEVEL)), flat_in) for x in (1.0, 0.75, 0.5, 0.25, 0.0)]
    liquid = [revolve("wall", wet, -1), revolve("surface", surface, 1)]
    return [Body("glass", glass, 1.4 * MM), Body("wine", liquid, 60 * MM, 1.34)]
