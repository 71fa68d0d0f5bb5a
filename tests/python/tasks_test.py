# SPDX-License-Identifier: GPL-3.0-or-later
"""The ten tasks of docs/topics/python.md: as they stand there they run, in at most as many lines as the others take."""

import html
import importlib.util
import json
import os
import pathlib
import re
import tempfile
import unittest
import warnings

os.environ.setdefault("MPLBACKEND", "Agg")

import numpy as np

import arete


def tasks():
    page = pathlib.Path(os.environ["ARETE_PAGES"], "topics", "python.md").read_text(encoding="utf-8")
    section = page[page.index("## If you come from"):]
    rows = re.findall(r"^\| ([^|`]+) \| (`.*`) \| (`.*`) \|$", section, re.MULTILINE)
    return [(name, *([html.unescape(line) for line in re.findall(r"`([^`]+)`", column)] for column in (there, here)))
            for name, there, here in rows]


class Tasks(unittest.TestCase):
    def test_there_are_ten_and_none_takes_more_lines(self):
        self.assertEqual(len(tasks()), 10)
        for name, there, here in tasks():
            self.assertLessEqual(len(here), len(there), name)
            for line in there:
                compile(line if not line.endswith(":") and not line.startswith(" ") else "0", name, "exec")

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
    def test_they_run(self):
        y, x = np.mgrid[0:60, 0:80]
        with tempfile.TemporaryDirectory() as folder:
            before = os.getcwd()
            os.chdir(folder)
            try:
                self.files(x, y)
                names = {"z": 100.0 * np.sin(x / 9), "x": 600.0, "y": 900.0, "a": (300.0, 300.0), "b": (1500.0, 900.0)}
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore", arete.AreteWarning)
                    for name, _, here in tasks():
                        with self.subTest(name):
                            exec(compile("\n".join(here), name, "exec"), names)
                self.assertEqual(sorted(name for name in os.listdir(".") if name in ("foo.glb", "small.ply", "closed.ply")),
                                 ["closed.ply", "foo.glb", "small.ply"])
            finally:
                os.chdir(before)

    def files(self, x, y):
        class Affine:
            a, b, c, d, e, f = 30, 0, 0, 0, -30, 1800

        model = arete.build(100 * np.sin(x / 9) * np.cos(y / 7), transform=Affine(), crs=32611)
        model.cut(max_error=0).save("dem.tif")
        tin = model.cut(max_error=2)
        tin.save("scan.ply")
        ring = [[300, 300], [1200, 300], [1200, 1200], [300, 1200], [300, 300]]
        with open("park.geojson", "w", encoding="utf-8") as file:
            json.dump({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32611"}}, "features": [
                {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}}]}, file)


if __name__ == "__main__":
    unittest.main()
