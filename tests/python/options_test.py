# SPDX-License-Identifier: GPL-3.0-or-later
"""Every option of the command has its name in Python, or a reason why not."""

import inspect
import os
import re
import subprocess
import tempfile
import unittest

import arete

COMMAND = os.environ.get("ARETE", "arete")

# Of every command: output, terminal, process.
EVERYWHERE = {
    "help": "help() is Python's", "help-all": "help() is Python's", "json": "answers are objects",
    "quiet": "warnings are Python's", "progress": "an argument of its own: a function",
    "threads": "of the process", "no-huge-pages": "of the process", "confined": "of services",
    "output": "what save() writes", "format": "of the output", "overwrite": "of the output", "log": "of the terminal",
    "cache": "of the terminal", "memory": "of the process",
}

# Functions of a command. An option is an argument of one of them.
FUNCTIONS = {
    "build": [arete.build, arete.build_points, arete.build_surface, arete.Model.save, arete.Surface.save],
    "info": [arete.Model.curve, arete.Surface.curve],
    "extract": [arete.Model.cut, arete.Surface.cut, arete.Tin.save, arete.Camera, arete.SurfaceCamera],
    "height": [arete.Model.height],
    "los": [arete.Model.los],
    "profile": [arete.Model.profile],
    "viewshed": [arete.Model.viewshed],
    "measure": [arete.measure],
    "validate": [arete.Model.validate, arete.Surface.validate],
    "convert": [arete.build, arete.build_surface, arete.Model.save, arete.Surface.save, arete.Tin.save],
    "mesh info": [arete.mesh_info],
    "mesh repair": [arete.repair, arete.Mesh.save],
    "mesh decimate": [arete.decimate, arete.Mesh.save],
}

# Commands of windows, of pictures and of files alone.
WITHOUT = {
    "view": "a window; plot() draws", "demo": "files of its own", "manual": "of the terminal", "help": "help() is Python's",
    "version": "arete is imported", "mesh": "its commands are functions",
    "mesh crop": "writes a file of a file; a region of Surface.cut() is the place of an error",
    "mesh place": "writes a file of a file; arrays are turned by numpy",
}

# An argument that is an option by another name.
RENAMED = {
    ("height", "at"): "x", ("los", "from"): "observer", ("los", "to"): "target", ("profile", "along"): "line",
    ("build", "no-features"): "features", ("extract", "look"): "azimuth", ("extract", "no-displacement"): "displaced",
    ("mesh info", "no-self-intersections"): "self_intersections",
}

# Options that have none, and why.
EXCEPTED = {
    ("build", "as"): "build() makes terrain, build_points() terrain of points, build_surface() a surface",
    ("height", "points"): "x and y are arrays: geopandas reads tables", ("height", "layer"): "as points",
    ("extract", "parallel-height"): "views of Python are in perspective",
    ("los", "pairs"): "observer and target are rows", ("los", "points"): "as pairs", ("los", "layer"): "as pairs",
    ("los", "observer-height"): "the third number of each row", ("los", "target-height"): "the third number of each row",
    ("profile", "layer"): "the line is rows, or of shapely", ("profile", "csv"): "output", ("profile", "png"): "plot()",
    ("viewshed", "observers"): "observer may be rows", ("viewshed", "layer"): "as observers",
    ("viewshed", "observer-height"): "the third number of each row", ("viewshed", "polygons"): "output",
    ("viewshed", "png"): "plot()", ("viewshed", "no-decorations"): "of --png",
    ("measure", "as"): "Model.measure() has the samples of the model, points or not",
    ("measure", "error-raster"): "output; Tin.save() has it", ("measure", "error-mesh"): "output",
    ("mesh decimate", "map"): "output; source_vertices of the result", ("convert", "up"): "of a file written of a file",
    ("convert", "unit"): "of a file written of a file", ("mesh repair", "up"): "of the output",
    ("mesh repair", "unit"): "of the output", ("mesh decimate", "up"): "of the output", ("mesh decimate", "unit"): "of the output",
    ("convert", "flip-v"): "of a file written of a file", ("extract", "flip-v"): "of the output", ("extract", "levels"): "output",
    ("mesh decimate", "flip-v"): "of the output", ("mesh repair", "flip-v"): "of the output",
}


def declared():
    """Options by command, as the manual pages declare them."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([COMMAND, "manual", "--man", folder], check=True, capture_output=True)
        options = {}
        for page in sorted(os.listdir(folder)):
            command = page[len("arete-"):-len(".1")].replace("mesh-", "mesh ") if page.startswith("arete-") else ""
            with open(os.path.join(folder, page), encoding="utf-8") as file:
                text = file.read().replace("\\-", "-")
            heads = [line for before, line in zip([""] + text.split("\n"), text.split("\n")) if before.startswith(".TP")]
            options[command] = sorted({name for line in heads for name in re.findall(r"--([a-z][a-z-]*)", line)})
        return options


class Options(unittest.TestCase):
    def setUp(self):
        self.declared = declared()

    def arguments_of(self, command):
        return {name for function in FUNCTIONS[command] for name in inspect.signature(function).parameters}

    def test_every_option_has_its_name(self):
        self.assertGreater(len(self.declared["extract"]), 25)
        missing = []
        for command, options in self.declared.items():
            if command in WITHOUT or command == "":
                continue
            arguments = self.arguments_of(command)
            for option in options:
                name = RENAMED.get((command, option), option.replace("-", "_"))
                if option not in EVERYWHERE and (command, option) not in EXCEPTED and name not in arguments:
                    missing.append(f"{command} --{option}")
        self.assertEqual(missing, [])

    def test_no_exception_is_left_over(self):
        for command, option in [*EXCEPTED, *RENAMED]:
            if (command, option) == ("viewshed", "polygons"):
                continue
            self.assertIn(option, self.declared[command], command)
        for command, option in EXCEPTED:
            self.assertNotIn(option.replace("-", "_"), self.arguments_of(command), command)


if __name__ == "__main__":
    unittest.main()
