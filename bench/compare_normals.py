#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooth normals of `arete convert` and of gltfpack beside each other: angles to the true normals of shapes.

    bench/compare_normals.py ARETE GLTFPACK_CLI_JS

Meshes without normals, whose quads are cut along random diagonals, go through both programs with a crease angle
of 45 degrees. At each corner of each triangle the normal is compared with that of the shape, on the side of the
triangle. Prints the mean and the largest angle in degrees.
"""

import json
import math
import os
import random
import struct
import subprocess
import sys
import tempfile


def cube(seed):
    rng = random.Random(seed)
    n, quads, points, number = 4, [], [], {}

    def vertex(p):
        if p not in number:
            number[p] = len(points)
            points.append(p)
        return number[p]

    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    def corner(u, v, axis=axis, side=side):
                        p = [0, 0, 0]
                        p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, u, v
                        return vertex(tuple(p))
                    quad = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]
                    quads.append(quad if side else quad[::-1])
    return points, cut(quads, rng), lambda p, face: face_axis(face)


def face_axis(face):
    k = max(range(3), key=lambda i: abs(face[i]))
    return [math.copysign(1, face[k]) if i == k else 0 for i in range(3)]


def cylinder(seed):
    rng, n = random.Random(seed), 24
    points = [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), z) for z in (0, 1, 2) for i in range(n)]
    quads = [[r * n + i, r * n + (i + 1) % n, (r + 1) * n + (i + 1) % n, (r + 1) * n + i] for r in (0, 1) for i in range(n)]
    faces = cut(quads, rng)
    for ring, z in ((0, 0), (2 * n, 2)):
        middle = len(points)
        points.append((0, 0, z))
        for i in range(n):
            a, b = ring + i, ring + (i + 1) % n
            faces.append([middle, a, b] if z else [middle, b, a])
    return points, faces, lambda p, face: face_axis(face) if abs(face[2]) > .9 else [p[0], p[1], 0]


def around(rows, columns, place, closes):
    points = [place(r / rows, c / columns) for r in range(rows + (not closes)) for c in range(columns)]
    at = lambda r, c: (r % rows if closes else r) * columns + c % columns
    return points, [[at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c)] for r in range(rows) for c in range(columns)]


def sphere(seed):
    n, m = 24, 12
    tau = 2 * math.pi
    points, quads = around(m, n, lambda v, u: (math.sin(tau / 2 * (1 - v)) * math.cos(tau * u), math.sin(tau / 2 * (1 - v)) * math.sin(tau * u),
                                            math.cos(tau / 2 * (1 - v))), False)
    number = {}
    for i in range(len(points)):
        row = i // n
        number[i] = i if 0 < row < m else (0 if row == 0 else m * n)
    quads = [[number[i] for i in quad] for quad in quads]
    return points, cut(quads, random.Random(seed)), lambda p, face: p


def torus(seed):
    tau = 2 * math.pi
    points, quads = around(16, 32, lambda v, u: ((3 + math.cos(tau * v)) * math.cos(tau * u), (3 + math.cos(tau * v)) * math.sin(tau * u),
                                             math.sin(tau * v)), True)

    def normal(p, face):
        long = math.hypot(p[0], p[1])
        return [p[0] - 3 * p[0] / long, p[1] - 3 * p[1] / long, p[2]]
    return points, cut(quads, random.Random(seed)), normal


def cut(quads, rng):
    faces = []
    for a, b, c, d in quads:
        faces += [[a, b, c], [a, c, d]] if rng.random() < .5 else [[a, b, d], [b, c, d]]
    return [f for f in faces if len(set(f)) == 3]


def read(path):
    """Triangles of a GLB with floats: (positions, normals) of their corners."""
    data = open(path, "rb").read()
    length = struct.unpack_from("<I", data, 12)[0]
    document, start = json.loads(data[20:20 + length]), 28 + length

    def values(index):
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        kind, size = {5126: ("f", 4), 5125: ("I", 4), 5123: ("H", 2), 5121: ("B", 1)}[accessor["componentType"]]
        count = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        offset = start + view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", size * count)
        return [struct.unpack_from(f"<{count}{kind}", data, offset + i * stride) for i in range(accessor["count"])]
    for mesh in document["meshes"]:
        for primitive in mesh["primitives"]:
            p, n = (values(primitive["attributes"][name]) for name in ("POSITION", "NORMAL"))
            indices = [i for i, in values(primitive["indices"])] if "indices" in primitive else range(len(p))
            for k in range(0, len(indices), 3):
                yield [p[i] for i in indices[k:k + 3]], [n[i] for i in indices[k:k + 3]]


def angle(a, b):
    c = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return math.degrees(math.atan2(math.hypot(*c), sum(x * y for x, y in zip(a, b))))


def errors(path, true_normal):
    found = []
    for p, n in read(path):
        e, f = ([p[k][i] - p[0][i] for i in range(3)] for k in (1, 2))
        face = (e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0])
        size = math.hypot(*face) or 1
        found += [angle(n[k], true_normal(p[k], [x / size for x in face])) for k in range(3)]
    return sum(found) / len(found), max(found)


def main():
    arete, gltfpack = sys.argv[1:]
    print("shape       seed    arete mean       max   gltfpack mean       max")
    with tempfile.TemporaryDirectory() as folder:
        source, ours, theirs = (os.path.join(folder, name) for name in ("in.obj", "ours.glb", "theirs.glb"))
        for shape in (cube, cylinder, sphere, torus):
            for seed in (1, 2, 3):
                points, faces, normal = shape(seed)
                with open(source, "w") as file:
                    for p in points:
                        file.write("v {:.9g} {:.9g} {:.9g}\n".format(*p))
                    for f in faces:
                        file.write("f {} {} {}\n".format(*(i + 1 for i in f)))
                subprocess.run([arete, "convert", source, "-o", ours, "--overwrite", "--normals", "smooth"], check=True, capture_output=True)
                subprocess.run(["node", gltfpack, "-i", source, "-o", theirs, "-noq", "-gn", "45", "-kv"],
                               check=True, capture_output=True)
                print("{:10} {:5} {:13.4f} {:9.4f} {:15.4f} {:9.4f}".format(shape.__name__, seed, *errors(ours, normal), *errors(theirs, normal)))


if __name__ == "__main__":
    main()
