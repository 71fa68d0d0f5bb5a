# SPDX-License-Identifier: GPL-3.0-or-later
"""The example of docs/topics/scenes.md opens, and the schema of scenes and the program agree on what a scene is."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import blocks
import inputs

try:
    import jsonschema
except ImportError:
    jsonschema = None

PAGE, SCHEMA = "docs/topics/scenes.md", pathlib.Path("docs/topics/scene.schema.json")
ARETE = str(pathlib.Path(os.environ.get("ARETE_BUILD", "build/release")) / "arete")
MESH = {"name": "m", "file": "scan.obj"}
# What one object says, and whether that is a scene.
OBJECTS = [
    ({}, True), ({"at": [1, 2]}, True), ({"at": [1, 2, 3], "above": -1}, True), ({"turn": [1, 2, 3]}, True), ({"level": {"error": 0}}, True),
    ({"level": {"triangles": 9}, "visible": False, "tolerance": 0.5, "up": "z", "anchor": "base", "scale": 2}, True),
    ({"at": [1]}, False), ({"at": [1, 2, 3, 4]}, False), ({"at": "1,2"}, False), ({"at": [1, 2], "lonlat": [1, 2]}, False),
    ({"turn": [1, 2]}, False), ({"scale": 0}, False), ({"scale": "1"}, False), ({"up": "x"}, False), ({"anchor": "middle"}, False),
    ({"tolerance": -1}, False), ({"level": {}}, False), ({"level": {"error": -1}}, False), ({"level": {"triangles": 0}}, False),
    ({"level": {"error": 1, "triangles": 1}}, False), ({"visible": "yes"}, False), ({"colour": "red"}, False), ({"name": ""}, False),
    ({"instances": []}, False), ({"instances": [{"file": "scan.obj"}]}, False), ({"instances": [{"at": [1, 2]}, {"scale": 2}]}, True),
    ({"at": [1, 2], "instances": [{}, {"at": [3, 4]}]}, True), ({"file": ""}, False), ({"name": 1}, False)]


class Scenes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="arete-scenes-")
        cls.folder = pathlib.Path(cls.scratch.name)
        inputs.make(cls.folder, str(pathlib.Path(ARETE).absolute()))
        (cls.example,) = [json.loads(b.text) for b in blocks.all_blocks() if str(b.page) == PAGE and b.kind == "json"]

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def opened(self, scene):
        (self.folder / "tried.json").write_text(json.dumps(scene))
        return subprocess.run([str(pathlib.Path(ARETE).absolute()), "info", "tried.json", "--json"], cwd=self.folder, capture_output=True,
                              text=True)

    def test_the_example_opens(self):
        done = self.opened(self.example)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([o["name"] for o in json.loads(done.stdout)["objects"]], ["ground", "mast", "house", "rock", "tree 1", "tree 2", "idle"])

    @unittest.skipIf(jsonschema is None, "needs python3-jsonschema")
    def test_the_schema_takes_what_the_program_takes(self):
        schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
        valid = jsonschema.Draft202012Validator(schema)
        self.assertTrue(valid.is_valid(self.example))
        for keys, is_right in OBJECTS:
            with self.subTest(keys=keys):
                scene = {"objects": [{**MESH, **keys}]}
                self.assertEqual(valid.is_valid(scene), is_right)
                self.assertEqual(self.opened(scene).returncode == 0, is_right)
        for scene in ([], {}, {"objects": []}, {"objects": [{}]}, {"objects": [MESH], "units": "m"}, {"crs": 3, "objects": [MESH]}):
            with self.subTest(scene=scene):
                self.assertFalse(valid.is_valid(scene))
                self.assertNotEqual(self.opened(scene).returncode, 0)


if __name__ == "__main__":
    unittest.main()
