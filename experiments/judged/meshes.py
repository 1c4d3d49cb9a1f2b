"""Meshes to be judged with, made by formula, and the forms in which Sahl and POV-Ray read them. Needs NumPy."""

import numpy as np


def knot(around=160, along=320, radius=6.5):
    """A tube about a trefoil knot, some 80 wide, closed and smooth: positions, normals and 2 · around · along triangles."""
    t = np.linspace(0, 2 * np.pi, along, endpoint=False)
    centre = 13 * np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], 1)
    way = np.stack([np.cos(t) + 4 * np.cos(2 * t), -np.sin(t) + 4 * np.sin(2 * t), -3 * np.cos(3 * t)], 1)
    bend = np.stack([-np.sin(t) - 8 * np.sin(2 * t), -np.cos(t) + 8 * np.cos(2 * t), 9 * np.sin(3 * t)], 1)
    unit = lambda v: v / np.linalg.norm(v, axis=-1, keepdims=True)
    way = unit(way)
    side = unit(bend - np.sum(bend * way, 1)[:, None] * way)
    other = np.cross(way, side)
    a = np.linspace(0, 2 * np.pi, around, endpoint=False)
    out = np.cos(a)[None, :, None] * side[:, None] + np.sin(a)[None, :, None] * other[:, None]
    places = centre[:, None] + radius * out
    i, j = np.meshgrid(np.arange(along), np.arange(around), indexing="ij")
    number = lambda p, q: (p % along) * around + q % around
    corners = [number(i, j), number(i, j + 1), number(i + 1, j), number(i + 1, j + 1)]
    p, q, r, s = (c.reshape(-1) for c in corners)
    triangles = np.concatenate([np.stack([p, r, q], 1), np.stack([q, r, s], 1)])
    places, out = places.reshape(-1, 3), out.reshape(-1, 3)
    first = places[triangles[0]]
    if np.dot(np.cross(first[1] - first[0], first[2] - first[0]), out[triangles[0, 0]]) < 0:
        triangles = triangles[:, [0, 2, 1]]
    return places, out, triangles


def split(places, normals, triangles):
    """Each triangle in four, its edges halved; normals are the means of the corners'."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    unique, inverse = np.unique(edges, axis=0, return_inverse=True)
    middle = (inverse.reshape(3, -1) + len(places)).T
    places = np.concatenate([places, places[unique].mean(1)])
    means = normals[unique].sum(1)
    normals = np.concatenate([normals, means / np.linalg.norm(means, axis=1, keepdims=True)])
    a, b, c = triangles.T
    ab, bc, ca = middle.T
    pieces = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return places, normals, np.concatenate([np.stack(p, 1) for p in pieces])


def read_obj(path):
    """Places and triangles of an OBJ file of triangles; normals are the sums of those of the triangles about."""
    places, triangles = [], []
    for line in open(path):
        words = line.split()
        if words and words[0] == "v":
            places.append([float(x) for x in words[1:4]])
        elif words and words[0] == "f":
            triangles.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
    places, triangles = np.array(places), np.array(triangles)
    area = np.cross(places[triangles[:, 1]] - places[triangles[:, 0]], places[triangles[:, 2]] - places[triangles[:, 0]])
    normals = np.zeros_like(places)
    for k in range(3):
        np.add.at(normals, triangles[:, k], area)
    return places, normals / np.linalg.norm(normals, axis=1, keepdims=True), triangles


def write_obj(path, places, normals, triangles):
    with open(path, "w") as out:
        out.writelines("v %.9g %.9g %.9g\n" % tuple(p) for p in places)
        out.writelines("vn %.9g %.9g %.9g\n" % tuple(n) for n in normals)
        out.writelines("f %d//%d %d//%d %d//%d\n" % (a, a, b, b, c, c) for a, b, c in triangles + 1)


def pov_mesh(places, normals, triangles):
    """A mesh2 of POV-Ray, without its closing brace."""

    def vectors(name, rows):
        return name + " {" + str(len(rows)) + "," + ",".join("<%.9g,%.9g,%.9g>" % tuple(r) for r in rows) + "}\n"

    faces = "face_indices {" + str(len(triangles)) + "," + ",".join("<%d,%d,%d>" % tuple(t) for t in triangles) + "}\n"
    return "mesh2 {\n" + vectors("vertex_vectors", places) + vectors("normal_vectors", normals) + faces
