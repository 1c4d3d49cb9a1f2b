"""Convex bodies with flat faces, given as half spaces, as OBJ: prisms that turn light, and a brilliant.

Places are written with all the digits of a double, without normals: each face is as flat as that allows. Lengths in mm.
"""

import math
from itertools import combinations

NEAR = 1e-9  # of the size: corners that are nearer are one


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def meeting(planes):
    """The point that three planes (normal, offset) have in common, or None."""
    (a, i), (b, j), (c, k) = planes
    volume = dot(a, cross(b, c))
    if abs(volume) < 1e-9:
        return None
    sums = zip(cross(b, c), cross(c, a), cross(a, b))
    return tuple((i * x + j * y + k * z) / volume for x, y, z in sums)


def polyhedron(half_spaces):
    """From {name: (outward unit normal n, offset)}, points p with n·p ≤ offset: corners, and {name: their numbers}.

    The numbers run counter-clockwise seen from outside. A half space that cuts nothing off has no face.
    """
    planes = list(half_spaces.values())
    size = max(abs(offset) for _, offset in planes)
    corners = []
    for three in combinations(planes, 3):
        p = meeting(three)
        if p is None or any(dot(n, p) > offset + NEAR * size for n, offset in planes):
            continue
        if all(math.dist(p, q) > NEAR * size for q in corners):
            corners.append(p)
    faces = {}
    for name, (n, offset) in half_spaces.items():
        on = [i for i, p in enumerate(corners) if abs(dot(n, p) - offset) < NEAR * size]
        if len(on) < 3:
            continue
        middle = [sum(corners[i][axis] for i in on) / len(on) for axis in range(3)]
        right = [x - y for x, y in zip(corners[on[0]], middle)]
        up = cross(n, right)

        def turn(i):
            away = [x - y for x, y in zip(corners[i], middle)]
            return math.atan2(dot(away, up) / math.dist(middle, corners[on[0]]), dot(away, right))

        faces[name] = sorted(on, key=turn)
    return corners, faces


LIBRARY = "polyhedra.mtl"


def obj(name, half_spaces, coated=()):
    """The bytes of an OBJ file in millimetres: a group for each face, of the material `coated` or `clear`."""
    corners, faces = polyhedron(half_spaces)
    lines = ["# CC0-1.0. Millimetres. Written by Sahl models/make_models.py", f"mtllib {LIBRARY}", f"o {name}"]
    lines += ["v " + " ".join(repr(0.0 if abs(x) < 1e-13 else x) for x in p) for p in corners]
    for face, numbers in faces.items():
        material = "coated" if face in coated else "clear"
        lines += [f"g {face}", f"usemtl {material}", "f " + " ".join(str(i + 1) for i in numbers)]
    return ("\n".join(lines) + "\n").encode()


def library(index):
    """The MTL file that they name: both materials are clear glass, until an experiment says otherwise."""
    materials = [f"newmtl {name}\nNi {index}\nTf 1 1 1\nd 1\nillum 7" for name in ("clear", "coated")]
    return ("# CC0-1.0\n" + "\n\n".join(materials) + "\n").encode()


def facing(degrees):
    """The unit normal in the plane z = 0 at this angle from +x; exact at multiples of 90°."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return (0.0 if degrees % 180 == 90 else c, 0.0 if degrees % 180 == 0 else s, 0.0)


def slab(depth):
    """The two faces across z."""
    return {"near": ((0.0, 0.0, -1.0), depth / 2), "far": ((0.0, 0.0, 1.0), depth / 2)}


def dove(base, height, depth):
    """Light along +x; the base at y = −height/2, the ends slanted by 45° towards the top, the middle at the origin."""
    at = (base - height) / 2 * math.sqrt(0.5)  # of either end, from the middle
    return {
        "entrance": (facing(135), at),
        "exit": (facing(45), at),
        "base": (facing(-90), height / 2),
        "top": (facing(90), height / 2),
        **slab(depth),
    }


def pellin_broca(long, cut, depth):
    """Entrance (x = 0) and exit (y = 0) meet at the origin in a right angle, at 75° and 60° to the others.

    The mirror, between entrance and back, stands at `cut` from the origin, the back at `long` along the exit.
    """
    return {
        "entrance": (facing(180), 0.0),
        "exit": (facing(-90), 0.0),
        "mirror": (facing(75), cut),
        "back": (facing(30), long * math.cos(math.radians(30))),
        **slab(depth),
    }


def penta(side, depth):
    """Light enters along +x by the face x = 0 and leaves along +y by the face y = side; both mirrors are met at 22.5°."""
    return {
        "entrance": (facing(180), 0.0),
        "exit": (facing(90), side),
        "first": (facing(22.5), dot(facing(22.5), (side, side, 0.0))),
        "second": (facing(-112.5), 0.0),
        "corner": (facing(-45), side),
        **slab(depth),
    }


def roof(width):
    """Amici's: light enters along +z by the face z = 0, meets both sides of a roof and leaves along +y at y = width.

    The ridge lies in the plane x = 0, at 45° between y and z, half a width behind the hypotenuse z = y.
    """
    h = math.sqrt(0.5)
    behind = width / 2 * h
    return {
        "entrance": ((0.0, 0.0, -1.0), 0.0),
        "exit": ((0.0, 1.0, 0.0), width),
        "left-roof": ((-h, -0.5, 0.5), behind),
        "right-roof": ((h, -0.5, 0.5), behind),
        "left": ((-1.0, 0.0, 0.0), width / 2),
        "right": ((1.0, 0.0, 0.0), width / 2),
    }


def through(name, points):
    """{name: the half space whose border goes through three points, the origin within}."""
    a, b, c = points
    n = cross([x - y for x, y in zip(b, a)], [x - y for x, y in zip(c, a)])
    size = math.copysign(math.hypot(*n), dot(n, a))
    n = tuple(x / size for x in n)
    return {name: (n, dot(n, a))}


def round_about(radius, degrees, z):
    return tuple(radius * x for x in facing(degrees)[:2]) + (z,)


def brilliant_girdle(radius):
    """Sixteen upright walls; their edges lie on the circle, at multiples of 22.5°."""
    inside = radius * math.cos(math.radians(11.25))
    return {f"girdle-{i}": (facing(11.25 + 22.5 * i), inside) for i in range(16)}


def brilliant_crown(radius, table, slope, girdle):
    """The upper part of a round brilliant, on the plane z = 0: table, 8 stars, 8 mains, 16 upper halves.

    `table`: its corners' radius as a share; `slope`: the mains' tangent; `girdle`: its height. Stars reach halfway.
    """
    planes = {"bottom": ((0.0, 0.0, -1.0), 0.0), **brilliant_girdle(radius)}
    eighth = math.cos(math.radians(22.5))
    planes["table"] = ((0.0, 0.0, 1.0), girdle + (1 - table) * radius * slope)
    tip = (1 + table * eighth) / 2 * radius  # of a star, on the edge between two mains
    for i in range(8):
        at = 45 * i
        corner = [round_about(table * radius, at + turn, planes["table"][1]) for turn in (0, 45)]
        point = round_about(tip, at + 22.5, girdle + (radius - tip * eighth) * slope)
        n = tuple(x / math.hypot(1, slope) for x in (slope * facing(at)[0], slope * facing(at)[1], 1.0))
        planes[f"main-{i}"] = (n, dot(n, round_about(radius, at, girdle)))
        planes |= through(f"star-{i}", (*corner, point))
        for half, side in enumerate((0, 45)):
            ends = [round_about(radius, at + turn, girdle) for turn in (side, 22.5)]
            planes |= through(f"upper-half-{2 * i + half}", (*ends, point))
    return planes


def brilliant_pavilion(radius, length, girdle):
    """The lower part, under the plane z = 0: 8 mains at 45°, so that a scale along z is their tangent; 16 lower halves.

    `length`: how far the halves reach from the girdle to the culet, as a share.
    """
    planes = {"top": ((0.0, 0.0, 1.0), 0.0), **brilliant_girdle(radius)}
    h = math.sqrt(0.5)
    tip = (1 - length) * radius
    point_z = -girdle - (radius - tip * math.cos(math.radians(22.5)))
    for i in range(8):
        at = 45 * i
        n = (h * facing(at)[0], h * facing(at)[1], -h)
        planes[f"main-{i}"] = (n, dot(n, round_about(radius, at, -girdle)))
        point = round_about(tip, at + 22.5, point_z)
        for half, side in enumerate((0, 45)):
            ends = [round_about(radius, at + turn, -girdle) for turn in (side, 22.5)]
            planes |= through(f"lower-half-{2 * i + half}", (*ends, point))
    return planes
