#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts at random, and each attribute that they state a bound of measured at points of the source (./dev test --full).

    attribute_bounds.py --arete PROGRAM [--data FOLDER] [--cuts 200] [--scan-cuts 10] [--seed 62] [--only NAME,...]

Meshes: spot, fuze and pirate of the real data, where it is there, and a plate of two colours, a painted torus, a labelled and a mirrored
sheet and a scan of 400 000 faces that are made here. Each has three tolerances and so many cuts at random: by a tolerance, a budget or a camera,
some with a tolerance of an attribute. `measure --attributes` searches every triangle of the cut within its error, on the chart of the point, and
shares no code with the build. Ends with 1 where a point is off by more than is stated, or where the geometric mean of what is stated over
the largest that was found is above 2; with 77 where there is nothing to run.
"""

import argparse
import json
import math
import os
import random
import struct
import subprocess
import sys
import tempfile
import time

# What rounding to the file's 32-bit floats may add, in the unit of the attribute.
SLACK = {"uv": 2e-6, "normal": 0.02, "color": 1e-3}
# Of the geometric mean; 1.5 is the aim.
MOST_OF_MEAN = 2.0


def write_obj(path, rows, columns, place, coords, chart_of=lambda r, c: 0, head="", before=lambda r, c: ""):
    """A grid of quadrilaterals; `coords(r, c, chart)` at each corner of each chart."""
    lines, numbers = [head] if head else [], {}
    for r in range(rows + 1):
        for c in range(columns + 1):
            lines.append("v %.9g %.9g %.9g" % place(r, c))
    faces = []
    for r in range(rows):
        for c in range(columns):
            chart = chart_of(r, c)
            corners = []
            for i, j in ((r, c), (r, c + 1), (r + 1, c + 1), (r + 1, c)):
                key = (i, j, chart)
                if key not in numbers:
                    numbers[key] = len(numbers) + 1
                    lines.append("vt %.9g %.9g" % coords(i, j, chart))
                corners.append("%d/%d" % (i * (columns + 1) + j + 1, numbers[key]))
            faces.append(before(r, c) + "f " + " ".join(corners))
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines + faces) + "\n")


def write_ply(path, vertices, colors, faces):
    with open(path, "wb") as file:
        file.write(("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
                    "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face %d\n"
                    "property list uchar int vertex_indices\nend_header\n" % (len(vertices), len(faces))).encode())
        for p, c in zip(vertices, colors):
            file.write(struct.pack("<3f3B", *p, *c))
        for f in faces:
            file.write(struct.pack("<B3i", 3, *f))


def torus(rows, columns, rough, seed):
    """A painted torus: its vertices, colours and faces."""
    noise = random.Random(seed)
    phases = [noise.uniform(0, 6.28) for _ in range(8)]
    vertices, colors, faces = [], [], []
    for r in range(rows):
        for c in range(columns):
            u, v = 2 * math.pi * r / rows, 2 * math.pi * c / columns
            bump = sum(math.sin((k + 2) * u + phases[k]) * math.cos((k + 3) * v + phases[k + 4]) / (k + 1) for k in range(4))
            radius = 1 + rough * bump + rough * 0.05 * noise.uniform(-1, 1)
            vertices.append(((3 + radius * math.cos(v)) * math.cos(u), (3 + radius * math.cos(v)) * math.sin(u), radius * math.sin(v)))
            band = 200 if math.sin(5 * u + 2 * v + phases[0]) > 0.3 else 40
            colors.append((band, int(127 + 120 * math.sin(3 * v)), int(127 + 120 * math.cos(4 * u))))
            a, b = (r + 1) % rows, (c + 1) % columns
            i, j, k, n = r * columns + c, a * columns + c, a * columns + b, r * columns + b
            faces += [(i, j, k), (i, k, n)]
    return vertices, colors, faces


def make(name, folder):
    """The file of a mesh that is made, and the attributes that are measured."""
    wave = lambda r, c: (c / 40, r / 40, 0.06 * math.sin(c / 5) * math.cos(r / 7))
    if name == "plate":
        vertices = [(c / 40, r / 40, 0) for r in range(41) for c in range(41)]
        faces = [f for r in range(40) for c in range(40) for i in [r * 41 + c] for f in ((i, i + 1, i + 42), (i, i + 42, i + 41))]
        write_ply(f"{folder}/plate.ply", vertices, [(220, 40, 40) if p[0] < 0.5 else (40, 40, 220) for p in vertices], faces)
        return f"{folder}/plate.ply", ["color"]
    if name in ("torus", "scan"):
        rows, columns = (80, 40) if name == "torus" else (500, 400)
        write_ply(f"{folder}/{name}.ply", *torus(rows, columns, 0.12, 62))
        return f"{folder}/{name}.ply", ["color"]
    if name == "labelled":
        with open(f"{folder}/labelled.mtl", "w", encoding="ascii") as file:
            file.write("".join(f"newmtl m{k}\nKd {k / 4} 0.5 0.5\n" for k in range(4)))
        kind = lambda r, c: int(2 + 1.9 * math.sin(r / 9 + c / 13))
        write_obj(f"{folder}/labelled.obj", 40, 40, wave, lambda r, c, _: (c / 40, r / 40), head="mtllib labelled.mtl",
                  before=lambda r, c: f"usemtl m{kind(r, c)}\n")
        return f"{folder}/labelled.obj", ["uv", "material"]
    # A picture that is mirrored about the middle, and a seam there: the two sides show nearly the same.
    write_obj(f"{folder}/mirrored.obj", 40, 40, wave, lambda r, c, side: ((c if side == 0 else 40 - c) / 40 + 0.01 * side, r / 40),
              chart_of=lambda r, c: int(c >= 20))
    return f"{folder}/mirrored.obj", ["uv"]


class Sweep:
    def __init__(self, arete, seed):
        self.arete, self.seed = arete, seed
        self.violations, self.table = [], []

    def violate(self, sentence):
        self.violations.append(sentence)
        print("VIOLATION", sentence, flush=True)

    def said(self, *words):
        done = subprocess.run([self.arete, *map(str, words), "--json"], capture_output=True, text=True, check=False)
        return json.loads(done.stdout) if done.returncode == 0 else done.stderr.strip()

    def measured(self, cut, source, facts, stated):
        """What is stated is expected, so that what exceeds it is searched for more finely; then it ends with 5."""
        within = facts["error"] * (1 + 1e-5) + facts.get("movedByFloats", 0)
        words = [self.arete, "measure", cut, source, "--attributes", "--samples", "5000", "--json", "--expect", repr(within)]
        limits = ",".join(f"{name}:{bound!r}" for name, bound in stated.items())
        done = subprocess.run(words + (["--expect-attribute", limits] if limits else []), capture_output=True, text=True, check=False)
        return json.loads(done.stdout) if done.stdout else {"attributes": {}}

    def ask(self, dice, names, facts):
        """Options of a cut."""
        kind = dice.random()
        if kind < 0.65:
            asked = ["--max-error", f"{10 ** dice.uniform(-1.3, 0.8):.4f}%"]
        elif kind < 0.85:
            most = facts["finestTriangles"]
            asked = ["--max-triangles", int(most * 10 ** dice.uniform(-1.5, -0.1))]
        else:
            low, high = facts["box"]
            middle = [(a + b) / 2 for a, b in zip(low, high)]
            reach = math.dist(low, high)
            way = [dice.gauss(0, 1) for _ in range(3)]
            eye = [m + reach * dice.uniform(0.4, 1.5) * w / math.hypot(*way) for m, w in zip(middle, way)]
            asked = ["--camera=" + ",".join(f"{x:.6g}" for x in eye + middle), "--pixel-error", f"{10 ** dice.uniform(-0.3, 1):.3f}"]
        name = dice.choice(names)
        if kind < 0.65 and dice.random() < 0.6 and name in SLACK:
            limit = {"uv": 10 ** dice.uniform(-2.5, -1), "normal": dice.uniform(5, 40), "color": dice.uniform(4, 60)}[name]
            asked += ["--attribute-error", f"{name}:{limit:.5f}"]
        return asked

    def run(self, name, source, names, cuts, folder):
        start = time.time()
        model = f"{folder}/{name}.amt"
        built = self.said("build", source, "-o", model, "--attributes")
        if isinstance(built, str):
            self.violate(f"{name}: {built}")
            return
        facts = {"finestTriangles": self.said("extract", model, "-o", f"{folder}/all.ply", "--max-error", 0)["finestTriangles"],
                 "box": box_of(source)}
        dice = random.Random(f"{self.seed} {name}")
        asked = [["--max-error", share] for share in ("0.1%", "0.5%", "2%")] + [self.ask(dice, names, facts) for _ in range(cuts)]
        ratios, checks, refused = [], 0, 0
        # A glTF has corners, and colours that are rounded to linear ones of 16 bits.
        output = f"{folder}/cut.ply" if names == ["color"] else f"{folder}/cut.glb"
        for options in asked:
            cut = self.said("extract", model, "-o", output, *options)
            if isinstance(cut, str):
                refused += 1
                continue
            cut = cut["exports"][0]
            stated = cut["attributeErrors"]
            found = self.measured(output, source, cut, {n: stated[n] for n in names if stated.get(n) is not None})
            for attribute in names:
                checks += 1
                of = found["attributes"].get(attribute)
                largest = math.inf if of is None or of["largest"] is None else of["largest"]
                allowed = stated.get(attribute, 0)
                allowed = math.inf if allowed is None else allowed
                if largest > allowed * (1 + 1e-6) + SLACK.get(attribute, 0):
                    self.violate(f"{name} {' '.join(map(str, options))}: {attribute} off by {largest}, stated {allowed}")
                elif largest > 10 * SLACK.get(attribute, 0) and math.isfinite(allowed):  # what is found is no rounding
                    ratios.append(allowed / largest)
        mean = math.exp(sum(map(math.log, ratios)) / len(ratios)) if ratios else 1.0
        self.table.append((name, len(asked), refused, checks, mean, time.time() - start, ratios))
        print(f"{name:10} {len(asked) - refused:5} cuts, {refused} refused, {checks} checks, stated over found {mean:.3f}, {time.time() - start:.0f} s",
              flush=True)


def box_of(path):
    if path.endswith(".ply"):
        with open(path, "rb") as file:
            data = file.read()
        head = data[:data.index(b"end_header\n")].decode()
        count = int(head.split("element vertex ")[1].split("\n")[0])
        at = len(head) + len("end_header\n")
        places = [struct.unpack_from("<3f", data, at + 15 * i) for i in range(count)]
    else:
        with open(path, encoding="utf-8", errors="replace") as file:
            places = [tuple(map(float, line.split()[1:4])) for line in file if line.startswith("v ")]
    return [min(p[k] for p in places) for k in range(3)], [max(p[k] for p in places) for k in range(3)]


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    options.add_argument("--arete", required=True)
    options.add_argument("--data", default="")
    options.add_argument("--cuts", type=int, default=200)
    options.add_argument("--scan-cuts", type=int, default=10)
    options.add_argument("--seed", type=int, default=62)
    options.add_argument("--only", default="")
    asked = options.parse_args()
    names = ["spot", "fuze", "pirate", "plate", "torus", "labelled", "mirrored", "scan"]
    sweep = Sweep(asked.arete, asked.seed)
    print(f"seed {asked.seed}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            if asked.only and name not in asked.only.split(","):
                continue
            if name in ("spot", "fuze", "pirate"):
                source = os.path.join(asked.data, "meshes", f"{name}.obj")
                if not os.path.exists(source):
                    print(f"{name}: the real data is not there", flush=True)
                    continue
                attributes = ["uv"] if name == "spot" else ["uv", "normal"]
            else:
                source, attributes = make(name, folder)
            sweep.run(name, source, attributes, asked.scan_cuts if name == "scan" else asked.cuts, folder)
    if not sweep.table:
        return 77
    ratios = [ratio for row in sweep.table for ratio in row[6]]
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios)) if ratios else 1.0
    print(f"{sum(row[3] for row in sweep.table)} checks, {len(sweep.violations)} violations, stated over found {mean:.3f}")
    return 1 if sweep.violations or mean > MOST_OF_MEAN else 0


if __name__ == "__main__":
    sys.exit(main())
