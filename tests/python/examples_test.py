# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples of docs/topics/python.md run as they stand."""

import os
import pathlib
import re
import tempfile
import unittest


class Examples(unittest.TestCase):
    def test_every_example_of_the_page_runs(self):
        page = pathlib.Path(os.environ["ARETE_PAGES"], "topics", "python.md").read_text(encoding="utf-8")
        examples = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
        self.assertTrue(examples)
        with tempfile.TemporaryDirectory() as folder:
            before = os.getcwd()
            os.chdir(folder)
            try:
                for example in examples:
                    exec(compile(example, "python.md", "exec"), {})
            finally:
                os.chdir(before)


if __name__ == "__main__":
    unittest.main()
