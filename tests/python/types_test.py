# SPDX-License-Identifier: GPL-3.0-or-later
"""The types that the package states are true: of its own code, and of the module beside its stub."""

import ast
import importlib.util
import pathlib
import subprocess
import sys
import unittest

import arete


class Types(unittest.TestCase):
    @unittest.skipIf(importlib.util.find_spec("mypy") is None, "mypy is not installed")
    def test_the_package_keeps_them(self):
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--cache-dir=/dev/null",
                               "-p", "arete"],
                              capture_output=True, text=True, check=False,
                              cwd=pathlib.Path(arete.__file__).parent.parent)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_stub_names_what_the_module_has(self):
        stub = ast.parse(pathlib.Path(arete.__file__).with_name("_arete.pyi").read_text(encoding="utf-8"))
        stated, found = set(), set()
        for node in stub.body:
            if isinstance(node, ast.FunctionDef):
                stated.add(node.name)
            elif isinstance(node, ast.ClassDef):
                stated.update(f"{node.name}.{member.name}" for member in node.body
                              if isinstance(member, ast.FunctionDef) and not member.name.startswith("_"))
        for name, value in vars(arete._arete).items():
            if name.startswith("_"):
                continue
            if isinstance(value, type):
                found.update(f"{name}.{member}" for member in vars(value) if not member.startswith("_"))
            else:
                found.add(name)
        self.assertEqual(stated, found)


if __name__ == "__main__":
    unittest.main()
