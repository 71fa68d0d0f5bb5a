# SPDX-License-Identifier: GPL-3.0-or-later
"""check_links.py FOLDER: fails on every link within a site, and every picture, that leads nowhere.

Anchors are checked in the pages; those of Doxygen's own pages (api/) are left to Doxygen.
"""
import html.parser
import os
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            elif name == "src" and value or name == "href" and value and tag == "a":
                self.links.append(value)


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    pages = {p: Page(p.read_text(encoding="utf-8", errors="replace"))
             for p in root.rglob("*.html") if p.name != "404.html"}
    broken = []
    for path, page in pages.items():
        of_doxygen = root / "api" in path.parents
        for link in page.links:
            url = urllib.parse.urlsplit(link)
            if url.scheme or url.netloc:
                continue
            target = pathlib.Path(os.path.normpath(path.parent / urllib.parse.unquote(url.path))) if url.path else path
            anchor = urllib.parse.unquote(url.fragment)
            if target.is_dir():
                target = target / "index.html"
            if not target.exists():
                broken.append(f"{path.relative_to(root)}: {link} leads nowhere")
            elif anchor and not of_doxygen and target in pages and anchor not in pages[target].anchors and not anchor.startswith("__"):
                broken.append(f"{path.relative_to(root)}: {link} has no such place")
    print("\n".join(sorted(set(broken))), file=sys.stderr)
    sys.exit(1 if broken else 0)


main()
