# SPDX-License-Identifier: GPL-3.0-or-later
"""Every option that a page names in its text is an option of some command (examples are run by shell_test.py)."""
import os
import pathlib
import re
import subprocess
import unittest

import blocks

BUILD = pathlib.Path(os.environ["ARETE_BUILD"])
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z0-9-]*")
# Of ./dev and arete-bench, of other programs, and of earlier builds.
OF_OTHERS = {"--full", "--filter", "--only", "--sizes", "--hmm", "--repeats", "--dem", "--install", "--build", "--prefix", "--preset", "--filters",
             "--formats", "--noversioncheck"}


def help_of(program, *command):
    """All options, where --help shows the common ones."""
    for option in ("--help-all", "--help"):
        said = subprocess.run([BUILD / program, *command, option], capture_output=True, text=True)
        if said.returncode == 0:
            return said.stdout
    raise AssertionError(f"{program} {' '.join(command)}: no help")


def options_of(program, command=()):
    """The options of a program and of all its commands, those of help included."""
    text = help_of(program, *command)
    found = set(OPTION.findall(text))
    listed = re.search(r"\nSubcommands:\n(.*?)(?:\n\n|$)", text, re.S)
    for name in re.findall(r"^  (\w[\w-]*)", listed[1], re.M) if listed else ():
        found |= options_of(program, (*command, name))
    return found


class Options(unittest.TestCase):
    def test_every_option_in_the_text_of_a_page_exists(self):
        known = options_of("arete") | options_of("arete-datasets") | OF_OTHERS
        self.assertGreater(len(known), 100)
        for page in blocks.pages():
            if page.name == "CHANGELOG.md" or page.parent.name == "decisions":
                continue  # they tell of options that were
            with self.subTest(page=page.name):
                named = set(OPTION.findall(page.read_text(encoding="utf-8")))
                self.assertEqual(sorted(named - known), [])


if __name__ == "__main__":
    unittest.main()
