# SPDX-License-Identifier: GPL-3.0-or-later
"""Models answer in Python what the command answers."""

import gc
import json
import os
import pickle
import signal
import subprocess
import tempfile
import threading
import time
import unittest

import numpy as np

import arete
from arrays_test import Affine

PLACE = Affine(30, 0, 500000, 0, -30, 4000000)


def hills(rows=120, columns=150):
    y, x = np.mgrid[0:rows, 0:columns]
    return 100 * np.sin(x / 9) * np.cos(y / 13) + x + 0.37 * y


def command(*words):
    done = subprocess.run([os.environ["ARETE"], *map(str, words)], capture_output=True, text=True, check=True)
    return done.stdout


class Models(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.model = arete.build(hills(), transform=PLACE, crs=32611)
        cls.file = os.path.join(cls.folder.name, "hills.amt")
        cls.model.save(cls.file)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def test_a_cut_is_that_of_the_command(self):
        for options, words in (({"max_error": 4}, ["--max-error", 4]), ({"max_triangles": 500}, ["--max-triangles", 500]),
                               ({"max_error": 1, "region": (500500, 3998000, 502000, 3999000)},
                                ["--max-error", 1, "--region", "500500,3998000,502000,3999000"])):
            with self.subTest(options):
                tin = self.model.cut(**options)
                said = json.loads(command("extract", self.file, "-o", self.path("tin.obj"), *words, "--json"))["exports"][0]
                self.assertEqual((len(tin.triangles), len(tin.vertices)), (said["triangles"], said["vertices"]))
                self.assertEqual(tin.error, said["storedError"])
                with open(self.path("tin.obj"), encoding="utf-8") as file:
                    lines = [line.split() for line in file if line[:2] in ("v ", "f ")]
                vertices = np.array([[float(n) for n in line[1:4]] for line in lines if line[0] == "v"])
                triangles = np.array([[int(n) - 1 for n in line[1:4]] for line in lines if line[0] == "f"])
                self.assertTrue(np.array_equal(vertices, tin.vertices))
                self.assertTrue(np.array_equal(triangles, tin.triangles))

    def test_a_cut_for_a_camera_is_that_of_the_command(self):
        place = (500300, 3997000, 40)
        for options, camera, words in (
                ({"pixel_error": 2}, arete.Camera(place, azimuth=40, pitch=-10, viewport=(800, 600)),
                 ["--look", "40,-10", "--viewport", "800x600", "--pixel-error", 2]),
                ({}, arete.Camera(place, azimuth=-30, fov=35), ["--look", "-30,0", "--fov", 35]),
                ({"max_triangles": 800}, arete.Camera(place, azimuth=40), ["--look", "40,0", "--max-triangles", 800]),
                ({"outside_error": 9}, arete.Camera((500300, 3997000, 400), reference="msl"), ["--outside-error", 9])):
            with self.subTest(options):
                tin = self.model.cut(camera=camera, **options)
                where = f"{place[0]},{place[1]},400msl" if camera.reference == "msl" else ",".join(map(str, place))
                said = json.loads(command("extract", self.file, "-o", self.path("view.obj"), "--camera", where, *words,
                                          "--json"))["exports"][0]
                self.assertEqual((len(tin.triangles), len(tin.vertices), tin.error),
                                 (said["triangles"], said["vertices"], said["storedError"]))
                self.assertEqual(tin.pixels, said["pixels"])
        self.assertIsNone(self.model.cut(max_error=3).pixels)
        for camera in (arete.Camera((0, 0, 10)), arete.Camera((500300, 3997000)), arete.Camera(place, fov=190),
                       arete.Camera(place, pitch=100), arete.Camera(place, viewport=(0, 100)),
                       arete.Camera(place, reference="sea"), arete.Camera((500300, 3997000, float("nan")))):
            with self.subTest(camera), self.assertRaises(ValueError):
                self.model.cut(camera=camera)
        for options in ({"max_error": 1}, {"region": (500500, 3998000, 502000, 3999000)}, {"pixel_error": 0},
                        {"fit": "error"}):
            with self.subTest(options), self.assertRaises(ValueError):
                self.model.cut(camera=arete.Camera(place), **options)

    def test_a_fit_is_that_of_the_command(self):
        for fit, options, words in (("triangles", {"max_error": 4}, ["--max-error", 4]),
                                    ("error", {"max_triangles": 500}, ["--max-triangles", 500]),
                                    ("unbiased", {"max_error": 4}, ["--max-error", 4])):
            tin = self.model.cut(fit=fit, **options)
            said = json.loads(command("extract", self.file, "-o", self.path("fit.obj"), *words, "--fit", fit,
                                      "--json"))["exports"][0]
            self.assertEqual((len(tin.triangles), tin.error), (said["triangles"], said["storedError"]))
            self.assertLessEqual(self.model.measure(tin)["max_abs_error"], tin.error * (1 + 1e-12))
        for options in ({"fit": "best", "max_error": 1}, {"fit": "triangles", "max_triangles": 500}):
            with self.assertRaises(ValueError):
                self.model.cut(**options)

    def test_a_profile_is_that_of_the_command(self):
        line = [(500300, 3999000), (503000, 3997500), (503500, 3999500)]
        for options, words in (({}, []), ({"max_error": 2}, ["--max-error", 2]), ({"earth": "plane"}, ["--earth", "plane"])):
            found = self.model.profile(line, **options)
            said = json.loads(command("profile", self.file, "--along", ":".join(f"{x},{y}" for x, y in line), *words,
                                      "--json"))["lines"][0]
            self.assertEqual(found.length, said["length"])
            self.assertEqual(found.gap, said["gap"])
            self.assertEqual(found.distance.tolist(), [v["distance"] for v in said["vertices"]])
            self.assertEqual(found.height.tolist(), [v["height"] for v in said["vertices"]])
            self.assertEqual(found.places.tolist(), [[v["x"], v["y"]] for v in said["vertices"]])
        self.assertEqual(set(found.part), {1})
        holed = hills()
        holed[50:60, 60:70] = np.nan
        over = arete.build(holed, transform=PLACE, crs=32611).profile([(501000, 3998300), (503000, 3998300)])
        self.assertEqual(over.part.tolist(), sorted(over.part.tolist()))
        self.assertEqual(set(over.part), {1, 2})
        self.assertGreater(over.gap, 200)
        away = self.model.profile([(0, 0), (10, 0)])
        self.assertEqual(len(away.distance), 0)
        for bad in ([(500300, 3999000)], [(1, 2, 3), (4, 5, 6)], [(1, float("nan")), (2, 3)], [[1, 2], [3]]):
            with self.subTest(bad), self.assertRaises(ValueError):
                self.model.profile(bad)

    def test_a_file_builds_to_the_bytes_of_the_command(self):
        np.savetxt(self.path("points.xyz"), np.random.default_rng(1).uniform(0, 100, (500, 3)), fmt="%.6f")
        for name in ("points.xyz",):
            arete.build(self.path(name)).save(self.path("python.amt"))
            command("build", self.path(name), "-o", self.path("command.amt"), "--quiet")
            with open(self.path("python.amt"), "rb") as ours, open(self.path("command.amt"), "rb") as theirs:
                self.assertEqual(ours.read(), theirs.read())

    def test_a_tin_keeps_its_error_and_turns_counter_clockwise(self):
        tin = self.model.cut(max_error=3)
        self.assertLessEqual(tin.error, 3)
        self.assertEqual(tin.error, tin.errors.max())
        corners = tin.vertices[tin.triangles]
        edges = corners[:, 1:, :2] - corners[:, :1, :2]
        areas = np.cross(edges[:, 0], edges[:, 1]) / 2
        self.assertTrue((areas > 0).all())
        self.assertAlmostEqual(areas.sum(), 149 * 30 * 119 * 30, delta=1e-3)

    def test_arrays_are_read_only_views_that_keep_their_owner(self):
        tin = self.model.cut(max_error=3)
        arrays = [tin.vertices, tin.triangles, tin.errors]
        self.assertEqual([array.dtype for array in arrays], [np.float64, np.uint32, np.float32])
        self.assertEqual(tin.vertices.ctypes.data, arrays[0].ctypes.data)
        copies = [array.copy() for array in arrays]
        for array in arrays:
            self.assertFalse(array.flags.writeable)
            with self.assertRaises(ValueError):
                array[0] = 0
            with self.assertRaises(ValueError):
                array.flags.writeable = True
        del tin
        gc.collect()
        self.model.cut(max_error=1)  # takes memory that was given back
        for array, copy in zip(arrays, copies):
            self.assertTrue(np.array_equal(array, copy))

    def test_heights_are_those_of_the_samples_and_of_the_command(self):
        wanted = hills()
        x, y = 500015 + 30 * np.arange(150), 3999985 - 30 * np.arange(120)
        found = self.model.height(x[np.newaxis, :], y[:, np.newaxis])
        self.assertTrue(np.array_equal(found, wanted))
        self.assertIsInstance(self.model.height(500100, 3999000), float)
        self.assertTrue(np.isnan(self.model.height(0, 0)))
        self.assertEqual(self.model.height([], []).shape, (0,))
        said = json.loads(command("height", self.file, "--at", "500100,3999000", "--json"))
        text = json.dumps(said)
        self.assertIn(repr(self.model.height(500100, 3999000))[:12], text)
        rough = self.model.height(x[np.newaxis, :], y[:, np.newaxis], max_error=5)
        self.assertLessEqual(np.abs(rough - wanted).max(), 5)

    def test_lines_of_sight_are_those_of_the_command(self):
        verdicts = set()
        for observer, target in (((500300, 3999000, 10), (503000, 3997500, 10)), ((500300, 3999000, 200), (503000, 3997500, 200)),
                                 ((501000, 3998000, 2), (501500, 3998100, 2))):
            one = self.model.los(observer, target)
            said = json.loads(command("los", self.file, "--from", ",".join(map(str, observer)), "--to",
                                      ",".join(map(str, target)), "--json"))
            self.assertEqual((one.verdict, one.clearance, one.distance),
                             (said["verdict"], said["clearance"], said["distance"]))
            place = said.get("obstruction")
            self.assertEqual(one.obstruction, (place["x"], place["y"]) if place else None)
            self.assertEqual(one.visible, one.verdict == "visible")
            verdicts.add(one.verdict)
        self.assertEqual(verdicts, {"visible", "blocked"})
        x = np.linspace(500300, 503000, 50)
        targets = np.stack([x, np.full(50, 3997500.0), np.full(50, 10.0)], axis=1)
        many = self.model.los((500300, 3999000, 10), targets)
        for i in (0, 17, 49):
            one = self.model.los((500300, 3999000, 10), targets[i])
            self.assertEqual(many.verdict[i], one.verdict)
            self.assertAlmostEqual(many.clearance[i], one.clearance, places=9)
        self.assertEqual(many.visible.dtype, bool)
        with self.assertRaisesRegex(ValueError, "observer 0"):
            self.model.los((0, 0, 10), (501000, 3998000, 2))
        with self.assertRaisesRegex(ValueError, "earth=round"):
            self.model.los((500300, 3999000, 10), (501000, 3998000, 2), earth="round")
        with self.assertRaises(ValueError):
            self.model.los((500300, 3999000), (501000, 3998000))

    def test_a_viewshed_is_that_of_the_command(self):
        for options, words in (({}, []), ({"radius": 900, "target_height": 5}, ["--radius", 900, "--target-height", 5])):
            seen = self.model.viewshed((501000, 3998500, 10), **options)
            self.assertEqual((seen.shape, seen.dtype), ((120, 150), np.uint8))
            said = json.loads(command("viewshed", self.file, "--observer", "501000,3998500,10", *words, "-o",
                                      self.path("seen.tif"), "--json"))
            counts = {255: "seen", 0: "hidden", 1: "outside"}
            for value, name in counts.items():
                self.assertEqual(int((seen == value).sum()), said[name], name)

    def test_a_tin_is_measured_against_every_sample(self):
        tin = self.model.cut(max_error=3)
        found = self.model.measure(tin)
        self.assertLessEqual(found["max_abs_error"], 3)
        self.assertEqual((found["covered"], found["uncovered"]), (120 * 150, 0))
        moved = tin.vertices.copy()
        moved[:, 2] += 10
        worse = self.model.measure(moved, tin.triangles)
        self.assertAlmostEqual(worse["mean_error"], found["mean_error"] + 10, places=9)
        half = self.model.measure(tin.vertices, tin.triangles[: len(tin.triangles) // 2])
        self.assertGreater(half["uncovered"], 1000)
        for triangles in ([[0, 1, 10**6]], [[0, 1]], [[0.5, 1, 2]], None):
            with self.assertRaises((ValueError, TypeError)):
                self.model.measure(tin.vertices, triangles)

    def test_places_a_turn_away_are_on_the_terrain(self):
        model = arete.build(hills(80, 80), transform=Affine(0.025, 0, 179, 0, -0.025, 1), crs=4326)  # 179 to 181
        x = np.array([180.25, 180.7])
        self.assertTrue(np.isfinite(model.height(x, 0.3)).all())
        self.assertTrue(np.array_equal(model.height(x, 0.3), model.height(x - 360, 0.3)))
        there, here = (model.cut(max_error=1, region=(left, -0.5, left + 0.5, 0.5)) for left in (180.2, -179.8))
        self.assertTrue(np.array_equal(there.vertices, here.vertices))
        self.assertEqual(model.los((-179.75, 0.3, 5), (-179.3, 0.3, 5)), model.los((180.25, 0.3, 5), (180.7, 0.3, 5)))

    def test_a_map_without_longitudes_is_a_plane(self):
        local = 'LOCAL_CS["a site",UNIT["metre",1]]'
        model = arete.build(hills(40, 40), transform=Affine(10, 0, 0, 0, -10, 400), crs=local)
        self.assertIn(model.los((50, 200, 5), (300, 200, 5)).verdict, ("visible", "blocked"))
        for refraction in (0.2, 99, float("nan")):
            with self.assertRaisesRegex(ValueError, "refraction"):
                model.los((50, 200, 5), (300, 200, 5), refraction=refraction)

    def test_a_mesh_is_refused_by_name(self):
        with open(self.path("mesh.obj"), "w", encoding="utf-8") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        with self.assertRaisesRegex(ValueError, "is a mesh: arete.build_surface"):
            arete.build(self.path("mesh.obj"))

    def test_xarray_has_the_source_to_the_bit(self):
        try:
            import xarray  # noqa: F401
        except ImportError:
            self.skipTest("xarray is not installed")
        array = self.model.to_xarray()
        self.assertTrue(np.array_equal(array.values, hills()))
        self.assertEqual(float(array.x[0]), 500015)
        self.assertEqual(float(array.y[1]), 3999955)
        coarse = self.model.to_xarray(cell=90)
        self.assertEqual(float(coarse.x[1] - coarse.x[0]), 90)

    def test_meshio_has_points_and_cells(self):
        try:
            import meshio  # noqa: F401
        except ImportError:
            self.skipTest("meshio is not installed")
        tin = self.model.cut(max_error=3)
        mesh = tin.to_meshio()
        self.assertEqual(len(mesh.points), len(tin.vertices))
        self.assertEqual(len(mesh.cells_dict["triangle"]), len(tin.triangles))

    def test_a_model_is_pickled_by_its_file(self):
        again = pickle.loads(pickle.dumps(arete.open(self.file)))
        self.assertTrue(np.array_equal(again.cut(max_error=3).vertices, self.model.cut(max_error=3).vertices))
        with self.assertRaisesRegex(TypeError, "save"):
            pickle.dumps(arete.build(hills(10, 10)))

    def test_two_threads_ask_one_model(self):
        wanted = self.model.cut(max_error=2).vertices.copy()
        found = []

        def ask():
            for _ in range(10):
                found.append(np.array_equal(self.model.cut(max_error=2).vertices, wanted))

        threads = [threading.Thread(target=ask) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [True] * 20)

    def test_progress_is_reported_and_what_it_raises_is_raised(self):
        seen = []
        arete.build(hills(300, 300), progress=lambda stage, part: seen.append((stage, part)))
        self.assertTrue(seen)
        self.assertTrue(all(isinstance(stage, str) and 0 <= part <= 1 for stage, part in seen))

        class Mine(Exception):
            pass

        def stop(stage, part):
            raise Mine(stage)

        with self.assertRaises(Mine):
            arete.build(hills(300, 300), progress=stop)
        with self.assertRaises(TypeError):
            arete.build(hills(300, 300), progress=3)

    def test_ctrl_c_ends_a_build(self):
        # A shell that starts the tests in the background has them ignore it.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        threading.Timer(0.15, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(200):
                arete.build(hills(600, 600))
        self.assertLess(time.monotonic() - begin, 60)

    def test_what_makes_no_sense_is_named(self):
        for options in ({"max_error": -1}, {"max_error": float("nan")}, {"max_triangles": 1},
                        {"max_error": 1, "region": (3, 0, 1, 1)}, {"max_error": 1, "region": (0, 0, 1, 1)},
                        {"max_error": 1, "outside_error": 5}):
            with self.subTest(options), self.assertRaises(ValueError):
                self.model.cut(**options)
        with self.assertRaises(TypeError):
            self.model.cut()
        with self.assertRaisesRegex(FileNotFoundError, "everywhere"):
            self.model.cut(max_error=1, region="everywhere")
        with self.assertRaises(FileNotFoundError):
            arete.open(self.path("none.amt"))
        with self.assertRaises(FileNotFoundError):
            arete.build(self.path("none.tif"))
        with open(self.path("damaged.amt"), "wb") as damaged, open(self.file, "rb") as whole:
            content = bytearray(whole.read())
            content[len(content) // 2] ^= 255
            damaged.write(content)
        with self.assertRaisesRegex(RuntimeError, "damaged.amt"):
            arete.open(self.path("damaged.amt"))
        with self.assertRaisesRegex(ValueError, "shape=round"):
            arete.build(hills(10, 10), shape="round")


if __name__ == "__main__":
    unittest.main()
