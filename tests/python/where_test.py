# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions by paths, lines with a distance, frames of geopandas and functions of boxes: the error holds there."""

import importlib.util
import json
import os
import subprocess
import tempfile
import unittest

import numpy as np

import arete

COMMAND = os.environ.get("ARETE", "arete")
HAS_GEOPANDAS = importlib.util.find_spec("geopandas") is not None


def hills(rows=64, columns=80):
    y, x = np.mgrid[0:rows, 0:columns]
    return 100 * np.sin(x / 5) * np.cos(y / 4) + (x * y % 7)


class Affine(tuple):
    a, b, c, d, e, f = (property(lambda self, i=i: self[i]) for i in range(6))


PLACE = Affine((30, 0, 500000, 0, -30, 4000000))
LINE = [[500300, 3998500], [501500, 3999200], [502100, 3998600]]


def distance_to_line(places, line):
    best = np.full(len(places), np.inf)
    for a, b in zip(np.array(line[:-1], dtype=float), np.array(line[1:], dtype=float)):
        share = np.clip(((places - a) @ (b - a)) / ((b - a) @ (b - a)), 0, 1)
        best = np.minimum(best, np.linalg.norm(places - (a + share[:, np.newaxis] * (b - a)), axis=1))
    return best


class Regions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.model = arete.build(hills(), transform=PLACE, crs=32611)
        cls.bare = arete.build(hills(), transform=PLACE)
        rows, columns = np.mgrid[0:64, 0:80]
        cls.places = np.column_stack([500000 + (columns.ravel() + 0.5) * 30, 4000000 - (rows.ravel() + 0.5) * 30])
        cls.heights = hills().ravel()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = lambda name: os.path.join(folder.name, name)

    def largest_errors(self, tin, inside):
        """By interpolation of the test's own."""
        errors = np.zeros(len(self.places))
        for corners in tin.vertices[tin.triangles]:
            low, high = corners[:, :2].min(axis=0) - 1e-6, corners[:, :2].max(axis=0) + 1e-6
            near = np.flatnonzero(((self.places >= low) & (self.places <= high)).all(axis=1))
            sides = np.array([corners[1, :2] - corners[0, :2], corners[2, :2] - corners[0, :2]]).T
            if len(near) == 0 or abs(np.linalg.det(sides)) < 1e-9:
                continue
            shares = np.linalg.solve(sides, (self.places[near] - corners[0, :2]).T).T
            held = (shares >= -1e-9).all(axis=1) & (shares.sum(axis=1) <= 1 + 1e-9)
            z = corners[0, 2] + shares @ (corners[1:, 2] - corners[0, 2])
            errors[near[held]] = np.maximum(errors[near[held]], np.abs(z - self.heights[near])[held])
        return errors[inside].max(), errors[~inside].max()

    def check(self, tin, inside, most=1.0):
        within, outside = self.largest_errors(tin, inside)
        self.assertLessEqual(within, most + 1e-6)
        self.assertGreater(outside, most)
        self.assertLess(len(tin.triangles), len(self.model.cut(max_error=most).triangles))

    def test_a_line_with_a_distance_is_what_is_that_near(self):
        inside = distance_to_line(self.places, LINE) <= 200
        line = {"type": "LineString", "coordinates": LINE}
        for model in (self.model, self.bare):
            self.check(model.cut(max_error=1, region=line, distance=200), inside)
        points = {"type": "MultiPoint", "coordinates": LINE}
        near = np.min([np.linalg.norm(self.places - np.array(place), axis=1) for place in LINE], axis=0) <= 200
        self.check(self.bare.cut(max_error=1, region=points, distance=200), near)
        with self.assertRaisesRegex(ValueError, "distance"):
            self.model.cut(max_error=1, region=line)

    def test_a_path_is_that_of_the_command(self):
        with open(self.path("road.geojson"), "w", encoding="utf-8") as file:
            json.dump({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32611"}}, "features": [
                {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": LINE}}]}, file)
        self.model.save(self.path("dem.amt"))
        said = json.loads(subprocess.run(
            [COMMAND, "extract", self.path("dem.amt"), "-o", self.path("tin.ply"), "--max-error", "1", "--region",
             self.path("road.geojson"), "--distance", "200", "--json"], check=True, capture_output=True).stdout)
        tin = self.model.cut(max_error=1, region=self.path("road.geojson"), distance=200)
        self.assertEqual(len(tin.triangles), said["exports"][0]["triangles"])
        line = self.model.cut(max_error=1, region={"type": "LineString", "coordinates": LINE}, distance=200)
        self.assertTrue(np.array_equal(line.triangles, tin.triangles))

    def test_a_box_has_a_crs_and_a_distance(self):
        box = (500500, 3998500, 501000, 3999000)
        offset = np.maximum(np.maximum(np.array(box[:2]) - self.places, self.places - np.array(box[2:])), 0)
        self.check(self.model.cut(max_error=1, region=box, distance=150), np.linalg.norm(offset, axis=1) <= 150)
        tin = self.model.cut(max_error=1, region=box, region_crs="EPSG:32611")
        self.assertTrue(np.array_equal(tin.triangles, self.model.cut(max_error=1, region=box).triangles))
        with self.assertRaises(ValueError):
            self.bare.cut(max_error=1, region=box, region_crs=4326)

    @unittest.skipUnless(HAS_GEOPANDAS, "geopandas is not installed")
    def test_a_geoseries_is_brought_into_the_crs_of_the_source(self):
        import geopandas
        from shapely.geometry import LineString, box

        line = geopandas.GeoSeries([LineString(LINE)], crs=32611)
        inside = distance_to_line(self.places, LINE) <= 180
        self.check(self.model.cut(max_error=1, region=line.to_crs(4326), distance=200), inside)
        here = geopandas.GeoSeries([box(500500, 3998500, 501000, 3999000)], crs=32611)
        there = here.to_crs(32610)
        x, y = self.places.T
        middle = (x >= 500530) & (x <= 500970) & (y >= 3998530) & (y <= 3998970)
        for region in (here, there, geopandas.GeoDataFrame(geometry=there)):
            self.check(self.model.cut(max_error=1, region=region), middle)
        with self.assertRaisesRegex(ValueError, "region"):
            self.bare.cut(max_error=1, region=here)
        with self.assertRaisesRegex(ValueError, "region"):
            self.model.cut(max_error=1, region=here.to_crs(32611).translate(1e6, 0))

    def test_a_function_of_boxes_is_a_region(self):
        middle, radius = np.array([501200.0, 3999100.0]), 320.0
        asked = []

        def disc(xmin, ymin, xmax, ymax):
            asked.append((xmin, ymin, xmax, ymax))
            near = np.clip(middle, (xmin, ymin), (xmax, ymax))
            far = np.where(np.abs(middle - (xmin, ymin)) > np.abs(middle - (xmax, ymax)), (xmin, ymin), (xmax, ymax))
            if np.linalg.norm(near - middle) > radius:
                return False
            return True if np.linalg.norm(far - middle) <= radius else None

        inside = np.linalg.norm(self.places - middle, axis=1) <= radius
        tin = self.model.cut(max_error=1, where=disc)
        self.check(tin, inside)
        self.assertEqual(asked[0], self.model.bounds)
        self.assertLess(len(asked), 5000)
        whole = self.model.cut(max_error=1, where=lambda *box: True)
        self.assertTrue(np.array_equal(whole.triangles, self.model.cut(max_error=1, region=self.model.bounds).triangles))
        # What is never decided belongs to it.
        unsure = self.model.cut(max_error=1, where=lambda *box: None)
        self.assertLessEqual(self.model.measure(unsure)["max_abs_error"], 1)

    def test_what_a_function_raises_or_answers_wrongly_comes_out(self):
        with self.assertRaisesRegex(TypeError, "True, False or None"):
            self.model.cut(max_error=1, where=lambda *box: 1)
        with self.assertRaises(ZeroDivisionError):
            self.model.cut(max_error=1, where=lambda *box: 1 / 0)
        with self.assertRaisesRegex(ValueError, "nothing"):
            self.model.cut(max_error=1, where=lambda *box: False)
        with self.assertRaisesRegex(TypeError, "function"):
            self.model.cut(max_error=1, where=5)
        with self.assertRaisesRegex(ValueError, "where"):
            self.model.cut(max_error=1, where=lambda *box: True, region=(0, 0, 1, 1))

    def test_lonlat_places_the_focus(self):
        lon, lat = -117 + 1200 / 91290, 36.13
        here = self.model.height(lon, lat, lonlat=True)
        self.assertFalse(np.isnan(here))
        tin = self.model.cut(max_error=1, focus=(lon, lat), error_growth=0.05, lonlat=True)
        self.assertLess(len(tin.triangles), len(self.model.cut(max_error=1).triangles))
        self.assertTrue(self.model.los((lon, lat, 5), (lon, lat + 0.0005, 5), lonlat=True).verdict)


class Space(unittest.TestCase):
    def test_a_function_of_boxes_is_a_region_of_a_surface(self):
        j, i = np.mgrid[0:40, 0:40]
        vertices = np.stack([i, j, 3 * np.sin(i / 3) * np.cos(j / 4)], axis=-1).reshape(-1, 3).astype(float)
        corner = (j[:-1, :-1] * 40 + i[:-1, :-1]).ravel()
        triangles = np.concatenate([np.stack([corner, corner + 1, corner + 41], axis=1),
                                    np.stack([corner, corner + 41, corner + 40], axis=1)])
        surface = arete.build_surface(vertices, triangles)

        def half(x0, y0, z0, x1, y1, z1):
            return True if x1 <= 20 else False if x0 > 20 else None

        tin = surface.cut(max_error=0.01, where=half)
        box = surface.cut(max_error=0.01, region=(-1, -1, -9, 20, 40, 9))
        in_half = tin.vertices[:, 0] < 19
        self.assertEqual(in_half.sum(), (box.vertices[:, 0] < 19).sum())
        self.assertLess(len(tin.triangles), len(surface.cut(max_error=0.01).triangles))


if __name__ == "__main__":
    unittest.main()
