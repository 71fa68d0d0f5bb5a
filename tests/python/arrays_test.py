# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of any form are one model to the bit, or are refused."""

import os
import tempfile
import unittest
import warnings

import numpy as np

import arete

ROWS, COLUMNS = 23, 31


def whole_heights():
    """Whole numbers, which every type below holds, none of them symmetric."""
    rows, columns = np.mgrid[0:ROWS, 0:COLUMNS]
    return (rows * 3 + (columns * columns) % 17 + (rows * columns) % 5).astype(np.int64)


class Affine:
    """As affine.Affine has its numbers."""

    def __init__(self, a, b, c, d, e, f):
        self.a, self.b, self.c, self.d, self.e, self.f = a, b, c, d, e, f


class Arrays(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def bytes_of(self, heights, **options):
        path = os.path.join(self.folder.name, "model.amt")
        arete.build(heights, **options).save(path)
        with open(path, "rb") as file:
            return file.read()

    def test_every_form_of_one_array_is_one_model_to_the_bit(self):
        base = whole_heights()
        wanted = self.bytes_of(base.astype(np.float64))
        strided = np.zeros((2 * ROWS, 3 * COLUMNS), dtype=np.float32)
        strided[::2, ::3] = base
        wide = np.full((ROWS + 4, COLUMNS + 6), 99, dtype=np.int16)
        wide[2:-2, 3:-3] = base
        path = os.path.join(self.folder.name, "map.bin")
        mapped = np.memmap(path, dtype=">i2", mode="w+", shape=(ROWS, COLUMNS))
        mapped[:] = base
        locked = base.astype(np.float64)
        locked.flags.writeable = False
        record = np.zeros((ROWS, COLUMNS), dtype=[("z", "<f4"), ("other", "u1")])
        record["z"] = base
        forms = {
            "int64": base,
            "int32": base.astype(np.int32),
            "int16": base.astype(np.int16),
            "int8": base.astype(np.int8),
            "uint8": base.astype(np.uint8),
            "uint16": base.astype(np.uint16),
            "uint32": base.astype(np.uint32),
            "uint64": base.astype(np.uint64),
            "float16": base.astype(np.float16),
            "float32": base.astype(np.float32),
            "longdouble": base.astype(np.longdouble),
            "big-endian int32": base.astype(">i4"),
            "big-endian float64": base.astype(">f8"),
            "column by column": np.asfortranarray(base.astype(np.float32)),
            "rows backwards": base[::-1].copy()[::-1],
            "columns backwards": base[:, ::-1].copy()[:, ::-1],
            "transposed": base.T.copy().T,
            "every second and third": strided[::2, ::3],
            "a part": wide[2:-2, 3:-3],
            "a file": mapped,
            "read-only": locked,
            "unaligned": np.frombuffer(b"x" + base.astype("<f8").tobytes(), dtype="<f8", offset=1).reshape(ROWS, COLUMNS),
            "a field of records": record["z"],
            "masked, nothing hidden": np.ma.masked_array(base, mask=False),
        }
        self.assertGreaterEqual(len(forms), 20)
        for name, form in forms.items():
            with self.subTest(name):
                self.assertEqual(self.bytes_of(form), wanted)

    def test_what_is_no_array_of_real_numbers_is_refused(self):
        base = whole_heights()
        for name, form, error in (
                ("bool", base > 3, TypeError), ("complex", base.astype(complex), TypeError),
                ("objects", base.astype(object), TypeError), ("text", base.astype(str), TypeError),
                ("dates", base.astype("datetime64[s]"), TypeError),
                ("records", np.zeros((3, 3), dtype=[("z", "f4")]), TypeError),
                ("a list", base.tolist(), TypeError), ("one dimension", base[0], ValueError),
                ("three dimensions", base[np.newaxis], ValueError), ("nothing", None, TypeError)):
            with self.subTest(name), self.assertRaises(error):
                arete.build(form)
        with self.assertRaisesRegex(ValueError, "array\\[0\\]"):
            arete.build(base[np.newaxis])

    def test_a_number_that_float64_does_not_hold_is_refused(self):
        for value in (2**53 + 1, -(2**53) - 1, 2**63 - 1):
            heights = whole_heights()
            heights[2, 3] = value
            with self.assertRaisesRegex(ValueError, "row 2, column 3"):
                arete.build(heights)
        heights = whole_heights().astype(np.uint64)
        heights[4, 5] = 2**64 - 1
        with self.assertRaisesRegex(ValueError, "row 4, column 5"):
            arete.build(heights)

    def test_masked_cells_nan_and_nodata_are_the_same_void(self):
        base = whole_heights()
        hole = np.zeros(base.shape, dtype=bool)
        hole[5:9, 7:12] = True
        as_nan = base.astype(np.float64)
        as_nan[hole] = np.nan
        wanted = self.bytes_of(as_nan)
        self.assertNotEqual(wanted, self.bytes_of(base))
        self.assertEqual(self.bytes_of(np.ma.masked_array(base, mask=hole)), wanted)
        for dtype, nodata in ((np.int16, -9999), (np.float32, -3.4028235e38), (np.float64, 1e20), (np.uint8, 255)):
            with self.subTest(dtype):
                holed = base.astype(dtype)
                holed[hole] = nodata
                self.assertEqual(self.bytes_of(holed, nodata=nodata), wanted)
        both = np.ma.masked_array(base.astype(np.float32), mask=hole)
        both[0, 0] = np.nan
        self.assertNotEqual(self.bytes_of(both), wanted)
        # What a mask hides is no height, whatever it is.
        hidden = base.copy()
        hidden[hole] = 2**53 + 1
        self.assertEqual(self.bytes_of(np.ma.masked_array(hidden, mask=hole)), wanted)

    def test_infinite_heights_are_nodata_and_it_is_said(self):
        heights = whole_heights().astype(np.float64)
        heights[1, 1] = np.inf
        with self.assertWarnsRegex(arete.AreteWarning, "infinite") as said:
            model = arete.build(heights)
        self.assertEqual(said.warning.code, "heights")
        self.assertTrue(np.isnan(model.height(1.5, ROWS - 1.5)))

    def test_an_array_without_a_place_counts_columns_and_rows_upwards(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            model = arete.build(whole_heights())
        self.assertEqual(model.height(2.5, 0.5), whole_heights()[-1, 2])
        self.assertEqual(model.height(0.5, ROWS - 0.5), whole_heights()[0, 0])

    def test_the_place_is_that_of_an_affine_and_a_tuple_is_refused(self):
        model = arete.build(whole_heights(), transform=Affine(30, 0, 500000, 0, -30, 4000000), crs="EPSG:32611")
        self.assertEqual(model.transform, (500000, 30, 0, 4000000, 0, -30))
        self.assertEqual(model.bounds, (500015, 4000000 - (ROWS - 0.5) * 30, 500000 + (COLUMNS - 0.5) * 30, 3999985))
        self.assertIn("32611", model.crs)
        self.assertEqual(model.height(500015, 3999985), whole_heights()[0, 0])
        self.assertEqual(model.height(500045, 3999985), whole_heights()[0, 1])
        self.assertEqual(model.height(500015, 3999955), whole_heights()[1, 0])
        for transform in ((500000, 30, 0, 4000000, 0, -30), (30, 0, 500000, 0, -30, 4000000), "north up", 30):
            with self.subTest(transform), self.assertRaisesRegex(TypeError, "Affine"):
                arete.build(whole_heights(), transform=transform)

    def test_a_crs_is_text_a_number_or_an_object(self):
        class Crs:
            def to_wkt(self):
                return arete.build(whole_heights(), transform=place, crs=32611).crs

        place = Affine(30, 0, 500000, 0, -30, 4000000)
        models = [arete.build(whole_heights(), transform=place, crs=crs) for crs in (32611, "EPSG:32611", Crs())]
        self.assertEqual(len({model.crs for model in models}), 1)
        self.assertIsNone(arete.build(whole_heights()).crs)
        with self.assertRaisesRegex(ValueError, "EPSG:999999"):
            arete.build(whole_heights(), transform=place, crs=999999)
        with self.assertRaises(TypeError):
            arete.build(whole_heights(), transform=place, crs=3.5)
        with self.assertRaisesRegex(ValueError, "needs a transform"):
            arete.build(whole_heights(), crs=32611)

    def test_a_transform_is_refused_beside_a_path(self):
        with self.assertRaisesRegex(TypeError, "transform"):
            arete.build("dem.tif", transform=Affine(1, 0, 0, 0, 1, 0))


if __name__ == "__main__":
    unittest.main()
