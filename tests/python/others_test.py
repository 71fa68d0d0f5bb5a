# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes as other modules have them: trimesh and pyvista by stand-ins of their constructors, geopandas itself."""

import importlib.util
import sys
import types
import unittest
from unittest import mock

import numpy as np

import arete


def terrain():
    y, x = np.mgrid[0:40, 0:50]
    return arete.build(100 * np.sin(x / 9) * np.cos(y / 7))


class Trimesh:
    """As trimesh.Trimesh(): it merges vertices, which reorders them, unless process is False."""

    def __init__(self, vertices=None, faces=None, face_normals=None, vertex_normals=None, face_colors=None, vertex_colors=None,
                 face_attributes=None, vertex_attributes=None, metadata=None, process=True, validate=False, **kwargs):
        if kwargs:
            raise TypeError(kwargs)
        self.vertices, self.faces = np.asanyarray(vertices, dtype=np.float64), np.asanyarray(faces, dtype=np.int64)
        if process:
            self.vertices = self.vertices[::-1]
        self.face_attributes, self.metadata = face_attributes, metadata


class PolyData:
    """As pyvista.PolyData(): faces are one list, the number of corners before each."""

    def __init__(self, var_inp=None, faces=None):
        self.points, self.faces = np.asarray(var_inp), np.asarray(faces)
        if self.faces.ndim != 1:
            raise ValueError("faces are one list")
        at, count = 0, 0
        while at < len(self.faces):
            at, count = at + 1 + self.faces[at], count + 1
        if at != len(self.faces) or not self.points.flags.writeable:
            raise ValueError("the faces do not end where their list does")
        self.n_cells, self.cell_data = count, {}


class Others(unittest.TestCase):
    def test_trimesh_keeps_the_order(self):
        tin = terrain().cut(max_error=2)
        with mock.patch.dict(sys.modules, {"trimesh": types.SimpleNamespace(Trimesh=Trimesh)}):
            made = tin.to_trimesh()
        self.assertTrue(np.array_equal(made.vertices, tin.vertices))
        self.assertTrue(np.array_equal(made.faces, tin.triangles))
        self.assertTrue(np.array_equal(made.face_attributes["error"], tin.errors))

    def test_pyvista_has_the_number_of_corners_before_each_face(self):
        tin = terrain().cut(max_error=2)
        with mock.patch.dict(sys.modules, {"pyvista": types.SimpleNamespace(PolyData=PolyData)}):
            made = tin.to_pyvista()
        self.assertEqual(made.n_cells, len(tin.triangles))
        self.assertTrue(np.array_equal(made.faces.reshape(-1, 4)[:, 1:], tin.triangles))
        self.assertEqual(made.points.dtype, np.float64)
        self.assertTrue(np.array_equal(made.cell_data["error"], tin.errors))

    @unittest.skipIf(importlib.util.find_spec("trimesh"), "trimesh is installed")
    def test_a_module_that_is_missing_is_named(self):
        with self.assertRaisesRegex(ImportError, "trimesh"):
            terrain().cut(max_error=2).to_trimesh()

    @unittest.skipUnless(importlib.util.find_spec("geopandas"), "geopandas is not installed")
    def test_geopandas_has_a_polygon_with_heights_for_each_triangle(self):
        y, x = np.mgrid[0:20, 0:30]

        class Affine:
            a, b, c, d, e, f = 30, 0, 500000, 0, -30, 4000000

        tin = arete.build(50 * np.sin(x / 5) + y, transform=Affine(), crs=32611).cut(max_error=3)
        frame = tin.to_geopandas()
        self.assertEqual((len(frame), frame.crs.to_epsg()), (len(tin.triangles), 32611))
        self.assertTrue(np.array_equal(frame["error"], tin.errors))
        for number in (0, len(frame) - 1):
            ring = list(frame.geometry[number].exterior.coords)
            self.assertEqual([tuple(place) for place in tin.vertices[tin.triangles[number]]], ring[:3])
        self.assertAlmostEqual(frame.area.sum(), 29 * 19 * 900)
        self.assertTrue(frame.geometry.has_z.all())

    def test_a_mended_mesh_has_no_errors_to_give(self):
        mesh = arete.repair(terrain().cut(max_error=2))
        with mock.patch.dict(sys.modules, {"trimesh": types.SimpleNamespace(Trimesh=Trimesh)}):
            self.assertEqual(mesh.to_trimesh().face_attributes, {})


if __name__ == "__main__":
    unittest.main()
