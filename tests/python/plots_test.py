# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures: what they show is what the arrays say, and what notebooks and help() show."""

import base64
import copy
import importlib.util
import os
import pickle
import pydoc
import re
import struct
import unittest

import numpy as np

os.environ.setdefault("MPLBACKEND", "Agg")

import arete

HAS_MATPLOTLIB = importlib.util.find_spec("matplotlib") is not None


class Affine(tuple):
    a, b, c, d, e, f = (property(lambda self, i=i: self[i]) for i in range(6))


METRES = Affine((30, 0, 500000, 0, -30, 4000000))
DEGREES = Affine((1 / 3600, 0, 8, 0, -1 / 3600, 60))


def hills(rows=40, columns=60):
    y, x = np.mgrid[0:rows, 0:columns]
    return 100 * np.sin(x / 9) * np.cos(y / 7) + 300


def ramp(slope, step_x, step_y, rows=6, columns=7):
    """A plane that rises to the east by `slope` for 1 on the ground."""
    y, x = np.mgrid[0:rows, 0:columns]
    return slope * step_x * x + 0 * step_y * y


class Slopes(unittest.TestCase):
    def test_a_slope_is_that_of_the_ground_in_metres(self):
        metre_of_degree = 111412.84 * np.cos(np.radians(60)) - 93.5 * np.cos(np.radians(180))
        step = metre_of_degree / 3600
        feet = 0.3048
        for name, heights, place, crs, unit in (
                ("metres", ramp(1, 30, 30), METRES, 32611, "m"), ("feet", ramp(1, 30, 30) / feet, METRES, 32611, "ft"),
                ("degrees", ramp(1, step, step), DEGREES, 4326, "m"), ("no CRS", ramp(1, 30, 30), METRES, None, None),
                ("a stretched map", ramp(1, 30 * np.cos(np.radians(60)), 30), Affine((30, 0, 0, 0, -30, 8399738)), 3857, "m")):
            with self.subTest(name):
                tin = arete.build(heights, transform=place, crs=crs, vertical_unit=unit).cut(max_error=0)
                slopes = tin.slopes()
                self.assertEqual(slopes.shape, (len(tin.triangles),))
                self.assertTrue(np.allclose(slopes, 45, atol=0.3), slopes)
                self.assertTrue(np.array_equal(pickle.loads(pickle.dumps(tin)).slopes(), slopes))

    def test_a_slope_is_the_same_wherever_on_the_globe(self):
        rows = np.arange(30)[:, np.newaxis] * 50000.0 + np.zeros(300)
        tin = arete.build(rows, transform=Affine((1, 0, -150, 0, -1, 60)), crs=4326, vertical_unit="m").cut(max_error=0)
        slopes = tin.slopes()
        self.assertGreater(slopes.min(), 23.9)
        self.assertLess(slopes.max(), 24.5)

    def test_level_ground_and_walls(self):
        flat = arete.build(np.zeros((4, 5))).cut(max_error=0)
        self.assertTrue((flat.slopes() == 0).all())
        surface = arete.build_surface([[0, 0, 0], [1, 0, 0], [0, 0, 1], [0, 1, 0.0]], [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
        steep = np.sort(surface.cut(max_error=0).slopes())
        self.assertTrue(np.allclose(steep, [0, np.degrees(np.arctan(np.sqrt(2))), 90, 90]))


@unittest.skipUnless(HAS_MATPLOTLIB, "matplotlib is not installed")
class Plots(unittest.TestCase):
    def setUp(self):
        from matplotlib import pyplot

        self.addCleanup(pyplot.close, "all")
        self.model = arete.build(hills(), transform=METRES, crs=32611, vertical_unit="m")
        self.tin = self.model.cut(max_error=2)

    def drawn(self, ax):
        ax.figure.canvas.draw()
        return ax.collections[0].get_array()

    def test_a_tin_is_drawn_by_height_error_and_slope(self):
        for by, values, label in (("height", self.tin.vertices[:, 2], "height (m)"), ("error", self.tin.errors, "error (m)"),
                                  ("slope", self.tin.slopes(), "slope (degrees)")):
            with self.subTest(by):
                ax = self.tin.plot(by)
                self.assertTrue(np.array_equal(self.drawn(ax), values))
                self.assertEqual(ax.figure.axes[1].get_ylabel(), label)
        self.assertEqual(len(self.tin.plot(colorbar=False).figure.axes), 1)
        with self.assertRaisesRegex(ValueError, "aspect"):
            self.tin.plot("aspect")
        with self.assertRaisesRegex(ValueError, "no errors"):
            arete.repair(self.tin).plot("error")

    def test_as_many_vertices_as_triangles_are_no_confusion(self):
        vertices = np.array([[0, 0, 0], [1, 0, 1], [1, 1, 2], [0, 1, 3], [0.5, 0.5, 4]], dtype=float)
        mesh = arete.repair(vertices, [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 3, 2]])
        self.assertEqual(len(mesh.slopes()), 5)
        mesh.plot("slope")
        mesh.plot("height")

    def test_a_model_draws_a_cut_and_says_how_far_it_is_off(self):
        ax = self.model.plot("slope", max_triangles=500)
        triangles = int(re.search(r"(\d+) triangles", ax.get_title())[1])
        self.assertLessEqual(triangles, 500)
        self.assertEqual(len(self.drawn(ax)), triangles)
        self.assertIn("error", self.model.plot(max_error=5).get_title())

    def test_ground_lengths_are_alike_along_both_axes(self):
        ax = arete.build(hills(), transform=DEGREES, crs=4326).cut(max_error=2).plot()
        self.assertAlmostEqual(ax.get_aspect(), 2.0, delta=0.02)
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("longitude", "latitude"))
        self.assertAlmostEqual(self.tin.plot().get_aspect(), 1.0, delta=0.001)

    def test_axes_are_those_that_are_given(self):
        from matplotlib import pyplot

        figure, axes = pyplot.subplots(1, 2)
        self.assertIs(self.tin.plot(ax=axes[1]), axes[1])
        self.assertEqual(len(axes[0].collections), 0)
        self.assertEqual(len(pyplot.get_fignums()), 1)

    def test_a_surface_is_drawn_in_space(self):
        y, x = np.mgrid[0:12, 0:12]
        tin = arete.build(np.sin(x / 3) * np.cos(y / 3)).cut(max_error=0)
        surface = arete.build_surface(tin)
        for by in ("height", "error", "slope"):
            self.assertTrue(hasattr(surface.plot(by), "set_zlim"))
        with self.assertRaisesRegex(ValueError, "3d"):
            surface.cut(max_error=1).plot(ax=self.tin.plot())

    def test_a_profile_leaves_gaps_open(self):
        heights = hills()
        heights[:, 25:30] = np.nan
        model = arete.build(heights, transform=METRES, crs=32611, vertical_unit="m")
        profile = model.profile([(500050, 3999500), (501700, 3999500)])
        self.assertEqual(profile.part.max(), 2)
        ax = profile.plot()
        self.assertEqual(len(ax.lines), 2)
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("distance (m)", "height (m)"))
        self.assertTrue(np.array_equal(ax.lines[0].get_ydata(), profile.height[profile.part == 1]))
        sight = self.model.profile([(500050, 3999500, 10), (501700, 3999500, 10)], frequency=2400)
        labels = [text.get_text() for text in sight.plot().get_legend().get_texts()]
        self.assertEqual(labels, ["line of sight", "first Fresnel zone"])

    def test_a_viewshed_names_its_answers(self):
        seen = self.model.viewshed((500600, 3999500, 10), radius=500)
        ax = seen.plot()
        names = [text.get_text() for text in ax.figure.axes[1].get_yticklabels()]
        self.assertEqual(sorted(names), ["hidden", "outside", "seen"])
        left, right, bottom, top = ax.images[0].get_extent()
        self.assertEqual((left, right, bottom, top), (500000, 500000 + 60 * 30, 4000000 - 40 * 30, 4000000))
        self.assertEqual(ax.lines[0].get_xdata()[0], 500600)
        self.model.viewshed((500600, 3999500, 10), mode="height").plot()
        count = self.model.viewshed([(500600, 3999500, 10), (500900, 3999500, 10)], mode="count").plot()
        bar = count.images[0].colorbar
        self.assertTrue(all(tick == int(tick) for tick in bar.get_ticks()))
        self.assertLessEqual(count.images[0].cmap.N, 3)  # of none, one, two observers

    def test_what_jupyter_shows_has_a_picture(self):
        for shown in (self.model, self.tin, arete.repair(self.tin), arete.build_surface(self.tin),
                      self.model.profile([(500050, 3999500), (501700, 3999500)]), self.model.viewshed((500600, 3999500, 10))):
            page = shown._repr_html_()
            picture = base64.b64decode(re.search(r"base64,([^']+)'", page)[1])
            width, height = struct.unpack(">II", picture[16:24])
            self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
            self.assertGreater(min(width, height), 200)
        from matplotlib import pyplot

        self.assertEqual(pyplot.get_fignums(), [])

    def test_names_are_escaped(self):
        import unittest.mock

        with unittest.mock.patch.object(arete.Model, "info", lambda self: {
                "kind": "terrain", "source": "<script>", "crs": "", "finest_triangles": 1}):
            self.assertNotIn("<script>", self.model._repr_html_())

    def test_ramps_grow_in_lightness_from_one_end_to_the_other(self):
        from matplotlib import colormaps

        from arete._plot import RAMPS

        for name in RAMPS.values():
            rgb = colormaps[name](np.linspace(0, 1, 64))[:, :3]
            linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
            steps = np.diff(linear @ (0.2126, 0.7152, 0.0722))
            self.assertTrue((steps > 0).all() or (steps < 0).all(), name)


class Viewsheds(unittest.TestCase):
    def setUp(self):
        self.model = arete.build(hills(), transform=METRES, crs=32611, vertical_unit="m")
        self.seen = self.model.viewshed((500600, 3999500, 10))

    def test_it_is_an_array_and_its_parts_are_plain(self):
        self.assertIsInstance(self.seen, np.ndarray)
        self.assertEqual((self.seen.dtype, self.seen.shape), (np.dtype(np.uint8), (40, 60)))
        for part in (self.seen[3:9], self.seen[2], self.seen == 255, self.seen + 1, np.flipud(self.seen)):
            self.assertIs(type(part), np.ndarray)
        self.assertIsInstance(self.seen[2, 3], np.uint8)
        self.assertEqual(int((self.seen == 255).sum()), np.count_nonzero(np.asarray(self.seen) == 255))
        with self.assertRaisesRegex(ValueError, "part"):
            self.seen.T.plot()
        for whole in (self.seen.copy(), copy.copy(self.seen), copy.deepcopy(self.seen)):
            self.assertEqual((whole.mode, whole.transform), ("seen", self.seen.transform))
            self.assertFalse(np.shares_memory(whole, self.seen))
        again = pickle.loads(pickle.dumps(self.seen))
        self.assertEqual((again.mode, again.transform, again.crs), ("seen", self.seen.transform, self.seen.crs))
        self.assertTrue(np.array_equal(again, self.seen))

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "xarray is not installed")
    def test_xarray_knows_the_place_and_the_names(self):
        array = self.seen.to_xarray()
        self.assertEqual((float(array.x[0]), float(array.y[0])), (500015, 3999985))
        flags = dict(zip(array.attrs["flag_meanings"].split(), array.attrs["flag_values"]))
        self.assertEqual(flags["seen"], 255)


class Help(unittest.TestCase):
    def test_help_fits_a_few_screens(self):
        text = pydoc.plain(pydoc.render_doc(arete))
        self.assertLess(len(text.split("\n")), 100)
        for name in vars(arete):
            value = getattr(arete, name)
            if not name.startswith("_") and not isinstance(value, type(unittest)) and callable(value):
                self.assertIn(name, text)
                self.assertTrue(value.__doc__, name)


if __name__ == "__main__":
    unittest.main()
