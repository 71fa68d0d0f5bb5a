# SPDX-License-Identifier: GPL-3.0-or-later
"""What a build takes: grids of other modules, points, files with their options. The same heights are the same model."""

import importlib.util
import os
import subprocess
import tempfile
import unittest
import warnings

import numpy as np

import arete

COMMAND = os.environ.get("ARETE", "arete")


def has(*modules):
    return all(importlib.util.find_spec(module) for module in modules)


def hills(rows=24, columns=31):
    y, x = np.mgrid[0:rows, 0:columns]
    return np.round(100 * np.sin(x / 9) * np.cos(y / 7) + 3 * (x * y % 5) + 300)


class Affine(tuple):
    a, b, c, d, e, f = (property(lambda self, i=i: self[i]) for i in range(6))


PLACE = Affine((30, 0, 500000, 0, -30, 4000000))


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = lambda name: os.path.join(folder.name, name)

    def bytes_of(self, model):
        model.save(self.path("model.amt"))
        with open(self.path("model.amt"), "rb") as file:
            return file.read()

    def heights_of(self, model):
        return model.to_xarray().values


@unittest.skipUnless(has("xarray"), "xarray is not installed")
class Xarrays(Folder):
    def test_what_to_xarray_gives_builds_the_same_model(self):
        heights = hills()
        heights[3:6, 4:9] = np.nan
        heights[7, 8] = 1 / 3
        model = arete.build(heights, transform=PLACE, crs=32611)
        again = arete.build(model.to_xarray())
        self.assertEqual((again.transform, again.crs, again.shape), (model.transform, model.crs, model.shape))
        self.assertTrue(np.array_equal(self.heights_of(again), heights, equal_nan=True))
        # Far from the origin, where a place has fewer digits.
        far = arete.build(heights, transform=Affine((0.1, 0, 3e6, 0, -0.1, 6e6)), crs=32611)
        self.assertTrue(np.array_equal(self.heights_of(arete.build(far.to_xarray())), heights, equal_nan=True))

    def test_arithmetic_with_the_source_loses_no_row(self):
        import xarray

        x, y = 1000 + 0.3 * np.arange(31), 5000 - 0.3 * np.arange(24)
        for names, rows, columns in ((("y", "x"), y, x), (("y", "x"), y[::-1], x), (("lat", "lon"), y, x),
                                     (("y", "x"), y.astype("f4"), x.astype("f4"))):
            for dtype in ("f8", "f4", "i2"):
                with self.subTest(names=names, dtype=dtype):
                    own = xarray.DataArray(hills().astype(dtype), dims=names, coords={names[0]: rows, names[1]: columns})
                    back = arete.build(own).to_xarray()
                    self.assertEqual((own - back).shape, own.shape)
                    self.assertTrue((own == back).all())
                    self.assertEqual((back.dims, back.dtype), (own.dims, np.float64))
                    for name in names:
                        self.assertTrue(np.array_equal(back[name], own[name]))
        turned = xarray.DataArray(hills().T, dims=("x", "y"), coords={"y": y, "x": x})
        self.assertTrue((arete.build(turned).to_xarray() == turned).all())
        self.assertEqual((arete.build(turned).to_xarray() - turned).size, turned.size)

    def test_an_array_without_a_place_comes_back_where_its_heights_are(self):
        model = arete.build(hills())
        back = model.to_xarray()
        self.assertTrue(np.array_equal(back.values, hills()))
        self.assertEqual(float(back.sel(x=4.5, y=10.5)), model.height(4.5, 10.5))
        with self.assertRaisesRegex(MemoryError, "cell"):
            model.to_xarray(cell=1e-6)
        with self.assertRaisesRegex(ValueError, "cell"):
            model.to_xarray(cell=0)

    def test_a_part_has_its_own_place(self):
        array = arete.build(hills(), transform=PLACE, crs=32611).to_xarray()
        part = arete.build(array[5:20, 7:25])
        self.assertEqual(part.transform, (500000 + 7 * 30, 30, 0, 4000000 - 5 * 30, 0, -30))
        self.assertEqual(part.height(500000 + 9.5 * 30, 4000000 - 8.5 * 30), hills()[8, 9])

    def test_rows_upwards_and_columns_first_are_the_same_terrain(self):
        array = arete.build(hills(), transform=PLACE, crs=32611).to_xarray()
        for form in (array[::-1], array[:, ::-1], array.transpose(), array.expand_dims("band"), array[::-1, ::-1].transpose()):
            model = arete.build(form)
            for row, column in ((0, 0), (3, 20), (23, 30)):
                x, y = 500000 + (column + 0.5) * 30, 4000000 - (row + 0.5) * 30
                self.assertEqual(model.height(x, y), hills()[row, column])

    def test_uneven_coordinates_and_unknown_dimensions_are_refused(self):
        import xarray

        array = arete.build(hills(), transform=PLACE).to_xarray()
        x = array.x.values.copy()
        x[5] += 11
        with self.assertRaisesRegex(ValueError, "x are not equally far apart"):
            arete.build(array.assign_coords(x=x))
        with self.assertRaisesRegex(ValueError, "name them y and x"):
            arete.build(xarray.DataArray(hills(), dims=("here", "there")))
        with self.assertRaisesRegex(TypeError, "height"):
            arete.build(xarray.Dataset({"height": array}))
        with self.assertRaisesRegex(TypeError, "crs is for arrays"):
            arete.build(array, crs=32611)

    def test_raw_values_are_scaled_and_filled(self):
        import xarray

        raw = xarray.DataArray(hills().astype(np.int16), dims=("y", "x"),
                               attrs={"scale_factor": 0.5, "add_offset": 100, "_FillValue": int(hills()[2, 3])})
        heights = self.heights_of_grid(arete.build(raw), raw.shape)
        wanted = np.where(hills() == hills()[2, 3], np.nan, hills() * 0.5 + 100)
        self.assertTrue(np.array_equal(heights, wanted, equal_nan=True))
        holed = hills()
        holed[4:6, 7:9] = -9999
        for name in ("_FillValue", "missing_value"):
            grid = xarray.DataArray(holed, dims=("y", "x"), attrs={name: -9999.0})
            self.assertEqual(np.isnan(self.heights_of_grid(arete.build(grid), grid.shape)).sum(), 4)

    def test_a_unit_that_is_not_known_is_said_and_no_error(self):
        import xarray

        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            arete.build(xarray.DataArray(hills(), dims=("y", "x"), attrs={"units": "m above sea level"}))
        self.assertEqual([warning.message.code for warning in said], ["unit"])
        self.assertNotIn("vsimem", str(said[0].message))
        self.assertEqual(arete.build(xarray.DataArray(hills(), dims=("y", "x"), attrs={"units": "ft"})).vertical_unit, "ft")
        with self.assertRaisesRegex(ValueError, "vertical_unit"):
            arete.build(hills(), vertical_unit="stone")

    def test_depths_are_negated_and_it_is_said(self):
        import xarray

        depths = xarray.DataArray(hills(), dims=("y", "x"), attrs={"positive": "down"})
        with self.assertWarnsRegex(arete.AreteWarning, "negated") as said:
            model = arete.build(depths)
        self.assertEqual((said.warning.code, said.filename), ("heights", __file__))
        self.assertEqual(model.height(0.5, 23.5), -hills()[0, 0])
        self.assertEqual(arete.build(depths, positive="up").height(0.5, 23.5), hills()[0, 0])

    def heights_of_grid(self, model, shape):
        x, y = np.arange(shape[1]) + 0.5, shape[0] - np.arange(shape[0]) - 0.5
        heights = model.height(x[np.newaxis], y[:, np.newaxis])
        return heights


@unittest.skipUnless(has("rasterio"), "rasterio is not installed")
class Rasterio(Folder):
    def write(self, name, array, **options):
        import rasterio

        profile = {"driver": "GTiff", "height": array.shape[0], "width": array.shape[1], "count": 1, "dtype": array.dtype,
                   "transform": rasterio.Affine(*PLACE), "crs": "EPSG:32611", **options}
        with rasterio.open(self.path(name), "w", **profile) as file:
            for band in range(profile["count"]):
                file.write(np.where(array == -9999, -9999, array + band).astype(array.dtype), band + 1)
        return self.path(name)

    def test_a_dataset_is_the_terrain_of_its_file(self):
        import rasterio

        array = hills().astype(np.int16)
        array[4:8, 3:9] = -9999
        path = self.write("dem.tif", array, nodata=-9999, count=2)
        for band in (1, 2):
            with rasterio.open(path) as dataset:
                model = arete.build(dataset, band=band)
            wanted = arete.build(path, band=band)
            self.assertEqual((model.transform, model.shape), (wanted.transform, wanted.shape))
            self.assertTrue(np.array_equal(self.heights_of(model), self.heights_of(wanted), equal_nan=True))
            self.assertTrue(np.isnan(self.heights_of(model)[5, 5]))
        with rasterio.open(path) as dataset, self.assertRaisesRegex(ValueError, "band=3"):
            arete.build(dataset, band=3)

    def test_a_colour_image_is_refused_and_a_choice_said_as_of_its_path(self):
        import rasterio

        def answer(source):
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                try:
                    arete.build(source)
                except ValueError as error:
                    return "looks like a colour image" in str(error)
            return sorted(one.message.code for one in said if isinstance(one.message, arete.AreteWarning))

        for dtype, count, options in ((np.uint8, 3, {}), (np.uint8, 4, {"photometric": "rgb"}), (np.uint16, 3, {"photometric": "rgb"}),
                                      (np.uint8, 1, {}), (np.int16, 2, {}), (np.float32, 3, {}), (np.uint8, 2, {"alpha": "yes"})):
            with self.subTest(dtype=dtype, count=count):
                path = self.write("any.tif", (hills() % 200).astype(dtype), count=count, **options)
                with rasterio.open(path) as dataset:
                    self.assertEqual(answer(dataset), answer(path))
                    if count > 1:
                        self.assertEqual(arete.build(dataset, band=1).shape, (24, 31))

    def test_scales_offsets_and_units_are_those_that_gdal_reads(self):
        import rasterio

        path = self.write("scaled.tif", hills().astype(np.int16))
        with rasterio.open(path, "r+") as file:
            file.scales, file.offsets, file.units = (0.25,), (7,), ("ft",)
        with rasterio.open(path) as dataset:
            model = arete.build(dataset)
        wanted = arete.build(path)
        self.assertTrue(np.array_equal(self.heights_of(model), self.heights_of(wanted)))
        self.assertEqual(model.vertical_unit, wanted.vertical_unit)

    def test_every_option_of_the_command_builds_the_bytes_of_the_command(self):
        path = self.write("dem.tif", hills(60, 70).astype(np.float32))
        with open(self.path("peaks.csv"), "w", encoding="utf-8") as file:
            file.write("x,y\n500315,3999685\n501215,3999385\n")
        for options, words in (
                ({"shape": "fidelity", "min_aspect": 0.1}, ["--shape", "fidelity", "--min-aspect", "0.1"]),
                ({"ratio": 1.3, "max_degree": 9}, ["--ratio", "1.3", "--max-degree", "9"]),
                ({"features": 5}, ["--features", "5"]), ({"features": 0}, ["--no-features"]),
                ({"feature_persistence": "20%"}, ["--feature-persistence", "20%"]),
                ({"feature_persistence": 12}, ["--feature-persistence", "12"]),
                ({"fixed": self.path("peaks.csv")}, ["--fixed", self.path("peaks.csv")]),
                ({"fixed": [(500315, 3999685), (501215, 3999385)]}, ["--fixed", self.path("peaks.csv")]),
                ({"crease_angle": 70}, ["--crease-angle", "70"]), ({"rim_tolerance": 1}, ["--rim-tolerance", "1"]),
                ({"vertical_unit": "ft"}, ["--vertical-unit", "ft"]), ({"positive": "down"}, ["--positive", "down"]),
                ({"nodata": 300}, ["--nodata", "300"]), ({"band": 1}, ["--band", "1"])):
            with self.subTest(options):
                subprocess.run([COMMAND, "build", path, "-o", self.path("said.amt"), *words], check=True, capture_output=True)
                with open(self.path("said.amt"), "rb") as file:
                    said = file.read()
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    self.assertEqual(self.bytes_of(arete.build(path, **options)), said)

    def test_several_files_are_one_terrain(self):
        import rasterio

        left = self.write("left.tif", hills(30, 40)[:, :20].astype(np.float32))
        right = self.write("right.tif", hills(30, 40)[:, 20:].astype(np.float32),
                           transform=rasterio.Affine(30, 0, 500600, 0, -30, 4000000))
        self.assertEqual(arete.build([left, right]).shape, (30, 40))


class Points(Folder):
    def points(self, count=200, seed=7):
        places = np.random.default_rng(seed).uniform(0, 100, (count, 2))
        return np.column_stack([places, np.sin(places[:, 0] / 9) * 10 + places[:, 1] / 7])

    def test_rows_are_the_points_of_a_file(self):
        rows = self.points()
        with open(self.path("points.csv"), "w", encoding="utf-8") as file:
            file.write("x,y,z\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in rows.tolist()))
        here, there = arete.build_points(rows), arete.build_points(self.path("points.csv"))
        for options in ({"max_error": 1}, {"max_triangles": 60}):
            self.assertTrue(np.array_equal(here.cut(**options).vertices, there.cut(**options).vertices))
        self.assertEqual(len(here.cut(max_error=0).vertices), len(rows))
        self.assertIn("32611", arete.build_points(rows, crs=32611).crs)

    def test_points_without_a_height_are_left_out_and_it_is_said(self):
        rows = self.points()
        rows[3, 2] = np.nan
        with self.assertWarnsRegex(arete.AreteWarning, "1 of 200 points") as said:
            model = arete.build_points(rows)
        self.assertEqual((said.warning.code, said.filename), ("omitted", __file__))
        self.assertEqual(len(model.cut(max_error=0).vertices), 199)
        rows[3] = (np.nan, 1, 1)
        with self.assertRaisesRegex(ValueError, "point 3 is not finite"):
            arete.build_points(rows)

    @unittest.skipUnless(has("geopandas"), "geopandas is not installed")
    def test_a_path_has_its_layer_and_its_field(self):
        import geopandas

        rows = self.points()
        for layer, shift in (("low", 0), ("high", 100)):
            frame = geopandas.GeoDataFrame({"top": rows[:, 2] + shift}, crs=32611,
                                           geometry=geopandas.points_from_xy(rows[:, 0], rows[:, 1]))
            frame.to_file(self.path("points.gpkg"), layer=layer, driver="GPKG")
        for layer, shift in (("low", 0), ("high", 100)):
            for build in (arete.build, arete.build_points):
                model = build(self.path("points.gpkg"), layer=layer, z_field="top")
                self.assertAlmostEqual(model.height(*rows[7, :2]), rows[7, 2] + shift)
        with self.assertRaises(ValueError):
            arete.build(self.path("points.gpkg"))

    def test_one_place_with_two_heights_needs_a_rule(self):
        rows = np.array([[0, 0, 1], [10, 0, 2], [0, 10, 3], [10, 10, 4], [5, 5, 5], [5, 5, 9.0]])
        with self.assertRaisesRegex(ValueError, "same_place"):
            arete.build_points(rows)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for rule, height in (("min", 5), ("max", 9), ("mean", 7), ("first", 5)):
                self.assertEqual(arete.build_points(rows, same_place=rule).height(5, 5), height)
        with self.assertRaisesRegex(ValueError, "same_place"):
            arete.build_points(rows, same_place="last")

    def test_wrong_shapes_are_named(self):
        for rows in (np.zeros((5, 2)), np.zeros(3), np.zeros((2, 2, 3))):
            with self.assertRaisesRegex(ValueError, "\\(n, 3\\)"):
                arete.build_points(rows)
        with self.assertRaises(ValueError):
            arete.build_points(np.zeros((0, 3)))

    def test_rows_of_points_given_as_a_grid_are_warned_of(self):
        with self.assertWarnsRegex(arete.AreteWarning, "build_points") as said:
            arete.build(self.points())
        self.assertEqual((said.warning.code, said.filename), ("choice", __file__))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            arete.build(hills(5, 3))
            arete.build(hills(40, 3), transform=PLACE, crs=32611)

    @unittest.skipUnless(has("geopandas"), "geopandas is not installed")
    def test_points_of_geopandas_have_their_crs_and_a_column_of_heights(self):
        import geopandas

        rows = self.points()
        flat = geopandas.GeoDataFrame({"top": rows[:, 2]}, geometry=geopandas.points_from_xy(rows[:, 0], rows[:, 1]), crs=32611)
        deep = geopandas.GeoSeries(geopandas.points_from_xy(*rows.T), crs=32611)
        wanted = arete.build_points(rows, crs=32611).cut(max_error=1).vertices
        for model in (arete.build_points(flat, z_field="top"), arete.build_points(deep)):
            self.assertIn("32611", model.crs)
            self.assertTrue(np.array_equal(model.cut(max_error=1).vertices, wanted))


class Arguments(Folder):
    def test_bad_numbers_and_files_of_another_kind_are_wrong_arguments(self):
        with open(self.path("text.py"), "w", encoding="utf-8") as file:
            file.write("import this\n")
        points = arete.build_points([(0, 0, 1), (9, 0, 2), (0, 9, 3), (9, 9, 5)])
        model, tin = arete.build(hills()), arete.build(hills()).cut(max_error=2)
        line = np.column_stack([np.arange(9.0)] * 3)
        for error, name, wrong in (
                (ValueError, "array", lambda: arete.build(np.full((5, 5), np.nan))),
                (ValueError, "array", lambda: arete.build(np.zeros((5, 5)), nodata=0)),
                (ValueError, "array", lambda: arete.build(np.ones((1, 5)))),
                (ValueError, "array", lambda: arete.build(hills() * 1e300)),
                (ValueError, "points", lambda: arete.build_points(line[:2])),
                (ValueError, "points", lambda: arete.build_points(line)),
                (ValueError, "text.py", lambda: arete.mesh_info(self.path("text.py"))),
                (ValueError, "text.py", lambda: arete.build(self.path("text.py"))),
                (ValueError, "text.py", lambda: arete.open(self.path("text.py"))),
                (ValueError, "fixed", lambda: arete.build(hills(), fixed=[(1e6, 1e6)])),
                (ValueError, "points", lambda: points.viewshed((5, 5, 2))),
                (TypeError, "camera", lambda: model.cut(camera=(0, 0, 5))),
                (TypeError, "arete.build", lambda: arete.Model("x")),
                (TypeError, "progress", lambda: model.cut(5, progress=3)),
                (TypeError, "max_error", lambda: model.cut(True)),
                (ValueError, "max_triangles", lambda: model.cut(max_triangles="200%")),
                (ValueError, "radius", lambda: model.viewshed((5, 5, 2), radius=-1)),
                (ValueError, "azimuth", lambda: model.viewshed((5, 5, 2), azimuth=(0, 400))),
                (ValueError, "lengths", lambda: model.profile([(1, 1, 2), (5, 5)])),
                (TypeError, "path", lambda: model.profile("line.gpkg")),
                (ValueError, "3 rows", lambda: model.los([(5, 5, 2)] * 3, [(9, 9, 2)] * 2)),
                (TypeError, "Model.measure", lambda: arete.measure(tin, np.zeros((5, 5)))),
                (TypeError, "colour", lambda: tin.plot(colour="red")),
                (TypeError, "CRS", lambda: tin.save(self.path("t.obj"), to_crs=1.5)),
                (ValueError, "operator.*qem", lambda: arete.decimate(tin, max_triangles=9, operator="foo")),
                (ValueError, "from 0 to 2", lambda: arete.mesh_info(np.eye(3), np.array([[0, 1, 7]]))),
                (ValueError, "float64", lambda: arete.mesh_info(np.eye(3), np.array([[0, 1, 2.0]])))):
            with self.subTest(name), self.assertRaisesRegex(error, name):
                wrong()
        self.assertEqual(model.los(np.zeros((0, 3)), (5, 5, 2)).visible.shape, (0,))

    def test_a_crs_to_save_in_is_taken_as_that_of_a_build(self):
        tin = arete.build(hills(), transform=PLACE, crs=32611).cut(max_error=2)
        tin.save(self.path("number.ply"), to_crs=32612)
        tin.save(self.path("text.ply"), to_crs="EPSG:32612")
        with open(self.path("number.ply"), "rb") as one, open(self.path("text.ply"), "rb") as other:
            self.assertEqual(one.read(), other.read())

    def test_errors_name_the_argument_in_pythons_types(self):
        for options, error, name in (
                ({"ratio": 0.5}, ValueError, "ratio"), ({"max_degree": 99}, ValueError, "max_degree"),
                ({"min_aspect": 0.1}, ValueError, "min_aspect"), ({"rim_tolerance": -1}, ValueError, "rim_tolerance"),
                ({"features": -1}, ValueError, "features"), ({"features": 1.5}, ValueError, "features"),
                ({"crease_angle": 200}, ValueError, "crease_angle"), ({"positive": "north"}, ValueError, "positive"),
                ({"feature_persistence": "much"}, TypeError, "feature_persistence"),
                ({"features": 3, "feature_persistence": 2}, ValueError, "exclude"),
                ({"shape": "round"}, ValueError, "shape"), ({"ratio": "big"}, TypeError, "ratio"),
                ({"layer": "x"}, TypeError, "layer"), ({"fixed": [1, 2, 3]}, ValueError, "fixed")):
            with self.subTest(options), self.assertRaisesRegex(error, name):
                arete.build(hills(), **options)
        model = arete.build(hills())
        for options, error, name in (
                ({"max_triangles": 0}, ValueError, "max_triangles"), ({"max_triangles": 2.5}, ValueError, "max_triangles"),
                ({"max_triangles": [5]}, TypeError, "max_triangles"), ({"max_triangles": True}, TypeError, "max_triangles"),
                ({"max_triangles": 1}, ValueError, "max_triangles"), ({"max_error": "5"}, TypeError, "max_error"),
                ({"max_error": 1, "method": "best"}, ValueError, "method"),
                ({"max_error": 1, "distance": 5}, ValueError, "distance"),
                ({"max_error": 1, "region": (0, 0, 9, 9), "distance": -5}, ValueError, "distance"),
                ({"max_error": 1, "region": "nowhere.gpkg"}, FileNotFoundError, "nowhere"),
                ({"max_error": 1, "lonlat": True}, ValueError, "lonlat")):
            with self.subTest(options), self.assertRaisesRegex(error, name):
                model.cut(**options)
        self.assertEqual(len(model.cut(max_triangles=5e2).triangles), len(model.cut(max_triangles=np.int64(500)).triangles))


if __name__ == "__main__":
    unittest.main()
