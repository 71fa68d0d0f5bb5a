# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures that docs/start states of the generated DEM are the ones that the program gives today (half a minute)."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import blocks

BUILD = pathlib.Path(os.environ["ARETE_BUILD"])


def grouped(number):
    return f"{number:,}".replace(",", " ")


class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="arete-pages-")
        cls.run_in(BUILD / "arete-datasets", "generate", "-o", "dem.tif", "-q")
        cls.run_in(BUILD / "arete", "build", "dem.tif", "-o", "delaunay.amt", "-q")
        cls.run_in(BUILD / "arete", "build", "dem.tif", "-o", "fidelity.amt", "--shape", "fidelity", "-q")
        cls.run_in(BUILD / "arete", "build", "dem.tif", "-o", "packed.amt", "--packed", "-q")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def run_in(cls, *command):
        return subprocess.run(command, cwd=cls.folder.name, check=True, capture_output=True, text=True).stdout

    @staticmethod
    def page(name):
        return (blocks.ROOT / "docs" / "start" / f"{name}.md").read_text(encoding="utf-8")

    def test_the_table_of_the_tutorial_is_what_info_prints(self):
        printed = self.run_in(BUILD / "arete", "info", "delaunay.amt")
        table = next(b.text for b in blocks.blocks_of("tutorial", self.page("tutorial")) if "minimal" in b.text)
        lines = [line.split() for line in printed.split("\n")]
        for row in table.split("\n"):
            self.assertIn(row.split(), lines)
        self.assertIn("2 085 938", printed)

    def test_the_triangles_and_errors_of_each_choice(self):
        choose = self.page("choose")
        for shape in ("delaunay", "fidelity"):
            for fit in ((), ("--fit", "triangles")):
                self.run_in(BUILD / "arete", "extract", f"{shape}.amt", "-o", "tin.ply", "--max-error", "20", *fit)
                said = json.loads(self.run_in(BUILD / "arete", "measure", "tin.ply", "dem.tif", "--json"))
                name = f"`{shape}`" + (", `--fit triangles`" if fit else "")
                row = f"| {name} | {grouped(said['triangles'])} | {said['error']['rms']:.1f} m | {said['error']['mean']:.1f} m |"
                self.assertIn(row, choose)

    def test_the_sizes_of_files(self):
        sizes = [f"{os.path.getsize(pathlib.Path(self.folder.name, name)) / 1e6:.1f} MB" for name in ("delaunay.amt", "packed.amt")]
        self.assertIn(f"| {sizes[0]} | {sizes[1]} |", self.page("choose"))


if __name__ == "__main__":
    unittest.main()
