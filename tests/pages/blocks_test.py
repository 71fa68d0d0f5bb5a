# SPDX-License-Identifier: GPL-3.0-or-later
"""The blocks of pages are found, and each has a kind that something checks."""
import json
import re
import unittest
import xml.etree.ElementTree

import blocks
import marks

PAGE = """text

    arete a  # one
    arete b \\
      --more
    arete c
      --deeper

* item

    goes on

words

    import numpy
    x = 1

```cpp
int x;
```

    #include <x>
"""


class Blocks(unittest.TestCase):
    def test_blocks_are_found_with_their_kinds_and_lines(self):
        found = blocks.blocks_of("p", PAGE)
        self.assertEqual([(b.kind, b.line) for b in found], [("shell", 3), ("python", 15), ("cpp", 19), ("cpp", 22)])
        self.assertEqual(found[1].text, "import numpy\nx = 1")
        self.assertEqual([c for _, c in blocks.commands_of(found[0])],
                         ["arete a  # one", "arete b   --more", "arete c  --deeper"])

    def test_every_block_of_every_page_has_a_kind(self):
        found = blocks.all_blocks()
        self.assertGreater(len(found), 50)
        self.assertEqual([f"{b.page}:{b.line}" for b in found if b.kind == "?"], [])

    def test_blocks_of_json_and_xml_can_be_parsed(self):
        for block in blocks.all_blocks():
            with self.subTest(page=block.page, line=block.line):
                if block.kind == "json":
                    json.loads(block.text)
                if block.kind == "xml":
                    xml.etree.ElementTree.fromstring(block.text)

    def test_no_list_holds_a_block_which_nothing_would_run(self):
        for page in blocks.pages():
            lines = page.read_text(encoding="utf-8").split("\n")
            hidden = [i + 1 for i, line in enumerate(lines) if line.startswith(" " * 8) and not lines[i - 1].strip()
                      and blocks.in_a_list(lines, i)]
            self.assertEqual(hidden, [], page)

    def test_no_page_names_a_person_to_write_to(self):
        # ARETE_CONTACT and ARETE_TRACKER_URL do, for the build that sets them (docs/site/stage.py).
        for page in (*blocks.pages(), blocks.ROOT / "CITATION.cff"):
            self.assertEqual(re.findall(r"[\w.+-]+@[\w-]+\.\w+|https?://\S*(?:issues|tracker)\b\S*", page.read_text(encoding="utf-8")), [], page)

    def test_pages_for_newcomers_load_fast(self):
        for page in (blocks.ROOT / "README.md", *(blocks.ROOT / "docs/start").glob("*.md")):
            text = page.read_text(encoding="utf-8")
            self.assertLess(text.count("\n"), 200, page)
            for picture in re.findall(r"!\[[^\]]+\]\(([^)]+)\)", text):
                self.assertLess((page.parent / picture).stat().st_size, 150_000, picture)

    def test_the_citation_is_of_the_version_that_is_built(self):
        version = re.search(r"project\(arete VERSION ([\d.]+)", (blocks.ROOT / "CMakeLists.txt").read_text())[1]
        self.assertIn(f"\nversion: {version}\n", (blocks.ROOT / "CITATION.cff").read_text())
        self.assertIn(f"version = {{{version}}}", (blocks.ROOT / "docs/start/help.md").read_text())

    def test_every_mark_is_of_a_line_that_a_page_has(self):
        commands = [c for b in blocks.all_blocks() if b.kind == "shell" for _, c in blocks.commands_of(b)]
        unused = [m.pattern for m, _ in marks.NOT_RUN if not any(m.search(c) for c in commands)]
        self.assertEqual(unused, [])


if __name__ == "__main__":
    unittest.main()
