# SPDX-License-Identifier: GPL-3.0-or-later
"""What users of other modules pass and do: NODATA, masks, percentages, pickles, forks, files that change."""

import copy
import os
import pickle
import tempfile
import threading
import unittest

import numpy as np

import arete


def hills(rows=40, columns=50):
    y, x = np.mgrid[0:rows, 0:columns]
    return np.round(100 * np.sin(x / 9) * np.cos(y / 7) + 300)


class Nodata(unittest.TestCase):
    def test_the_number_that_is_meant_is_left_out_in_every_type(self):
        cases = [("u8", 2**64 - 1, 2**64 - 1), ("u8", 2**64 - 1, float(2**64)), ("i8", -2**63, -2**63), ("i8", 2**63 - 1, 2**63 - 1),
                 ("i8", 2**63 - 1, float(2**63)), ("u4", 2**32 - 1, 2**32 - 1), ("i4", -2**31, float(-2**31)), ("u2", 65535, 65535.0),
                 ("i2", -9999, -9999), ("i2", -9999, np.int64(-9999)), ("i2", -9999, np.float32(-9999)), ("u1", 255, 255),
                 ("f4", -3.4e38, -3.4e38), ("f4", -9999, -9999), ("f8", -9999, -9999), ("f8", np.nan, np.nan), ("f4", np.inf, np.inf),
                 (">i2", -9999, -9999), (">f4", -9999, -9999.0), ("f2", -9999, -9999)]
        for kind, stored, stated in cases:
            with self.subTest(kind=kind, stated=stated):
                array = (hills() / (2 if kind == "u1" else 1)).astype(kind)
                array[5:9, 5:9] = stored
                self.assertEqual(np.isnan(grid(arete.build(array, nodata=stated))).sum(), 16)

    def test_what_is_no_number_is_refused(self):
        for stated in ("-9999", b"1", True, 1j, [1], np.bool_(True)):
            with self.subTest(stated=stated), self.assertRaisesRegex(TypeError, "nodata"):
                arete.build(hills(), nodata=stated)

    def test_what_the_type_cannot_hold_is_no_cell(self):
        for kind, stated in (("u1", -9999), ("i2", 1e30), ("u8", -1), ("i2", 0.5), ("u8", np.inf), ("i8", 10**30)):
            with self.subTest(kind=kind, stated=stated):
                self.assertFalse(np.isnan(grid(arete.build((hills() / 2).astype(kind), nodata=stated))).any())


def grid(model):
    rows, columns = model.shape
    x, y = np.arange(columns) + 0.5, rows - np.arange(rows) - 0.5
    return model.height(x[np.newaxis, :], y[:, np.newaxis])


class Arrays(unittest.TestCase):
    def test_arrays_without_cells_and_transforms_without_an_inverse_are_named(self):
        try:
            from affine import Affine
        except ModuleNotFoundError:
            self.skipTest("affine is not installed")

        for array in (hills()[:0], hills()[:, :0], np.zeros((0, 0)), np.zeros((0, 5), "i2"), np.ma.masked_array(hills()[:0])):
            with self.assertRaisesRegex(ValueError, "shape"):
                arete.build(array)
        for numbers in ((1, 2, 0, 2, 4, 0), (0, 0, 0, 0, 0, 0), (1, 0, 0, 0, 0, 0), (np.nan, 0, 0, 0, 1, 0), (np.inf, 0, 0, 0, 1, 0)):
            with self.assertRaisesRegex(ValueError, "transform"):
                arete.build(hills(), transform=Affine(*numbers))
        for array in (np.full((5, 5), np.nan), np.ma.masked_all((5, 5)), hills()[:1], hills()[:, :1]):
            with self.assertRaises((ValueError, RuntimeError)) as caught:
                arete.build(array)
            self.assertNotIn("/vsimem", str(caught.exception))

    def test_messages_name_arguments(self):
        with self.assertRaisesRegex(ValueError, "max_triangles"):
            arete.build(hills()).cut(max_triangles=1)


class Masks(unittest.TestCase):
    def setUp(self):
        self.model = arete.build(hills())

    def test_heights_of_masked_places_are_none(self):
        x = np.ma.masked_array([10.5, 11.5, 12.5], [False, True, False])
        for places in ((x, 20.5), (20.5, x), (x, x)):
            self.assertEqual(list(np.isnan(self.model.height(*places))), [False, True, False])
        self.assertTrue(np.isnan(self.model.height(np.ma.masked, 20.5)))

    def test_masked_places_are_refused_where_an_answer_needs_them(self):
        masked = np.ma.masked_array([[10.5, 10.5, 2], [20.5, 20.5, 2]], [[False] * 3, [False, True, False]])
        for ask in (lambda: self.model.los(masked, (30.5, 20.5, 2)), lambda: self.model.los((30.5, 20.5, 2), masked),
                    lambda: self.model.profile(masked[:, :2]), lambda: self.model.viewshed(masked[1]),
                    lambda: self.model.measure(np.ma.masked_array(np.eye(3), np.eye(3) > 0), [[0, 1, 2]]),
                    lambda: arete.build_surface(np.ma.masked_array(np.eye(3), np.eye(3) > 0), [[0, 1, 2]]),
                    lambda: arete.build_surface(np.eye(3), np.ma.masked_array([[0, 1, 2]], [[False, False, True]]))):
            with self.assertRaisesRegex(ValueError, "masked"):
                ask()

    def test_nothing_is_not_measured(self):
        for model in (self.model, arete.build_surface(np.eye(3), [[0, 1, 2]])):
            with self.assertRaisesRegex(ValueError, "no triangles"):
                model.measure(np.zeros((0, 3)), np.zeros((0, 3), "u4"))
        aside = self.model.measure(np.eye(3) + 1e6, [[0, 1, 2]])
        self.assertTrue(np.isnan(aside["max_abs_error"]) and aside["covered"] == 0)


class Sizes(unittest.TestCase):
    def test_percentages_are_of_the_relief_the_diagonal_and_the_finest(self):
        model = arete.build(hills())
        relief = hills().max() - hills().min()
        for percent in (0.1, 0.5, 1, 2.5, 10, 33):
            self.assertTrue(np.array_equal(model.cut(max_error=f"{percent}%").triangles,
                                           model.cut(max_error=percent / 100 * relief).triangles), percent)
        self.assertEqual(len(model.cut(max_triangles="10%").triangles),
                         len(model.cut(max_triangles=model.finest_triangles // 10).triangles))
        surface = arete.build_surface(np.eye(3), [[0, 1, 2]])
        self.assertLessEqual(surface.cut(max_error="1%").error, surface.diagonal / 100)
        self.assertIsInstance(model.height(20.5, 20.5, max_error=" 1 %"), float)

    def test_other_texts_are_refused(self):
        model = arete.build(hills())
        for text in ("1", "", "%", "one%", "1%%", "1 m"):
            with self.subTest(text=text), self.assertRaisesRegex(TypeError, "max_error"):
                model.cut(max_error=text)
        for text in ("-1%", "nan%", "inf%"):
            with self.subTest(text=text), self.assertRaisesRegex(ValueError, "max_error"):
                model.cut(max_error=text)


class Hosts(unittest.TestCase):
    def test_a_tin_is_pickled_and_copied(self):
        for tin in (arete.build(hills()).cut(max_error=2), arete.build_surface(np.eye(3), [[0, 1, 2]]).cut(max_error=0)):
            for again in (pickle.loads(pickle.dumps(tin)), copy.copy(tin), copy.deepcopy(tin)):
                for name in ("vertices", "triangles", "errors", "source_vertices"):
                    self.assertTrue(np.array_equal(getattr(tin, name), getattr(again, name)))
                with tempfile.TemporaryDirectory() as folder:
                    paths = [os.path.join(folder, name) for name in ("tin.ply", "again.ply")]
                    for one, path in zip((tin, again), paths):
                        self.assertEqual(one.save(path), [])
                    with open(paths[0], "rb") as first, open(paths[1], "rb") as second:
                        self.assertEqual(first.read(), second.read())
                self.assertEqual((tin.error, tin.is_complete, tin.pixels, tin.crs),
                                 (again.error, again.is_complete, again.pixels, again.crs))

    def test_a_model_stays_what_its_file_was_when_it_was_opened(self):
        for packed in (False, True):
            for size in (0, 100, 5000):
                with tempfile.TemporaryDirectory() as folder:
                    path = os.path.join(folder, "a.amt")
                    arete.build(hills(90, 90)).save(path, packed=packed)
                    model = arete.open(path)
                    os.truncate(path, size)
                    self.assertTrue(np.array_equal(grid(model), hills(90, 90)))
                    with self.assertRaises((RuntimeError, OSError)):
                        arete.open(path)

    def test_a_pickled_model_is_that_of_its_file_or_an_error(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "dem.amt")
            for packed in (False, True):
                model = arete.build(np.random.default_rng(5).random((20, 30)))
                model.save(path, packed=packed)
                for one in (model, arete.open(path)):
                    self.assertEqual(pickle.loads(pickle.dumps(one)).height(5, 5), model.height(5, 5))
                kept = pickle.dumps(model)
                arete.build(np.random.default_rng(6).random((20, 30))).save(path, packed=packed)
                with self.assertRaisesRegex(RuntimeError, "another model"):
                    pickle.loads(kept)

    def test_children_of_fork_answer(self):
        model = arete.build(hills())
        wanted = len(model.cut(max_error=1).triangles)
        for _ in range(5):
            threads = [threading.Thread(target=lambda: model.cut(max_error=1)) for _ in range(4)]
            [one.start() for one in threads]
            [one.join() for one in threads]
            child = os.fork()
            if child == 0:
                try:
                    os._exit(7 if len(model.cut(max_error=1).triangles) == wanted else 8)
                except RuntimeError as error:
                    os._exit(9 if "spawn" in str(error) else 10)
            self.assertIn(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), (7, 9))


if __name__ == "__main__":
    unittest.main()
