# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions in Python are those of the command, and hold what they promise."""

import json
import os
import tempfile
import unittest

import numpy as np

import arete
from arrays_test import Affine
from models_test import command

SIDE = 10.0
ROWS, COLUMNS = 60, 80
LEFT, TOP = 500000.0, 5200000.0


def box(left, bottom, right, top):
    return [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)]


def multi(*polygons):
    return {"type": "MultiPolygon", "coordinates": [polygon if isinstance(polygon[0], list) else [polygon] for polygon in polygons]}


A, B, C = box(500101, 5199601, 500399, 5199899), box(500201, 5199501, 500599, 5199799), box(500201, 5199701, 500301, 5199801)
D = box(500151, 5199651, 500349, 5199849)

CASES = {
    "one": multi(A),
    "overlapping": multi(A, B),
    "twice": multi(A, A),
    "three times": multi(A, A, A),
    "nested": multi(A, C),
    "the inner first": multi(C, A),
    "turned": multi(A, A[::-1]),
    "apart": multi(A, box(500601, 5199451, 500701, 5199551)),
    "touching": multi(A, box(500399, 5199601, 500599, 5199899)),
    "a hole": multi([A, D]),
    "a hole that another covers": multi([A, D], D),
    "an island": multi([A, D], C),
    "a hole that another overlaps": multi([A, D], B),
    "a bow tie": {"type": "Polygon", "coordinates": [[A[0], A[2], A[1], A[3], A[0]]]},
    "a polygon": {"type": "Polygon", "coordinates": [A]},
    "with heights": {"type": "Polygon", "coordinates": [[(x, y, 7.0) for x, y in A]]},
    "a collection": {"type": "GeometryCollection", "geometries": [multi(A), {"type": "Polygon", "coordinates": [B]}]},
    "a feature": {"type": "Feature", "properties": {}, "geometry": multi(A, B)},
    "features": {"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}} for ring in (A, B, A)]},
}


def polygons_of(geometry):
    if geometry["type"] == "Polygon":
        return [geometry["coordinates"]]
    if geometry["type"] == "MultiPolygon":
        return geometry["coordinates"]
    if geometry["type"] == "GeometryCollection":
        return [polygon for part in geometry["geometries"] for polygon in polygons_of(part)]
    if geometry["type"] == "Feature":
        return polygons_of(geometry["geometry"])
    return [polygon for feature in geometry["features"] for polygon in polygons_of(feature)]


def winding(ring, x, y):
    """How often a ring goes around places, by the angle that it turns."""
    angle = np.zeros_like(x)
    for (ax, ay, *_), (bx, by, *_) in zip(ring[:-1], ring[1:]):
        angle += np.arctan2((ax - x) * (by - y) - (ay - y) * (bx - x), (ax - x) * (bx - x) + (ay - y) * (by - y))
    return np.rint(angle / (2 * np.pi)).astype(int)


def inside(geometry, x, y):
    found = np.zeros(x.shape, bool)
    for outer, *holes in polygons_of(geometry):
        found |= (winding(outer, x, y) != 0) & ~np.any([winding(hole, x, y) != 0 for hole in holes] or [np.zeros(x.shape, bool)], 0)
    return found


def largest_error(tin, xs, ys, zs, mask):
    """Of the samples of a mask below each triangle."""
    worst = 0.0
    for triangle in tin.triangles:
        p = tin.vertices[triangle]
        columns = slice(max(0, int((p[:, 0].min() - LEFT) / SIDE) - 1), int((p[:, 0].max() - LEFT) / SIDE) + 2)
        rows = slice(max(0, int((TOP - p[:, 1].max()) / SIDE) - 1), int((TOP - p[:, 1].min()) / SIDE) + 2)
        there = mask[rows, columns]
        if not there.any():
            continue
        x, y, z = xs[rows, columns], ys[rows, columns], zs[rows, columns]
        area = (p[1, 0] - p[0, 0]) * (p[2, 1] - p[0, 1]) - (p[2, 0] - p[0, 0]) * (p[1, 1] - p[0, 1])
        u = ((x - p[0, 0]) * (p[2, 1] - p[0, 1]) - (y - p[0, 1]) * (p[2, 0] - p[0, 0])) / area
        v = ((y - p[0, 1]) * (p[1, 0] - p[0, 0]) - (x - p[0, 0]) * (p[1, 1] - p[0, 1])) / area
        below = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9) & there
        if below.any():
            worst = max(worst, np.abs(p[0, 2] + u * (p[1, 2] - p[0, 2]) + v * (p[2, 2] - p[0, 2]) - z)[below].max())
    return worst


class Shape:
    """As shapely has it."""

    def __init__(self, geometry):
        self.__geo_interface__ = geometry


class Regions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.z = np.round(np.cumsum(np.random.default_rng(5).normal(0, 4, (ROWS, COLUMNS)), 1) + 300, 2)
        cls.x, cls.y = np.meshgrid(LEFT + SIDE * (np.arange(COLUMNS) + 0.5), TOP - SIDE * (np.arange(ROWS) + 0.5))
        cls.model = arete.build(cls.z, transform=Affine(SIDE, 0, LEFT, 0, -SIDE, TOP), crs=32633)
        cls.file = os.path.join(cls.folder.name, "m.amt")
        cls.model.save(cls.file)

    def test_the_error_holds_in_every_part(self):
        for name, geometry in CASES.items():
            with self.subTest(name):
                tin = self.model.cut(max_error=0.5, region=Shape(geometry), outside_error=1e6)
                mask = inside(geometry, self.x, self.y)
                self.assertGreater(mask.sum(), 10)
                self.assertLessEqual(largest_error(tin, self.x, self.y, self.z, mask), 0.5 + 1e-9)
                self.assertLess(len(tin.triangles), self.model.finest_triangles / 2, "elsewhere it is coarse")

    def test_they_are_those_of_the_command(self):
        for name, geometry in list(CASES.items())[1::3]:
            with self.subTest(name):
                path = os.path.join(self.folder.name, "region.geojson")
                features = geometry if geometry["type"] == "FeatureCollection" else {"type": "FeatureCollection", "features": [
                    geometry if geometry["type"] == "Feature" else {"type": "Feature", "properties": {}, "geometry": geometry}]}
                with open(path, "w", encoding="utf-8") as file:
                    json.dump({**features, "crs": {"type": "name", "properties": {"name": "EPSG:32633"}}}, file)
                tin = self.model.cut(max_error=0.5, region=geometry, outside_error=30)
                said = json.loads(command("extract", self.file, "-o", os.path.join(self.folder.name, "o.ply"), "--max-error", 0.5,
                                          "--outside-error", 30, "--region", path, "--json"))["exports"][0]
                self.assertEqual(len(tin.triangles), said["triangles"])

    def test_empty_ones_are_refused(self):
        for name, geometry in {"polygon": {"type": "Polygon", "coordinates": []},
                               "multi": {"type": "MultiPolygon", "coordinates": []},
                               "ring": {"type": "Polygon", "coordinates": [[]]},
                               "flat": {"type": "Polygon", "coordinates": [[A[0], A[1], A[0]]]},
                               "collection": {"type": "GeometryCollection", "geometries": []},
                               "features": {"type": "FeatureCollection", "features": []},
                               "feature": {"type": "Feature", "properties": {}, "geometry": None},
                               "parts": multi([[]], [[]])}.items():
            with self.subTest(name), self.assertRaisesRegex(ValueError, "region"):
                self.model.cut(max_error=0.5, region=Shape(geometry), outside_error=1e6)
        for geometry in ({"type": "Point", "coordinates": A[0]}, {"type": "LineString", "coordinates": A}, {"type": None}):
            with self.subTest(geometry["type"]), self.assertRaisesRegex(ValueError, "Polygon"):
                self.model.cut(max_error=0.5, region=geometry)
        for bad in ((1, 2, 1, 4), (1, 4, 3, 2), (500201, 5199701, 500101, 5199801), (float("nan"), 0, 1, 1)):
            with self.subTest(bad), self.assertRaises(ValueError):
                self.model.cut(max_error=0.5, region=bad)

    def test_an_empty_part_is_left_out(self):
        whole = self.model.cut(max_error=0.5, region=multi(A), outside_error=1e6)
        tin = self.model.cut(max_error=0.5, region=multi(A, [[]]), outside_error=1e6)
        self.assertEqual(len(tin.triangles), len(whole.triangles))


class Worlds(unittest.TestCase):
    """DEMs that go round the Earth have the columns of their source."""

    def worlds(self):
        for west in (-180, 0, -170, 20):
            for step, rows in ((10, 18), (4.5, 40), (7.5, 24)):
                columns = round(360 / step)
                height = np.add.outer(np.arange(rows) * 3.0, 10 * np.sin(2 * np.pi * (west + step * np.arange(columns)) / 360))
                yield west, step, height

    def test_shape_grid_and_viewshed(self):
        for west, step, height in self.worlds():
            with self.subTest((west, step)):
                rows, columns = height.shape
                down = 180 / rows
                model = arete.build(height, transform=Affine(step, 0, west, 0, -down, 90), crs=4326)
                self.assertEqual(model.shape, height.shape)
                self.assertTrue(np.allclose(model.bounds, (west + step / 2, down / 2 - 90, west + 360 - step / 2, 90 - down / 2)))
                seen = model.viewshed((west + 3, 2, 1e6), radius=2e6)
                self.assertEqual(seen.shape, height.shape)
                self.assertIn(255, np.unique(seen))
                self.assertTrue((seen[:, -1] != 1).any(), "behind the seam")
                try:
                    import xarray  # noqa: F401
                except ImportError:
                    continue
                array = model.to_xarray()
                self.assertEqual(array.shape, height.shape)
                self.assertTrue(np.allclose(array.values, height))
                self.assertAlmostEqual(float(array.x[0]), west + step / 2)
                self.assertAlmostEqual(float(array.x[-1]), west + 360 - step / 2)

    def test_a_grid_that_has_its_first_column_twice_keeps_it(self):
        height = np.add.outer(np.arange(10.0), np.arange(37.0) % 36)
        model = arete.build(height, transform=Affine(10, 0, -185, 0, -10, 50), crs=4326)
        self.assertEqual(model.shape, (10, 37))

    def test_heights_and_lines_at_the_seam(self):
        models = [arete.build(np.add.outer(np.zeros(18), 100 + 50 * np.cos(np.radians(west + 5 + 10 * np.arange(36)))),
                              transform=Affine(10, 0, west, 0, -10, 90), crs=4326) for west in (0, -180)]
        x = np.linspace(-190, 370, 57)
        heights = [model.height(x, 12.0) for model in models]
        self.assertTrue(np.isfinite(heights[0]).all())
        self.assertTrue(np.allclose(heights[0], heights[1]))
        for first, second in (((-5, 30, 20000), (5, 32, 20000)), ((175, 30, 20000), (-175, 32, 20000)), ((179, 3, 9000), (-179, 3, 9000))):
            with self.subTest(first):
                answers = [model.los(first, second) for model in models]
                self.assertEqual([answer.verdict for answer in answers], ["visible", "visible"])
                self.assertAlmostEqual(answers[0].clearance, answers[1].clearance, places=1)
                profiles = [model.profile([first[:2], second[:2]]) for model in models]
                for profile in profiles:
                    self.assertAlmostEqual(profile.gap, 0, places=3)
                    self.assertEqual(set(profile.part), {1})


if __name__ == "__main__":
    unittest.main()
