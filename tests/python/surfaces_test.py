# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces answer in Python what the command answers."""

import json
import os
import pickle
import tempfile
import unittest

import numpy as np

import arete
from models_test import command


def ball(rows=40, columns=60):
    """A bumpy ball, its poles single vertices."""
    v, u = np.meshgrid(np.linspace(0, np.pi, rows + 1)[1:-1], np.arange(columns) * 2 * np.pi / columns, indexing="ij")
    radius = 10 + 0.6 * np.sin(5 * u) * np.sin(v) ** 2 + 0.4 * np.cos(7 * v)
    ring = np.stack([radius * np.sin(v) * np.cos(u), radius * np.sin(v) * np.sin(u), radius * np.cos(v)], axis=-1)
    vertices = np.concatenate([ring.reshape(-1, 3), [[0, 0, 10.4], [0, 0, -10.4]]])
    vertices = np.round(vertices, 4)
    top, bottom = len(vertices) - 2, len(vertices) - 1
    triangles = []
    for i in range(rows - 2):
        for j in range(columns):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            triangles += [(a, a + columns, b), (b, a + columns, b + columns)]
    last = (rows - 2) * columns
    for j in range(columns):
        triangles += [(top, j, (j + 1) % columns), (bottom, last + (j + 1) % columns, last + j)]
    return vertices, np.array(triangles)


def write_obj(path, vertices, triangles):
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(f"v {x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in vertices)
        file.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles)


class Attributes(unittest.TestCase):
    def test_are_arrays_and_are_measured(self):
        with tempfile.TemporaryDirectory() as folder:
            scan, small = os.path.join(folder, "scan.obj"), os.path.join(folder, "small.obj")
            n = 12
            with open(scan, "w", encoding="utf-8") as file:
                for r in range(n + 1):
                    for c in range(n + 1):
                        file.write(f"v {c / n} {r / n} 0\nvt {c / n + 0.1 * np.sin(3 * r / n)} {r / n}\n")
                for r in range(n):
                    for c in range(n):
                        corners = [r * (n + 1) + c + 1, r * (n + 1) + c + 2, (r + 1) * (n + 1) + c + 2, (r + 1) * (n + 1) + c + 1]
                        file.write("f " + " ".join(f"{v}/{v}" for v in corners) + "\n")
            cut = arete.build_surface(scan).cut(max_error=0)
            uv = cut.vertex_attributes.get("uv")
            if uv is None:
                self.assertEqual(cut.wedges.shape, cut.triangles.shape)
                uv = np.empty((len(cut.vertices), 2))
                uv[cut.triangles] = cut.wedge_attributes["uv"][cut.wedges]
            np.testing.assert_allclose(uv[:, 0], cut.vertices[:, 0] + 0.1 * np.sin(3 * cut.vertices[:, 1]), atol=1e-6)
            for values in {**cut.vertex_attributes, **cut.wedge_attributes}.values():
                self.assertFalse(values.flags.writeable)
            arete.build_surface(scan).cut(max_triangles=2).save(small)
            found = arete.measure(small, scan, samples=500, expect_attribute="uv:0.5")
            self.assertTrue(found["attributes_kept"])
            self.assertGreater(found["attributes"]["uv"]["largest"], 0.01)
            self.assertFalse(arete.measure(small, scan, samples=500, expect_attribute="uv:0.001")["attributes_kept"])
            with self.assertRaisesRegex(TypeError, "between files"):
                arete.measure(cut, scan, attributes=True)


    def test_importance_divides_the_error(self):
        with tempfile.TemporaryDirectory() as folder:
            scan = os.path.join(folder, "scan.ply")
            n = 24
            with open(scan, "w", encoding="utf-8") as file:
                file.write(f"ply\nformat ascii 1.0\nelement vertex {(n + 1) ** 2}\nproperty double x\nproperty double y\n"
                           "property double z\nproperty double quality\n"
                           f"element face {n * n}\nproperty list uchar int vertex_indices\nend_header\n")
                for r in range(n + 1):
                    for c in range(n + 1):
                        file.write(f"{c} {r} {np.sin(c) * np.cos(r)} {9 if c > n / 2 else 1}\n")
                for r in range(n):
                    for c in range(n):
                        v = r * (n + 1) + c
                        file.write(f"4 {v} {v + 1} {v + n + 2} {v + n + 1}\n")
            surface = arete.build_surface(scan)
            plain, cut = surface.cut(max_error=0.9), surface.cut(max_error=0.9, importance="quality")
            self.assertEqual(len(surface.cut(max_error=0.1).triangles) > len(cut.triangles), True)
            on_side = lambda tin: int((tin.vertices[:, 0] > n / 2 + 1).sum())  # noqa: E731
            self.assertGreater(on_side(cut), 2 * on_side(plain))
            with self.assertRaisesRegex(ValueError, "importance"):
                surface.cut(max_error=0.9, importance="heat")


class Surfaces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.vertices, cls.triangles = ball()
        cls.mesh = os.path.join(cls.folder.name, "ball.obj")
        write_obj(cls.mesh, cls.vertices, cls.triangles)
        cls.file = os.path.join(cls.folder.name, "ball.amt")
        cls.surface = arete.build_surface(cls.mesh)
        cls.surface.save(cls.file)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def said(self, *words, file=None):
        return json.loads(command("extract", file or self.file, "-o", self.path("cut.obj"), *words, "--json"))["exports"][0]

    def test_a_file_builds_to_the_bytes_of_the_command(self):
        for options, saving, words in (({}, {}, []), ({"displacement": True}, {}, ["--displacement"]),
                                       ({"keep_borders": True}, {"packed": True, "position_bits": 16},
                                        ["--keep-borders", "--packed", "--position-bits", 16])):
            with self.subTest(options):
                arete.build_surface(self.mesh, **options).save(self.path("python.amt"), **saving)
                command("build", self.mesh, "-o", self.path("command.amt"), "--quiet", *words)
                with open(self.path("python.amt"), "rb") as ours, open(self.path("command.amt"), "rb") as theirs:
                    self.assertEqual(ours.read(), theirs.read())

    def test_cuts_are_limited_ordered_and_focused_as_the_command_has_it(self):
        for options, words in (({"max_error": 0.02, "focus": (10, 0, 0), "error_growth": 0.05, "outside_error": 1},
                                ["--max-error", 0.02, "--focus", "10,0,0", "--error-growth", 0.05, "--outside-error", 1]),
                               ({"max_triangles": 300, "order": "worst"}, ["--max-triangles", 300, "--order", "worst"]),
                               ({"max_triangles": "10%"}, ["--max-triangles", "10%"]),
                               ({"max_error": 0.1, "deadline": 1e6}, ["--max-error", 0.1, "--deadline", 1e6])):
            with self.subTest(options):
                tin, said = self.surface.cut(**options), self.said(*words)
                self.assertEqual(len(tin.triangles), said["triangles"])
                self.assertEqual(tin.error, said["error"])
                self.assertEqual(tin.is_complete, said["complete"])
        early = self.surface.cut(deadline=1e-9)
        self.assertFalse(early.is_complete)
        self.assertGreater(len(early.triangles), 3)
        for wrong in ({"focus": (1, 0, 0)}, {"error_growth": 1}, {"focus": (1, 0), "error_growth": 1}, {"order": "depth"},
                      {"deadline": -1}, {"deadline": 5, "order": "two-queues"}, {"deadline": 5, "fit": "rms"}):
            with self.subTest(wrong), self.assertRaises(ValueError):
                self.surface.cut(max_error=0.1, **wrong)

    def test_parts_are_left_out_and_a_cut_is_written_with_where_it_comes_from(self):
        far = self.vertices[:4] / 1000 + [30, 0, 0]
        far[3] += [0, 0, 0.01]
        n = len(self.vertices)
        both = arete.build_surface(np.concatenate([self.vertices, far]),
                                   np.concatenate([self.triangles, n + np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])]))
        tin = both.cut(max_error=0.1, drop_parts="5%")
        self.assertLess(tin.vertices[:, 0].max(), 15)
        self.assertTrue(np.array_equal(tin.vertices, np.concatenate([self.vertices, far])[tin.source_vertices]))
        with self.assertRaisesRegex(ValueError, "drop_parts"):
            both.cut(max_error=0.1, drop_parts=1e6)
        tin = self.surface.cut(max_error=0.1)
        self.assertEqual(tin.save(self.path("python.ply")), [])
        command("extract", self.file, "-o", self.path("command.ply"), "--max-error", 0.1, "--quiet")
        with open(self.path("python.ply"), "rb") as ours, open(self.path("command.ply"), "rb") as theirs:
            self.assertEqual(ours.read(), theirs.read())

    def test_arrays_build_what_their_file_does(self):
        wanted = self.surface.cut(max_error=0.1)
        for vertices, triangles in ((self.vertices, self.triangles), (self.vertices.astype(">f8"), self.triangles.astype("i2")),
                                    (np.asfortranarray(self.vertices), self.triangles.tolist()),
                                    (self.vertices[::-1][::-1], np.asfortranarray(self.triangles.astype(np.uint64)))):
            tin = arete.build_surface(vertices, triangles).cut(max_error=0.1)
            self.assertTrue(np.array_equal(tin.vertices, wanted.vertices))
            self.assertTrue(np.array_equal(tin.triangles, wanted.triangles))

        class Trimesh:
            vertices, faces = self.vertices, self.triangles

        class Meshio:
            points, cells_dict = self.vertices, {"triangle": self.triangles}

        for mesh in (Trimesh(), Meshio()):
            self.assertTrue(np.array_equal(arete.build_surface(mesh).cut(max_error=0.1).vertices, wanted.vertices))
        again = arete.build_surface(wanted)  # a Tin
        self.assertEqual(again.finest_triangles, len(wanted.triangles))

    def test_arrays_that_are_no_mesh_are_named(self):
        broken = self.vertices.copy()
        broken[7, 1] = np.nan
        for vertices, triangles, error in ((self.vertices, self.triangles + 10**6, ValueError),
                                           (self.vertices, self.triangles - 1, ValueError),
                                           (self.vertices, self.triangles + 0.5, ValueError),
                                           (self.vertices[:, :2], self.triangles, ValueError),
                                           (self.vertices, self.triangles[:, :2], ValueError),
                                           (broken, self.triangles, ValueError),
                                           (self.vertices.astype(complex), self.triangles, TypeError),
                                           (self.vertices, None, TypeError),
                                           (self.mesh, self.triangles, TypeError)):
            with self.assertRaises(error):
                arete.build_surface(vertices, triangles)
        with self.assertRaises((ValueError, RuntimeError)):
            arete.build_surface(self.vertices, self.triangles[:0])
        with self.assertRaises(FileNotFoundError):
            arete.build_surface(self.path("none.ply"))

        class Quads:
            points, cells_dict = self.vertices, {"quad": np.zeros((1, 4), int)}

        with self.assertRaisesRegex(ValueError, "quad"):
            arete.build_surface(Quads())

    def test_a_cut_is_that_of_the_command(self):
        write_obj(self.path("inner.obj"), self.vertices * 0.5 + (8, 0, 0), self.triangles)
        for options, words in (
                ({"max_error": 0.2}, ["--max-error", 0.2]),
                ({"max_triangles": 400}, ["--max-triangles", 400]),
                ({"max_error": 0.05, "region": (0, 0, 0, 20, 20, 20)}, ["--max-error", 0.05, "--region", "0,0,0,20,20,20"]),
                ({"max_error": 0.05, "region": (9, 0, 0, 4), "outside_error": 0.7},
                 ["--max-error", 0.05, "--region", "9,0,0,4", "--outside-error", 0.7]),
                ({"max_error": 0.05, "region": self.path("inner.obj")},
                 ["--max-error", 0.05, "--region", self.path("inner.obj")]),
                ({"max_error": 0.05, "region": (self.vertices * 0.5 + (8, 0, 0), self.triangles)},
                 ["--max-error", 0.05, "--region", self.path("inner.obj")]),
                ({"camera": arete.SurfaceCamera((40, 0, 0), (0, 0, 0), viewport=(640, 480)), "pixel_error": 3},
                 ["--camera", "40,0,0,0,0,0", "--viewport", "640x480", "--pixel-error", 3]),
                ({"camera": arete.SurfaceCamera((0, 0, 40), (0, 0, 0), fov=30), "max_triangles": 600},
                 ["--camera", "0,0,40,0,0,0,30", "--max-triangles", 600]),
                ({"max_triangles": 400, "fit": "rms"}, ["--max-triangles", 400, "--fit", "rms"]),
                ({"max_error": 0.2, "fit": "rms"}, ["--max-error", 0.2, "--fit", "rms"])):
            with self.subTest(options):
                tin = self.surface.cut(**options)
                said = self.said(*words)
                self.assertEqual((len(tin.triangles), len(tin.vertices)), (said["triangles"], said["vertices"]))
                self.assertEqual(tin.error, said["error"])
                with open(self.path("cut.obj"), encoding="utf-8") as file:
                    vertices = np.array([[float(n) for n in line.split()[1:4]] for line in file if line[:2] == "v "])
                self.assertTrue(np.allclose(vertices, tin.vertices, rtol=0, atol=1e-12))
        for options, error in (({}, TypeError), ({"max_error": -1}, ValueError), ({"max_triangles": 1}, ValueError),
                               ({"max_error": 1, "region": (1, 2, 3)}, ValueError),
                               ({"max_error": 1, "region": (1, 2, 3, -1)}, ValueError),
                               ({"max_error": 1, "region": (1, 0, 0, 0, 1, 1)}, ValueError),
                               ({"max_error": 1, "region": object()}, TypeError),
                               ({"max_error": 1, "region": (self.vertices, self.triangles[1:])}, ValueError),
                               ({"max_error": 1, "fit": "error"}, ValueError),
                               ({"max_error": 1, "outside_error": 0.5, "region": (0, 0, 0, 1)}, ValueError),
                               ({"camera": arete.SurfaceCamera((1, 1, 1), (1, 1, 1))}, ValueError),
                               ({"camera": arete.SurfaceCamera((1, 1), (1, 1, 1))}, ValueError),
                               ({"camera": arete.SurfaceCamera((40, 0, 0), (0, 0, 0)), "max_error": 1}, ValueError)):
            with self.subTest(options), self.assertRaises(error):
                self.surface.cut(**options)

    def test_displaced_cuts_are_nearer_at_the_same_error(self):
        surface = arete.build_surface(self.vertices, self.triangles, displacement=True)
        self.assertTrue(surface.is_displaced)
        tin, plain = surface.cut(max_triangles=300), surface.cut(max_triangles=300, displaced=False)
        self.assertEqual(tin.error, plain.error)
        self.assertLess(surface.measure(tin, samples=20000)["from_source"]["rms"],
                        surface.measure(plain, samples=20000)["from_source"]["rms"])

    def test_distances_are_those_of_the_command(self):
        tin = self.surface.cut(max_triangles=300)
        write_obj(self.path("tin.obj"), tin.vertices, tin.triangles)
        found = self.surface.measure(tin, samples=50000)
        said = json.loads(command("measure", self.mesh, self.path("tin.obj"), "--samples", 50000, "--json"))
        self.assertLessEqual(found["from_source"]["max_distance"], tin.error)
        # The samples are others: the vertices are in another order.
        both = said["bothWays"]
        self.assertAlmostEqual(found["max_distance"], both["maximum"], delta=0.002 * both["maximum"])
        for number, theirs in ((found["rms"], both["rms"]), (found["mean"], both["mean"])):
            self.assertAlmostEqual(number, theirs, delta=0.01 * theirs)
        with self.assertRaises((ValueError, RuntimeError)):
            self.surface.measure(tin.vertices, tin.triangles[:0])

    def test_a_surface_is_pickled_by_its_file(self):
        again = pickle.loads(pickle.dumps(arete.open(self.file)))
        self.assertIsInstance(again, arete.Surface)
        self.assertTrue(np.array_equal(again.cut(max_error=0.2).vertices, self.surface.cut(max_error=0.2).vertices))
        with self.assertRaisesRegex(TypeError, "save"):
            pickle.dumps(arete.build_surface(self.vertices, self.triangles))


if __name__ == "__main__":
    unittest.main()
