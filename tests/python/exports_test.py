# SPDX-License-Identifier: GPL-3.0-or-later
"""What save() writes in every format, with certificates; what a model says of itself; meshes mended and made smaller."""

import json
import os
import pickle
import re
import subprocess
import tempfile
import unittest
import warnings

import numpy as np

import arete

COMMAND = os.environ.get("ARETE", "arete")


class Affine(tuple):
    a, b, c, d, e, f = (property(lambda self, i=i: self[i]) for i in range(6))


PLACE = Affine((30, 0, 500000, 0, -30, 4000000))


def hills(rows=60, columns=80):
    y, x = np.mgrid[0:rows, 0:columns]
    return np.round(100 * np.sin(x / 9) * np.cos(y / 7) + 500, 2)


def ball(turns=24):
    """A closed ball, its vertices and triangles."""
    rows = [np.array([[0, 0, 1.0]])]
    for k in range(1, turns // 2):
        polar, around = np.pi * k / (turns // 2), 2 * np.pi * np.arange(turns) / turns
        rows.append(np.column_stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around),
                                     np.full(turns, np.cos(polar))]))
    vertices = np.concatenate([*rows, [[0, 0, -1.0]]])
    triangles, last = [], len(vertices) - 1
    for i in range(turns):
        j = (i + 1) % turns
        triangles += [(0, 1 + i, 1 + j), (last, last - turns + j, last - turns + i)]
        for k in range(turns // 2 - 2):
            a, b = 1 + k * turns, 1 + (k + 1) * turns
            triangles += [(a + i, b + i, b + j), (a + i, b + j, a + j)]
    return vertices, np.array(triangles)


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = lambda name: os.path.join(folder.name, name)

    def said(self, *words):
        done = subprocess.run([COMMAND, *map(str, words), "--json"], check=True, capture_output=True)
        return json.loads(done.stdout)

    def bytes_of(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()


class Terrain(Folder):
    @classmethod
    def setUpClass(cls):
        cls.model = arete.build(hills(), transform=PLACE, crs=32611, vertical_unit="m")

    def test_every_format_is_measured_within_the_tolerance(self):
        self.model.save(self.path("dem.amt"))
        tin = self.model.cut(max_error=2)
        for extension in ("ply", "obj", "off", "stl", "glb", "gltf", "2dm", "gpkg"):
            with self.subTest(extension):
                lost = tin.save(self.path(f"a.{extension}"))
                self.assertEqual(lost, tin.save(self.path(f"b.{extension}"), certificate=True))
                with open(self.path("b.certificate.json"), encoding="utf-8") as file:
                    certificate = json.load(file)
                self.assertTrue(certificate["kept"] if "kept" in certificate else certificate["promise"]["kept"])
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    found = self.model_errors(self.path(f"b.{extension}"))
                self.assertLessEqual(found, 2)
        self.assertEqual(tin.save(self.path("a.ply")), [])

    def model_errors(self, path):
        """Measured by the command against heights of a grid."""
        rows = "\n".join(" ".join(repr(z) for z in row) for row in hills().tolist())
        with open(self.path("dem.asc"), "w", encoding="utf-8") as file:
            file.write(f"ncols 80\nnrows 60\nxllcorner 500000\nyllcorner {4000000 - 60 * 30}\ncellsize 30\n{rows}\n")
        return self.said("measure", path, self.path("dem.asc"))["error"]["maximum"]

    def test_the_files_are_those_of_the_command(self):
        self.model.save(self.path("dem.amt"))
        model = arete.open_model(self.path("dem.amt"))
        model.cut(max_error=2).save(self.path("ours.ply"), certificate=self.path("ours.json"),
                                    error_raster=self.path("ours.tif"))
        self.said("extract", self.path("dem.amt"), "-o", self.path("theirs.ply"), "--max-error", 2, "--certificate",
                  self.path("theirs.json"), "--error-raster", self.path("theirs.tif"))
        self.assertEqual(self.bytes_of("ours.ply"), self.bytes_of("theirs.ply"))
        self.assertEqual(self.bytes_of("ours.tif"), self.bytes_of("theirs.tif"))
        ours, theirs = (json.loads(self.bytes_of(name)) for name in ("ours.json", "theirs.json"))
        self.assertEqual(ours["measured"] if "measured" in ours else ours, theirs["measured"] if "measured" in theirs else theirs)
        self.assertEqual(set(ours), set(theirs))

    def test_a_packed_file_is_that_of_the_command(self):
        self.model.save(self.path("dem.amt"))
        tin = arete.open_model(self.path("dem.amt")).cut(max_error=5)
        for bits, words in ((None, ()), (16, ("--position-bits", 16))):
            with self.subTest(bits=bits):
                tin.save(self.path("ours.glb"), packed=True, position_bits=bits)
                self.said("extract", self.path("dem.amt"), "-o", self.path("theirs.glb"), "--max-error", 5, "--packed", *words)
                self.assertEqual(self.bytes_of("ours.glb"), self.bytes_of("theirs.glb"))
        with self.assertRaisesRegex(TypeError, "normals is for surfaces"):
            tin.save(self.path("ours.glb"), normals="smooth")

    def test_a_raster_is_the_tin_on_the_grid(self):
        self.model.cut(max_error=2).save(self.path("tin.tif"))
        again = arete.build(self.path("tin.tif"))
        self.assertEqual((again.shape, again.transform), (self.model.shape, self.model.transform))
        off = np.abs(again.to_xarray().values - hills()) if HAS_XARRAY else np.array([2.0])
        self.assertLessEqual(off.max(), 2.001)

    def test_a_certificate_says_the_region_and_how_to_check(self):
        box = (500300, 3998600, 501200, 3999500)
        tin = self.model.cut(max_error=1, region=box, outside_error=20)
        tin.save(self.path("part.ply"), certificate=True)
        text = self.bytes_of("part.certificate.json").decode()
        self.assertIn("500300", text)
        # Of an array there is no file to check against.
        self.assertEqual(json.loads(text)["check"], "")

    def test_the_check_of_a_certificate_runs(self):
        rows = "\n".join(" ".join(repr(z) for z in row) for row in hills().tolist())
        with open(self.path("dem.asc"), "w", encoding="utf-8") as file:
            file.write(f"ncols 80\nnrows 60\nxllcorner 500000\nyllcorner {4000000 - 60 * 30}\ncellsize 30\n{rows}\n")
        model = arete.build(self.path("dem.asc"), crs=32611, vertical_unit="ft")
        box = (500300, 3998600, 501200, 3999500)
        for region in (None, box):
            model.cut(max_error=1, region=region).save(self.path("part.ply"), certificate=True)
            check = json.loads(self.bytes_of("part.certificate.json"))["check"]
            self.assertIn("vertical_unit='ft'", check)
            found = eval(check, {"arete": arete})
            self.assertTrue(found["kept"])
            self.assertEqual(found["covered"] < 4800, region is not None)

    def test_the_check_of_a_certificate_is_kept_wherever_the_mesh_was_placed(self):
        try:
            import rasterio
        except ModuleNotFoundError:
            self.skipTest("rasterio is not installed")

        y, x = np.mgrid[0:40, 0:50]
        for crs, transform in (("EPSG:4269", (0.002, 0, -110, 0, -0.002, 45)), ("EPSG:32611", (30, 0, 500000, 0, -30, 4000000))):
            with rasterio.open(self.path("dem.tif"), "w", driver="GTiff", height=40, width=50, count=1, dtype="float32",
                               crs=crs, transform=rasterio.Affine(*transform)) as file:
                file.write((100 * np.sin(x / 9) * np.cos(y / 7) + 500).astype("f4"), 1)
            model = arete.build(self.path("dem.tif"))
            tin = model.cut(max_error=2)
            for name, place in (("m.obj", {"metric": True}), ("m.ply", {"metric": True}), ("m.stl", {"metric": True}),
                                ("u.obj", {"to_crs": "utm"}), ("w.ply", {"to_crs": "EPSG:3857"}), ("w.stl", {"to_crs": "EPSG:3857"}),
                                ("d.off", {"to_crs": "EPSG:4326"})):
                with self.subTest(crs=crs, name=name), warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    tin.save(self.path(name), certificate=True, **place)
                    certificate = os.path.splitext(name)[0] + ".certificate.json"
                    found = eval(json.loads(self.bytes_of(certificate))["check"], {"arete": arete})
                    self.assertTrue(found["kept"], found)
                    self.assertEqual(found["covered"], 2000)
                    stated = ["--tin-crs", "EPSG:3857"] if name == "w.stl" else []
                    said = self.said("measure", self.path(name), self.path("dem.tif"), *stated)
                    self.assertEqual(found["max_abs_error"], said["error"]["maximum"])
            with self.assertRaisesRegex(ValueError, "tin_crs=EPSG:4326.*contradicts"):
                arete.measure(self.path("w.ply"), self.path("dem.tif"), tin_crs=4326)
            for wrong in ("utm", "EPSG:nothing"):
                with self.assertRaisesRegex(ValueError, "tin_crs"):
                    arete.measure(self.path("w.stl"), self.path("dem.tif"), tin_crs=wrong)
            with self.assertRaisesRegex(TypeError, "tin_crs"):
                arete.measure(self.path("w.stl"), self.path("w.ply"), tin_crs=3857)
            tin.save(self.path("zone.stl"), certificate=True, to_crs="utm")
            self.assertEqual(json.loads(self.bytes_of("zone.certificate.json"))["check"], "")
        # Of another DEM's model, a Tin says itself where it is.
        with rasterio.open(self.path("dem.tif")) as file:
            heights = file.read(1)
        self.assertTrue(arete.measure(tin, self.path("dem.tif"), expect=2)["kept"])
        there = arete.build(heights, crs="EPSG:3857", transform=PLACE).cut(max_error=2)
        self.assertEqual(arete.measure(there, self.path("dem.tif"))["covered"], 0)

    def test_a_source_is_not_written_over(self):
        try:
            import rasterio
        except ModuleNotFoundError:
            self.skipTest("rasterio is not installed")

        with rasterio.open(self.path("dem.tif"), "w", driver="GTiff", height=60, width=80, count=1, dtype="float32",
                           crs="EPSG:32611", transform=rasterio.Affine(*PLACE)) as file:
            file.write(hills().astype("f4"), 1)
        before = self.bytes_of("dem.tif")
        os.symlink(self.path("dem.tif"), self.path("link.tif"))
        os.link(self.path("dem.tif"), self.path("hard.tif"))
        os.symlink(self.path("dem.tif"), self.path("link.amt"))
        with rasterio.open(self.path("dem.tif")) as dataset:
            read = arete.build(dataset)
        for model in (arete.build(self.path("dem.tif")), arete.build([self.path("dem.tif")]), read):
            tin = model.cut(max_error=20)
            for name in ("dem.tif", "link.tif", "hard.tif", "./dem.tif"):
                with self.subTest(name), self.assertRaisesRegex(ValueError, "source.*destroy"):
                    tin.save(self.path(name))
                with self.assertRaisesRegex(ValueError, "source.*destroy"):
                    tin.save(self.path("t.ply"), error_raster=self.path(name))
                with self.assertRaisesRegex(ValueError, "source.*destroy"):
                    tin.save(self.path("t.ply"), certificate=self.path(name))
            with self.assertRaisesRegex(ValueError, "link.amt.*dem.tif.*destroy"):
                model.save(self.path("link.amt"))
            for name in ("dem.tif", "x.tif", "x"):
                with self.assertRaisesRegex(ValueError, "x?.*must end in .amt"):
                    model.save(self.path(name))
            model.save(self.path("m.amt"))
            model.save(self.path("m.amt"))  # it lives in memory
            with self.assertRaisesRegex(ValueError, "destroy"):
                model.cut(max_error=20).save(self.path("t.ply"), certificate=self.path("m.amt"))
        self.assertEqual(self.bytes_of("dem.tif"), before)
        self.assertFalse(os.path.exists(self.path("x.tif")))

    def test_two_outputs_are_two_files(self):
        tin = self.model.cut(max_error=20)
        for name, options in (("t.tif", {"error_raster": "t.tif"}), ("t.ply", {"certificate": "t.ply"}),
                              ("t.ply", {"error_raster": "e.tif", "certificate": "./e.tif"}),
                              ("t.ply", {"certificate": True, "error_raster": "t.certificate.json"})):
            stated = {key: value if value is True else self.path(value) for key, value in options.items()}
            with self.subTest(name, **options), self.assertRaisesRegex(ValueError, "another output"):
                tin.save(self.path(name), **stated)
        self.assertFalse(os.path.exists(self.path("t.ply")))

    def test_a_mesh_is_not_written_over(self):
        arete.build_surface(*ball()).cut(max_error=0).save(self.path("ball.obj"))
        before = self.bytes_of("ball.obj")
        os.symlink(self.path("ball.obj"), self.path("link.obj"))
        mended = arete.repair(self.path("ball.obj"))
        for made in (arete.decimate(self.path("ball.obj"), max_triangles=200), mended, pickle.loads(pickle.dumps(mended)),
                     arete.decimate(mended, max_triangles=200), arete.build_surface(self.path("ball.obj")).cut(max_triangles=200)):
            for name in ("ball.obj", "link.obj"):
                with self.assertRaisesRegex(ValueError, "source.*destroy"):
                    made.save(self.path(name))
            made.save(self.path("other.obj"))
        with self.assertRaisesRegex(ValueError, "must end in .amt"):
            arete.build_surface(self.path("ball.obj")).save(self.path("ball.obj"))
        self.assertEqual(self.bytes_of("ball.obj"), before)

    def test_what_is_not_for_terrain_is_refused(self):
        for options in ({"map": "m.csv"}, {"both_ways": True}, {"drop_attributes": "normal"}):
            with self.assertRaisesRegex(TypeError, next(iter(options))):
                self.model.cut(max_error=2).save(self.path("t.ply"), **options)

    def test_what_cannot_be_certified_is_refused(self):
        with self.assertRaisesRegex(ValueError, "deadline"):
            self.model.cut(deadline=50).save(self.path("t.ply"), certificate=True)
        with self.assertRaisesRegex(ValueError, "pickled"):
            pickle.loads(pickle.dumps(self.model.cut(max_error=2))).save(self.path("t.ply"), certificate=True)
        self.assertFalse(os.path.exists(self.path("t.ply")))
        for name in ("t.xyz", "t"):
            with self.assertRaisesRegex(ValueError, name):
                self.model.cut(max_error=2).save(self.path(name))

    def test_info_curve_and_laws_are_those_of_the_command(self):
        self.model.save(self.path("dem.amt"))
        said = self.said("info", self.path("dem.amt"))
        info = self.model.info()
        for ours, theirs in (("samples", "samples"), ("finest_triangles", "finestTriangles"), ("relief", "relief"),
                             ("root_triangles", "rootTriangles"), ("levels", "levels"), ("source_checksum", "sourceChecksum")):
            if theirs in said:
                self.assertEqual(info[ours], said[theirs], theirs)
        curve = self.model.curve()
        self.assertEqual(curve.minimal.tolist(), [point["minimalTriangles"] if "minimalTriangles" in point else point["minimal"]
                                                  for point in said["curve"]])
        for error, count in zip(curve.max_error, curve.minimal):
            self.assertEqual(len(self.model.cut(max_error=error).triangles), count)
        at = self.model.curve(at=[1, "5%"])
        self.assertAlmostEqual(at.max_error[1], 0.05 * info["relief"])
        self.assertEqual(len(self.model.curve(curve=2).max_error), 2)
        answer = self.model.validate()
        self.assertTrue(answer["holds"])
        self.assertEqual(len(answer["laws"]), 10)

    def test_heights_that_differ_from_the_source_are_found(self):
        rows = "\n".join(" ".join(repr(z) for z in row) for row in hills().tolist())
        head = f"ncols 80\nnrows 60\nxllcorner 500000\nyllcorner {4000000 - 60 * 30}\ncellsize 30\n"
        for name, text in (("dem.asc", rows), ("other.asc", rows.replace("500.0", "501.0", 1))):
            with open(self.path(name), "w", encoding="utf-8") as file:
                file.write(head + text + "\n")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            model = arete.build(self.path("dem.asc"), crs=32611)
            self.assertEqual(model.validate(against=self.path("dem.asc"))["heights_compared"], 4800)
            answer = model.validate(against=self.path("other.asc"))
        self.assertFalse(answer["holds"])
        self.assertIn("1 ", answer["violation"])

    def test_measure_takes_a_dem_and_a_region(self):
        rows = "\n".join(" ".join(repr(z) for z in row) for row in hills().tolist())
        with open(self.path("dem.asc"), "w", encoding="utf-8") as file:
            file.write(f"ncols 80\nnrows 60\nxllcorner 500000\nyllcorner {4000000 - 60 * 30}\ncellsize 30\n{rows}\n")
        tin = self.model.cut(max_error=2)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = arete.measure(tin, self.path("dem.asc"), expect=2)
            self.assertTrue(found["kept"])
            self.assertFalse(arete.measure(tin, self.path("dem.asc"), expect=0.1)["kept"])
            part = arete.measure(tin, self.path("dem.asc"), region=(500300, 3998600, 501200, 3999500))
        # The grid is of 32-bit floats.
        self.assertAlmostEqual(found["max_abs_error"], self.model.measure(tin)["max_abs_error"], places=3)
        inside = self.model.measure(tin, region=(500300, 3998600, 501200, 3999500))
        self.assertEqual(part["covered"], inside["covered"])
        self.assertAlmostEqual(part["max_abs_error"], inside["max_abs_error"], places=3)
        self.assertLess(part["covered"], found["covered"])

    def test_methods_and_orders_are_those_of_the_command(self):
        self.model.save(self.path("dem.amt"))
        said = self.said("extract", self.path("dem.amt"), "-o", self.path("t.ply"), "--max-error", 2, "--method", "saturated")
        self.assertEqual(len(self.model.cut(max_error=2, method="saturated").triangles), said["exports"][0]["triangles"])


HAS_XARRAY = __import__("importlib.util").util.find_spec("xarray") is not None


class Opening(Folder):
    def test_the_kind_is_known_or_refused(self):
        arete.build(hills()).save(self.path("dem.amt"))
        arete.build_surface(*ball()).save(self.path("ball.amt"))
        self.assertIsInstance(arete.open_model(self.path("dem.amt")), arete.Model)
        self.assertIsInstance(arete.open_surface(self.path("ball.amt")), arete.Surface)
        with self.assertRaisesRegex(TypeError, "open_surface"):
            arete.open_model(self.path("ball.amt"))
        with self.assertRaisesRegex(TypeError, "open_model"):
            arete.open_surface(self.path("dem.amt"))
        with self.assertRaises(FileNotFoundError):
            arete.open_model(self.path("none.amt"))


class Surfaces(Folder):
    def setUp(self):
        super().setUp()
        self.vertices, self.triangles = ball()
        self.surface = arete.build_surface(self.vertices, self.triangles)

    def test_packed_files_and_normals_are_those_of_the_command(self):
        self.surface.save(self.path("ball.amt"))
        cut = arete.open_surface(self.path("ball.amt")).cut(max_error=0.01)
        for options, words in (({"packed": True}, ("--packed",)),
                               ({"packed": True, "position_bits": 9}, ("--packed", "--position-bits", 9)),
                               ({"normals": "flat"}, ("--normals", "flat")),
                               ({"normals": "smooth", "crease_angle": 20}, ("--normals", "smooth", "--crease-angle", 20)),
                               ({"packed": True, "normals": "smooth"}, ("--packed", "--normals", "smooth"))):
            with self.subTest(**options):
                cut.save(self.path("ours.glb"), **options)
                self.said("extract", self.path("ball.amt"), "-o", self.path("theirs.glb"), "--max-error", 0.01, *words)
                self.assertEqual(self.bytes_of("ours.glb"), self.bytes_of("theirs.glb"))

    def test_a_mesh_is_packed_and_has_normals_as_by_the_command(self):
        self.surface.cut(max_error=0).save(self.path("ball.obj"))
        mended = arete.repair(self.path("ball.obj"))
        for options, words in (({"packed": True, "position_bits": 10}, ("--packed", "--position-bits", 10)),
                               ({"normals": "smooth"}, ("--normals", "smooth"))):
            with self.subTest(**options):
                mended.save(self.path("ours.glb"), **options)
                self.said("mesh", "repair", self.path("ball.obj"), "-o", self.path("theirs.glb"), *words)
                self.assertEqual(self.bytes_of("ours.glb"), self.bytes_of("theirs.glb"))

    def test_packing_that_has_no_meaning_is_refused_by_name(self):
        cut = self.surface.cut(max_error=0.1)
        for error, name, options in (("position_bits", "a.glb", {"position_bits": 12}),
                                     ("position_bits", "a.glb", {"packed": True, "position_bits": 17}),
                                     ("packed is for glTF", "a.ply", {"packed": True}),
                                     ("crease_angle", "a.glb", {"crease_angle": 30}),
                                     ("crease_angle", "a.glb", {"normals": "smooth", "crease_angle": 181}),
                                     ("normals", "a.glb", {"normals": "round"})):
            with self.subTest(**options), self.assertRaisesRegex(ValueError, error):
                cut.save(self.path(name), **options)
        with self.assertRaisesRegex(ValueError, "without"):
            cut.save(self.path("a.glb"), packed=True, map=self.path("map.csv"))
        self.assertFalse(os.path.exists(self.path("a.glb")))

    def test_a_certificate_and_a_map_are_those_of_the_command(self):
        self.surface.save(self.path("ball.amt"))
        surface = arete.open_surface(self.path("ball.amt"))
        surface.cut(max_triangles=200).save(self.path("ours.ply"), certificate=True, map=self.path("ours.csv"))
        self.said("extract", self.path("ball.amt"), "-o", self.path("theirs.ply"), "--max-triangles", 200, "--certificate",
                  "--map", self.path("theirs.csv"))
        self.assertEqual(self.bytes_of("ours.csv"), self.bytes_of("theirs.csv"))
        self.assertEqual(self.bytes_of("ours.ply"), self.bytes_of("theirs.ply"))
        ours, theirs = (json.loads(self.bytes_of(f"{name}.certificate.json")) for name in ("ours", "theirs"))
        self.assertEqual(set(ours), set(theirs))

    def test_creases_are_lines_where_they_are_wanted(self):
        # A roof of 2 x 8 squares whose ridge is turned by 28 degrees.
        vertices = [[x, y, 0.25 * (1 - abs(x - 1))] for y in range(9) for x in range(3)]
        triangles = [t for y in range(8) for a in (3 * y, 3 * y + 1) for t in ([a, a + 1, a + 4], [a, a + 4, a + 3])]
        for angle, ridge in ((20, 1), (30, 0)):
            surface = arete.build_surface(vertices, triangles, crease_angle=angle)
            self.assertTrue(surface.validate()["holds"])
            kept = surface.cut(max_error="100%")
            ends = [i for i, v in enumerate(kept.vertices) if v[0] == 1 and v[1] in (0, 8)]
            edges = {frozenset((int(t[i]), int(t[i - 1]))) for t in kept.triangles for i in range(3)}
            self.assertEqual(frozenset(ends) in edges and len(ends) == 2, bool(ridge))
        with self.assertRaisesRegex(ValueError, "crease_angle"):
            arete.build_surface(vertices, triangles, crease_angle=181)

    def test_curve_and_laws(self):
        curve = self.surface.curve(at=["1%", "5%"])
        for error, count in zip(curve.max_error, curve.minimal):
            self.assertEqual(len(self.surface.cut(max_error=error).triangles), count)
        self.assertTrue(self.surface.validate()["holds"])
        self.assertEqual(self.surface.info()["kind"], "surface")

    def test_what_is_the_matter_is_what_the_command_says(self):
        holed = np.concatenate([self.triangles[5:], self.triangles[20:21]])
        with open(self.path("holed.obj"), "w", encoding="utf-8") as file:
            file.write("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in self.vertices.tolist()))
            file.write("".join(f"f {a} {b} {c}\n" for a, b, c in (holed + 1).tolist()))
        said = self.said("mesh", "info", self.path("holed.obj"))
        for info in (arete.mesh_info(self.path("holed.obj")), arete.mesh_info(self.vertices, holed)):
            self.assertEqual(info["verdict"], said["verdict"])
            self.assertEqual(info["findings"]["duplicate_faces"]["count"], 1)
            self.assertEqual(len(info["borders"]), len(said["borders"]))
        self.assertAlmostEqual(arete.mesh_info(self.vertices, self.triangles)["volume"], 4 / 3 * np.pi, delta=0.2)
        self.assertIsNone(arete.mesh_info(self.vertices, holed, self_intersections=False)["findings"]["self_intersections"])

    def test_a_mended_mesh_is_that_of_the_command(self):
        holed = np.concatenate([self.triangles[:40], self.triangles[41:], self.triangles[20:21]])
        with open(self.path("holed.obj"), "w", encoding="utf-8") as file:
            file.write("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in self.vertices.tolist()))
            file.write("".join(f"f {a} {b} {c}\n" for a, b, c in (holed + 1).tolist()))
        mended = arete.repair(self.path("holed.obj"), fill_holes=8)
        said = self.said("mesh", "repair", self.path("holed.obj"), "-o", self.path("theirs.ply"), "--fill-holes", 8)
        self.assertEqual(mended.report["mended"]["filled_holes"], said["mended"]["filledHoles"])
        self.assertEqual(mended.report["mended"]["duplicate_faces"], 1)
        self.assertTrue(mended.report["result"]["is_closed"])
        self.assertEqual(len(mended.triangles), len(self.triangles))
        mended.save(self.path("ours.ply"))
        self.assertEqual(arete.mesh_info(self.path("ours.ply"))["verdict"], arete.mesh_info(self.path("theirs.ply"))["verdict"])
        self.assertTrue(np.array_equal(self.vertices[mended.source_vertices], mended.vertices))
        again = pickle.loads(pickle.dumps(mended))
        self.assertEqual((type(again), again.report), (arete.Mesh, mended.report))
        with self.assertRaisesRegex(TypeError, "weld"):
            arete.repair(mended, weld="much")

    def test_decimation_has_the_operators_of_the_command(self):
        with open(self.path("ball.obj"), "w", encoding="utf-8") as file:
            file.write("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in self.vertices.tolist()))
            file.write("".join(f"f {a} {b} {c}\n" for a, b, c in (self.triangles + 1).tolist()))
        for operator in ("measured", "qem", "lindstrom-turk", "half-edge", "vertex-pair", "face", "cluster"):
            with self.subTest(operator):
                small = arete.decimate(self.path("ball.obj"), max_triangles="20%", operator=operator)
                said = self.said("mesh", "decimate", self.path("ball.obj"), "-o", self.path("t.ply"), "--max-triangles", "20%",
                                 "--operator", operator)
                self.assertEqual(len(small.triangles), said["triangles"])
                self.assertLessEqual(len(small.triangles), len(self.triangles) // 5)
                self.assertEqual(small.report["error"], said.get("error"))
        near = arete.decimate(self.vertices, self.triangles, max_error="1%")
        found = arete.measure((self.vertices, self.triangles), near, samples=20000)
        self.assertLessEqual(found["max_distance"], 0.05)
        self.assertTrue(arete.measure(near, (self.vertices, self.triangles), samples=20000, expect="1%")["kept"])
        self.assertFalse(arete.measure(near, (self.vertices, self.triangles), samples=20000, expect=1e-9)["kept"])
        for options, error, name in (
                ({}, ValueError, "max_triangles"), ({"max_error": 1, "operator": "qem"}, ValueError, "max_error"),
                ({"max_triangles": 50, "operator": "best"}, ValueError, "operator"),
                ({"max_triangles": 50, "queue": "greedy"}, ValueError, "queue.*operator"),
                ({"max_triangles": 0}, ValueError, "max_triangles"), ({"max_triangles": "200%"}, ValueError, "max_triangles"),
                ({"max_triangles": 2}, ValueError, "max_triangles 2"), ({"max_triangles": "x"}, TypeError, "max_triangles"),
                ({"max_triangles": 50, "drop_parts": 99}, ValueError, "drop_parts")):
            with self.subTest(options), self.assertRaisesRegex(error, name):
                arete.decimate(self.vertices, self.triangles, **options)

    def test_the_options_of_a_build_are_those_of_the_command(self):
        with open(self.path("ball.obj"), "w", encoding="utf-8") as file:
            file.write("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in self.vertices.tolist()))
            file.write("".join(f"f {a} {b} {c}\n" for a, b, c in (self.triangles + 1).tolist()))
        self.said("build", self.path("ball.obj"), "-o", self.path("theirs.amt"), "--ratio", 1.5, "--max-degree", 8)
        arete.build_surface(self.path("ball.obj"), ratio=1.5, max_degree=8).save(self.path("ours.amt"))
        self.assertEqual(self.bytes_of("ours.amt"), self.bytes_of("theirs.amt"))


class Sights(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.model = arete.build(hills(), transform=PLACE, crs=32611, vertical_unit="m")

    def test_radio_and_clutter(self):
        ends = ((500100, 3999500, 60), (502000, 3999000, 60))
        plain = self.model.los(*ends)
        radio = self.model.los(*ends, frequency=900, fresnel=0.6)
        self.assertEqual(plain[:3], radio[:3])
        self.assertIsNone(plain.fresnel)
        self.assertEqual(radio.is_clear, radio.fresnel >= 0.6)
        self.assertTrue(0 <= plain.azimuth < 360)
        wooded = self.model.los(*ends, clutter=30, clutter_free=50)
        self.assertLess(wooded.clearance, plain.clearance)
        for method in ("descent", "pyramid", "scan", "embree"):
            self.assertEqual(self.model.los(*ends, method=method).verdict, plain.verdict)
        for options in ({"method": "guess"}, {"fresnel": 1}, {"clutter_free": 1}, {"frequency": -1}, {"clutter": -1}):
            with self.subTest(options), self.assertRaisesRegex(ValueError, next(iter(options))):
                self.model.los(*ends, **options)

    def test_a_profile_of_a_line_of_sight_has_its_answer(self):
        ends = [(500100, 3999500, 20), (502000, 3999000, 20)]
        profile = self.model.profile(ends, frequency=900)
        self.assertEqual(profile.sight.verdict, self.model.los(*ends).verdict)
        self.assertAlmostEqual((profile.line_height - profile.height).min(), profile.sight.clearance, delta=1e-6)
        self.assertGreater(profile.fresnel_radius.max(), 5)
        distance, places, height, part, length, gap = profile
        self.assertEqual(len(profile), 6)
        with self.assertRaisesRegex(ValueError, "line of sight"):
            self.model.profile([end[:2] for end in ends], frequency=900)

    def test_fields_of_view_and_modes(self):
        at = (501200, 3999100, 30)
        whole = np.asarray(self.model.viewshed(at))
        east = np.asarray(self.model.viewshed(at, azimuth=(0, 180)))
        x = 500000 + (np.arange(80) + 0.5) * 30
        self.assertTrue((east[:, x < 501170] == 1).all())
        self.assertTrue(np.array_equal(east[:, x > 501230], whole[:, x > 501230]))
        ring = np.asarray(self.model.viewshed(at, radius=600, min_distance=300))
        self.assertEqual(ring[30, 40], 1)
        both = np.asarray(self.model.viewshed([at, (500300, 3999700, 30)]))
        second = np.asarray(self.model.viewshed((500300, 3999700, 30)))
        self.assertTrue(np.array_equal(both == 255, (whole == 255) | (second == 255)))
        count = np.asarray(self.model.viewshed([at, (500300, 3999700, 30)], mode="count"))
        self.assertTrue(np.array_equal(count, (whole == 255).astype(int) + (second == 255)))
        height = np.asarray(self.model.viewshed(at, mode="height"))
        self.assertTrue(np.array_equal(height == 0, whole == 255))
        self.assert_answers_are_those_of_the_mode(at)
        for options in ({"mode": "colour"}, {"azimuth": (5, 5)}, {"elevation": (5, 1)}, {"min_distance": 9, "radius": 5},
                        {"method": "guess"}):
            with self.subTest(options), self.assertRaisesRegex(ValueError, next(iter(options))):
                self.model.viewshed(at, **options)
        with self.assertRaisesRegex(ValueError, "observer"):
            self.model.viewshed((1, 2))

    def assert_answers_are_those_of_the_mode(self, at):
        marks = {0: "hidden", 65533: "unknown", 65534: "undecided", 65535: "outside"}
        for mode in ("count", "server"):
            found = self.model.viewshed([at, (500300, 3999700, 30)], mode=mode, radius=300)
            for one in (found, found.copy(), pickle.loads(pickle.dumps(found))):
                self.assertEqual(one.answers, marks)
            self.assertIn(65535, np.asarray(found))
            self.assertNotIn(1, found.answers)
            if HAS_XARRAY:
                attributes = found.to_xarray().attrs
                self.assertEqual(attributes["_FillValue"], 65535)
                self.assertEqual(attributes["_FillValue"].dtype, found.dtype)
                self.assertEqual(dict(zip(attributes["flag_values"].tolist(), attributes["flag_meanings"].split())), marks)
        for mode in ("height", "horizon"):
            self.assertEqual(self.model.viewshed(at, mode=mode).answers, {})
        self.assertEqual(self.model.viewshed(at).answers[1], "outside")


if __name__ == "__main__":
    unittest.main()
