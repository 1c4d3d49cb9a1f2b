"""Writes bodies, whose faces are vertices with normals and triangles, as glTF 2.0 and as OBJ with MTL.

All lengths are in metres, and rounded only when a file is written. Needs Python alone.
"""

import base64
import json
import math
import struct

INDEX = 1.5168  # N-BK7 at the helium d line
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
FLOAT, UNSIGNED_SHORT = 5126, 5123


def as_float(value):
    """The nearest 32-bit float. What is 0 but for rounding is 0, whatever the mathematics library."""
    return struct.unpack("<f", struct.pack("<f", 0.0 if abs(value) < 1e-15 else value))[0]


def unit(v):
    size = math.sqrt(sum(x * x for x in v))
    return tuple(x / size for x in v)


class Face:
    """A smooth face: vertices with their normals, and triangles, counter-clockwise seen from outside."""

    def __init__(self, name):
        self.name, self.positions, self.normals, self.triangles = name, [], [], []

    def vertex(self, position, normal):
        self.positions.append(tuple(position))
        self.normals.append(tuple(normal))
        return len(self.positions) - 1


class Body:
    """Faces that close, of clear glass; each is given a material of its name. `thickness` is what rasterisers show."""

    def __init__(self, name, faces, thickness, index=INDEX):
        self.name, self.faces, self.thickness, self.index = name, faces, thickness, index


def glass(name, body):
    return {
        "name": name,
        "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.0},
        "extensions": {
            "KHR_materials_ior": {"ior": body.index},
            "KHR_materials_transmission": {"transmissionFactor": 1.0},
            "KHR_materials_volume": {"thicknessFactor": body.thickness},
        },
    }


def document(bodies, copyright="CC0-1.0", generator="Sahl models/make_models.py"):
    """The JSON, and the bytes of its buffer: each body is a node and a mesh, each face a primitive and a material."""
    data, views, accessors, meshes, materials = bytearray(), [], [], [], []

    def store(values, layout, component, kind, target, **limits):
        views.append({"buffer": 0, "byteOffset": len(data), "target": target})
        for value in values:
            data.extend(struct.pack(layout, *value))
        views[-1]["byteLength"] = len(data) - views[-1]["byteOffset"]
        data.extend(bytes(-len(data) % 4))
        count = len(values) * (3 if kind == "SCALAR" else 1)
        view = {"bufferView": len(views) - 1, "componentType": component, "count": count, "type": kind}
        accessors.append({**view, **limits})
        return len(accessors) - 1

    def primitive(face, body):
        positions = [tuple(as_float(x) for x in p) for p in face.positions]
        columns = list(zip(*positions))
        limits = {"min": [min(c) for c in columns], "max": [max(c) for c in columns]}
        position = store(positions, "<3f", FLOAT, "VEC3", ARRAY_BUFFER, **limits)
        normals = [tuple(as_float(x) for x in n) for n in face.normals]
        normal = store(normals, "<3f", FLOAT, "VEC3", ARRAY_BUFFER)
        indices = store(face.triangles, "<3H", UNSIGNED_SHORT, "SCALAR", ELEMENT_ARRAY_BUFFER)
        materials.append(glass(face.name, body))
        attributes = {"POSITION": position, "NORMAL": normal}
        return {"attributes": attributes, "indices": indices, "material": len(materials) - 1}

    for body in bodies:
        meshes.append({"name": body.name, "primitives": [primitive(face, body) for face in body.faces]})
    tree = {
        "asset": {"version": "2.0", "generator": generator, "copyright": copyright},
        "extensionsUsed": ["KHR_materials_ior", "KHR_materials_transmission", "KHR_materials_volume"],
        "scene": 0,
        "scenes": [{"nodes": list(range(len(bodies)))}],
        "nodes": [{"name": body.name, "mesh": i} for i, body in enumerate(bodies)],
        "meshes": meshes,
        "materials": materials,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(data)}],
    }
    return tree, bytes(data)


def glb(tree, data):
    text = json.dumps(tree, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def gltf(tree, data):
    tree["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return (json.dumps(tree, indent=1) + "\n").encode()


def obj(body, library):
    """The bytes of an OBJ file in millimetres, and of the MTL file `library` that it names: a group for each face.

    Vertices at one place are written once, so that the surface is closed by its indices; normals are each face's own.
    """

    def line(key, *values):  # what differs by less than 1e-9 mm is the same
        return " ".join([key, *(f"{round(x, 9) + 0.0:.9f}".rstrip("0").rstrip(".") for x in values)])

    lines = ["# CC0-1.0. Millimetres. Written by Sahl models/make_models.py", f"mtllib {library}", f"o {body.name}"]
    places, faces, first_normal = {}, [], 1
    for face in body.faces:
        numbers = []
        for position in face.positions:
            text = line("v", *(1e3 * x for x in position))
            numbers.append(places.setdefault(text, len(places) + 1))
        faces += [f"g {face.name}", f"usemtl {face.name}"]
        for triangle in face.triangles:
            faces.append("f " + " ".join(f"{numbers[i]}//{first_normal + i}" for i in triangle))
        first_normal += len(face.normals)
    lines += places
    lines += [line("vn", *normal) for face in body.faces for normal in face.normals]
    clear = [f"newmtl {face.name}\nNi {body.index}\nTf 1 1 1\nd 1\nillum 7" for face in body.faces]
    return ("\n".join(lines + faces) + "\n").encode(), ("# CC0-1.0\n" + "\n\n".join(clear) + "\n").encode()
