"""Light guides with a square section, as faces: a straight box, and a bend of 90° after a straight leg."""

import math

from model_files import Face


def flat(name, normal, corners):
    """A convex polygon; the corners counter-clockwise seen from outside."""
    face = Face(name)
    for corner in corners:
        face.vertex(corner, normal)
    face.triangles = [(0, i, i + 1) for i in range(1, len(corners) - 1)]
    return face


def box(name, width, length):
    """From z = 0 to z = length, about the z axis; faces NAME-ends and NAME-side."""
    h = width / 2
    ends, sides = Face(name + "-ends"), Face(name + "-side")

    def add(face, normal, corners):
        n = [face.vertex(corner, normal) for corner in corners]
        face.triangles += [(n[0], n[1], n[2]), (n[0], n[2], n[3])]

    add(ends, (0.0, 0.0, -1.0), [(-h, -h, 0.0), (-h, h, 0.0), (h, h, 0.0), (h, -h, 0.0)])
    add(ends, (0.0, 0.0, 1.0), [(-h, -h, length), (h, -h, length), (h, h, length), (-h, h, length)])
    for s in (-h, h):
        u, t = (1.0 if s > 0 else -1.0), -s
        add(sides, (u, 0.0, 0.0), [(s, t, 0.0), (s, s, 0.0), (s, s, length), (s, t, length)])
        add(sides, (0.0, u, 0.0), [(s, s, 0.0), (t, s, 0.0), (t, s, length), (s, s, length)])
    return [ends, sides]


def bent_guide(width, inner_radius, leg, steps):
    """Begins as a leg along +z from z = 0, about the z axis, then turns by 90° towards +x, where it ends.

    The walls of the bend are cylinders about the line x = width/2 + inner_radius, z = leg, each cut in `steps`
    strips; the sides are flat.
    """
    h, centre = width / 2, width / 2 + inner_radius
    stations = [(1.0, 0.0, 0.0)]  # cosine and sine of the turn, z of its axis
    for k in range(steps + 1):
        turn = math.pi / 2 * k / steps
        stations.append((math.cos(turn) if k < steps else 0.0, math.sin(turn), leg))

    def place(radius, y, station):
        c, s, z = station
        return (centre - radius * c, y, z + radius * s)

    def strip(name, rails, normals, towards):  # `towards`: is the second rail left of the first, seen from outside?
        face = Face(name)
        for station in stations:
            for radius, y in rails:
                face.vertex(place(radius, y, station), normals(station))
        for k in range(len(stations) - 1):
            a, b = 2 * k, 2 * k + 1
            quad = (a, a + 2, b + 2, b) if towards else (a, b, b + 2, a + 2)
            face.triangles += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
        return face

    near, far = inner_radius, inner_radius + width
    begin, end = stations[0], stations[-1]
    entrance = [place(near, -h, begin), place(far, -h, begin), place(far, h, begin), place(near, h, begin)]
    exit_corners = [place(near, -h, end), place(near, h, end), place(far, h, end), place(far, -h, end)]
    return [
        flat("entrance", (0.0, 0.0, -1.0), entrance),
        flat("exit", (1.0, 0.0, 0.0), exit_corners),
        strip("inner", [(near, -h), (near, h)], lambda s: (s[0], 0.0, -s[1]), False),
        strip("outer", [(far, -h), (far, h)], lambda s: (-s[0], 0.0, s[1]), True),
        strip("bottom", [(near, -h), (far, -h)], lambda s: (0.0, -1.0, 0.0), True),
        strip("top", [(near, h), (far, h)], lambda s: (0.0, 1.0, 0.0), False),
    ]
