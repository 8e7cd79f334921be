#!/usr/bin/env python3
"""Writes the meshes of the samples beside itself: rock.glb, barrel.obj with barrel.mtl, and ../urdf/scout.glb."""
import json
import math
import os
import struct

HERE = os.path.dirname(os.path.abspath(__file__))


def linear(rgb):
    """sRGB 0xRRGGBB to the linear factors of glTF."""
    channels = [(rgb >> shift & 255) / 255 for shift in (16, 8, 0)]
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels] + [1]


def write_glb(path, parts):
    """parts: [(name, 0xRRGGBB, faces)], a face a list of (x, y, z) in metres, x forward and z up. Each face is flat."""
    data = b""
    views, accessors, primitives, materials = [], [], [], []

    def add(values, form, kind, **more):
        nonlocal data
        packed = b"".join(struct.pack(form, *(value if isinstance(value, tuple) else (value,))) for value in values)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        component = 5126 if "f" in form else 5123
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(values), "type": kind, **more})
        data += packed + b"\0" * (-len(packed) % 4)
        return len(accessors) - 1

    for name, colour, faces in parts:
        # glTF: y up, z to the front, x to the left.
        corners = [(y, z, x) for face in faces for x, y, z in face]
        triangles, first = [], 0
        for face in faces:
            triangles += [first + k for i in range(1, len(face) - 1) for k in (0, i, i + 1)]
            first += len(face)
        low = [min(c[axis] for c in corners) for axis in range(3)]
        high = [max(c[axis] for c in corners) for axis in range(3)]
        # As they are after rounding, which the format asks for.
        low, high = ([struct.unpack("<f", struct.pack("<f", v))[0] for v in bound] for bound in (low, high))
        primitives.append({
            "attributes": {"POSITION": add(corners, "<3f", "VEC3", min=low, max=high)},
            "indices": add(triangles, "<H", "SCALAR"),
            "material": len(materials),
        })
        materials.append({"name": name, "pbrMetallicRoughness": {"baseColorFactor": linear(colour), "metallicFactor": 0}})
    text = json.dumps({
        "asset": {"version": "2.0", "generator": "make_meshes.py of Swarmanoid"},
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": primitives}], "materials": materials,
        "buffers": [{"byteLength": len(data)}], "bufferViews": views, "accessors": accessors,
    }, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(data), b"BIN\0") + data)


def prism(outline, low, high, inset=0.0):
    """An outline (x, y), counter-clockwise, from low to high; the upper edge drawn in by a share of it."""
    below = [(x, y, low) for x, y in outline]
    above = [(x * (1 - inset), y * (1 - inset), high) for x, y in outline]
    count = len(outline)
    sides = [[below[i], below[(i + 1) % count], above[(i + 1) % count], above[i]] for i in range(count)]
    return [above, below[::-1]] + sides


def circle(radius, count, x=0.0, y=0.0):
    return [(x + radius * math.cos(2 * math.pi * i / count), y + radius * math.sin(2 * math.pi * i / count)) for i in range(count)]


def box(low, high):
    (x0, y0, z0), (x1, y1, z1) = low, high
    return prism([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], z0, z1)


def rock():
    """A ball of twenty faces, each in sixteen, whose corners are pushed in and out."""
    golden = (1 + math.sqrt(5)) / 2
    corners = [(s * a, t * b * golden, 0) for s in (-1, 1) for t in (-1, 1) for a, b in ((1, 1),)]
    corners = corners + [(0, s, t * golden) for s in (-1, 1) for t in (-1, 1)] + [(s * golden, 0, t) for s in (-1, 1) for t in (-1, 1)]
    faces = []
    for a in range(12):
        for b in range(a + 1, 12):
            for c in range(b + 1, 12):
                if all(abs(math.dist(corners[i], corners[j]) - 2) < 1e-6 for i, j in ((a, b), (b, c), (c, a))):
                    p, q, r = (corners[i] for i in (a, b, c))
                    cross = [(q[i - 2] - p[i - 2]) * (r[i - 1] - p[i - 1]) - (q[i - 1] - p[i - 1]) * (r[i - 2] - p[i - 2]) for i in range(3)]
                    faces.append((p, q, r) if sum(x * y for x, y in zip(cross, p)) > 0 else (p, r, q))

    def middle(p, q):
        return tuple((x + y) / 2 for x, y in zip(p, q))

    for _ in range(2):
        faces = [part for p, q, r in faces for u, v, w in [(middle(p, q), middle(q, r), middle(r, p))]
                 for part in ((p, u, w), (u, q, v), (w, v, r), (u, v, w))]

    def pushed(point):
        length = math.hypot(*point)
        x, y, z = (value / length for value in point)
        out = 1 + 0.16 * math.sin(3.1 * x + 1) * math.cos(2.3 * y) + 0.10 * math.sin(5.3 * z + 2 * x) + 0.06 * math.cos(7 * y - 4 * z)
        return (0.2 * out * x, 0.15 * out * y, 0.12 * out * z + 0.1)

    return [[pushed(point) for point in face] for face in faces]


def write_barrel(path):
    """Staves that bulge, and two hoops: 0.1 m of radius, 0.3 m high."""
    count = 20
    rings = [(0.085, 0), (0.094, 0.06), (0.095, 0.06), (0.099, 0.09), (0.098, 0.09), (0.1, 0.15), (0.098, 0.21), (0.099, 0.21), (0.095, 0.24),
             (0.094, 0.24), (0.085, 0.3)]
    with open(os.path.splitext(path)[0] + ".mtl", "w", encoding="ascii") as file:
        file.write("newmtl wood\nKd 0.62 0.42 0.24\nnewmtl iron\nKd 0.30 0.32 0.35\n")
    with open(path, "w", encoding="ascii") as file:
        file.write("# A barrel, by make_meshes.py. Metres, z up.\nmtllib barrel.mtl\n")
        for radius, z in rings:
            for x, y in circle(radius, count):
                file.write(f"v {x:.5f} {y:.5f} {z:.3f}\n")
        for k in range(len(rings) - 1):
            file.write("usemtl %s\n" % ("iron" if k in (2, 7) else "wood"))
            for i in range(count):
                a, b = k * count + i + 1, k * count + (i + 1) % count + 1
                file.write(f"f {a} {b} {b + count} {a + count}\n")
        last = (len(rings) - 1) * count
        file.write("usemtl wood\nf %s\n" % " ".join(str(last + i + 1) for i in range(count)))
        file.write("f %s\n" % " ".join(str(i + 1) for i in reversed(range(count))))


def scout():
    """The upper part of a small robot, its origin in the middle of its underside: an arrow-like hull with a camera."""
    hull = [(-0.09, -0.065), (0.05, -0.065), (0.1, -0.03), (0.1, 0.03), (0.05, 0.065), (-0.09, 0.065)]
    skirt = [(x * 1.03, y * 1.03) for x, y in hull]
    lens = [[(0.071, y, z) for y, z in circle(0.013, 12, 0, 0.078)]]
    return [
        ("skirt", 0x353B44, prism(skirt, 0, 0.018)),
        ("hull", 0xE07A1F, prism(hull, 0.018, 0.05, 0.18)),
        ("deck", 0xF2F2EE, prism([(x * 0.7 - 0.01, y * 0.7) for x, y in hull], 0.05, 0.058, 0.06)),
        ("camera", 0x2A2E34, box((0.03, -0.022, 0.058), (0.07, 0.022, 0.098))),
        ("lens", 0x3FA7D6, lens),
        ("mast", 0x9AA3AD, prism(circle(0.006, 10, -0.055), 0.058, 0.14)),
        ("lamp", 0xD93025, prism(circle(0.011, 10, -0.055), 0.14, 0.155)),
    ]


if __name__ == "__main__":
    write_glb(os.path.join(HERE, "rock.glb"), [("stone", 0x8A8178, rock())])
    write_barrel(os.path.join(HERE, "barrel.obj"))
    write_glb(os.path.join(HERE, "..", "urdf", "scout.glb"), scout())
