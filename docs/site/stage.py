# SPDX-License-Identifier: GPL-3.0-or-later
"""Prepares the pages of the site: stage.py OUTPUT, in the root folder, after Doxygen.

Copies README.md, the other root pages, docs/ and examples/ to OUTPUT/pages. The text in the repository names files
by their path ("docs/topics/cuts.md", "engine/cut/cut.h", "decision 15") and papers by their key ("[Dyn1990]"); here
these become links. Every path that does not exist, and every key that is not in docs/bibliography.md, is an error.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

ROOT_PAGES = {
    "README.md": "index.md",
    "ARCHITECTURE.md": "architecture.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    "SECURITY.md": "security.md",
    "bench/figures.md": "figures.md",
}
# The pages for newcomers, in the order in which they help.
START = ["install", "tutorial", "choose", "limits", "compare", "faq", "help", "roadmap"]
# The topics by reader. Every page of docs/topics is in one group.
READERS = {
    "Maps and terrain": ["reading", "heights", "gdal", "qgis", "web", "formats"],
    "Simulation and proof": ["error", "cuts", "fit", "certificate"],
    "Visibility": ["visibility", "scenes"],
    "Meshes": ["surfaces", "meshes", "decimation", "distance"],
    "Drawing": ["viewer", "flights", "geomorphing"],
    "Programming": ["python", "library", "package", "services", "log", "multitriangulation", "amt-format", "sources"],
}
# The contact and the tracker that CMake has for the build; pages leave out what is empty.
CONTACT = {"ARETE_TRACKER_URL": "Faults are reported at", "ARETE_CONTACT": "The contact of this build, also for reports in private, is"}
FOLDERS = "bench|cli|cmake|datasets|docs|engine|examples|gis|io|measure|surface|terrain|tests|viewer"
# A path from the root of the repository, in the text or in backticks.
# `arete/engine/...` is an installed header.
PATH = re.compile(rf"`((?:arete/)?(?:{FOLDERS})/[\w./-]*)`|(?<![\w/.`<\[\"-])((?:{FOLDERS})/[\w./-]*\w|[A-Z]+\.md)\b/?")
# A file without its folder, as in "and cut.h".
BARE = re.compile(r"(?<![\w/.<*-])`?([a-z0-9_]+\.(?:h|cpp|py|md))\b`?")
DECISION = re.compile(r"\b([Dd]ecision )(\d+)\b")
# A key of the bibliography.
CITATION = re.compile(r"(?<![\w\]\\])\[((?:de)?[A-Z][A-Za-z]+[0-9]{4}[a-z]?)\](?!\()")
# The same in the status of a decision, as in "superseded by 0028".
NUMBER = re.compile(r"(?<![\w.])([Dd]ecision |(?=00\d\d\b))(\d+)\b")
MARKDOWN_LINK = re.compile(r"(!?\[[^\]]*\]\()([^)#]+)(#[^)]*)?\)")
LINK_OR_CODE = re.compile(r"(`[^`]*`|!?\[[^\]]*\]\([^)]*\))")


class Site:
    def __init__(self, output):
        self.output = output
        self.pages = output / "pages"
        self.errors = []
        tracked = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True, check=True)
        self.files = {f for f in tracked.stdout.split("\n") if f and os.path.exists(f)}
        self.folders = {str(parent) for f in self.files for parent in pathlib.Path(f).parents}
        self.names = {pathlib.Path(f).name for f in self.files}
        self.keys = set(re.findall(r"^\*\*\[(\w+)\]\*\*", self.read("docs/bibliography.md"), re.M))
        self.headers = {}
        root = os.getcwd() + "/"
        for compound in xml.parse(output / "api.tag").getroot().iter("compound"):
            if compound.get("kind") == "file":
                path = (compound.findtext("path") + compound.findtext("name")).removeprefix(root)
                name = compound.findtext("filename")
                self.headers[path] = "api/" + (name if name.endswith(".html") else name + ".html")

    @staticmethod
    def read(path):
        return pathlib.Path(path).read_text(encoding="utf-8") if os.path.exists(path) else ""

    def staged(self, path):
        """The page of the site that shows this file of the repository; None if there is none."""
        if path in ROOT_PAGES:
            return ROOT_PAGES[path]
        if path in self.headers:
            return self.headers[path]
        if path.startswith("docs/") and path.endswith((".md", ".png")) and path in self.files:
            return path.removeprefix("docs/")
        if path.startswith("examples/") and path.endswith(".cpp"):
            return path.removesuffix(".cpp") + ".md"
        return {"docs/decisions": "decisions/README.md", "examples": "examples/index.md"}.get(path)

    def link(self, page, label, target, anchor=""):
        return f"[{label}]({os.path.relpath(target, os.path.dirname(page) or '.')}{anchor})"

    def resolve(self, source, page, match):
        code, plain = match.group(1), match.group(2)
        path = (code or plain).removeprefix("arete/").rstrip("/")
        numbered = re.fullmatch(r"docs/decisions/(\d{4})", path)
        if numbered:
            found = [f for f in self.files if f.startswith(path + "-")]
            path = found[0] if found else path
        if path not in self.files and path not in self.folders:
            if path.endswith((".h", ".cpp", ".md", ".py", ".txt", ".cmake")) or code or numbered:
                self.errors.append(f"{source}: there is no {path}")
            return match.group(0)
        target = self.staged(path)
        label = f"`{code}`" if code else f"`{plain}`" if "." in plain else plain
        trail = "/" if plain and match.group(0).endswith("/") else ""
        return self.link(page, label, target) + trail if target and target != page else match.group(0)

    def line(self, source, page, text):
        parts = LINK_OR_CODE.split(text)
        for i, part in enumerate(parts):
            if part.startswith(("[", "!")) and MARKDOWN_LINK.fullmatch(part):
                parts[i] = MARKDOWN_LINK.sub(lambda m: self.written_link(source, page, m), part)
                continue
            if part.startswith("`"):
                parts[i] = PATH.sub(lambda m: self.resolve(source, page, m), part) if PATH.fullmatch(part) else part
                continue
            for name in BARE.findall(part):
                if name not in self.names:
                    self.errors.append(f"{source}: there is no file {name}")
            part = PATH.sub(lambda m: self.resolve(source, page, m), part)
            part = CITATION.sub(lambda m: self.cite(source, page, m), part)
            numbers = NUMBER if source.startswith("docs/decisions/") else DECISION
            parts[i] = numbers.sub(lambda m: self.decision(source, page, m), part)
        return "".join(parts)

    def written_link(self, source, page, match):
        target, anchor = match.group(2), match.group(3) or ""
        if "://" in target:
            return match.group(0)
        path = os.path.normpath(os.path.join(os.path.dirname(source), target))
        staged = self.staged(path)
        if path not in self.files or not staged:
            self.errors.append(f"{source}: the link to {target} leads nowhere")
            return match.group(0)
        return f"{match.group(1)}{os.path.relpath(staged, os.path.dirname(page) or '.')}{anchor})"

    def cite(self, source, page, match):
        key = match.group(1)
        if key not in self.keys:
            self.errors.append(f"{source}: [{key}] is not in docs/bibliography.md")
        if source == "docs/bibliography.md":
            return match.group(0)
        return self.link(page, f"\\[{key}\\]", "bibliography.md", "#" + key)

    def decision(self, source, page, match):
        found = [f for f in self.files if f.startswith(f"docs/decisions/{int(match.group(2)):04d}-")]
        if not found:
            self.errors.append(f"{source}: there is no decision {match.group(2)}")
            return match.group(0)
        return self.link(page, match.group(0), found[0].removeprefix("docs/"))

    def contact(self):
        """Where faults are reported and by whom they are answered, as lines; none where the build does not say."""
        cache = dict(re.findall(r"^(ARETE_\w+):\w+=(.+)$", self.read("build/release/CMakeCache.txt"), re.M))
        said = {name: os.environ.get(name, cache.get(name, "")).strip() for name in CONTACT}
        lines = [f"{CONTACT[name]} {value if '://' not in value else f'<{value}>'}." for name, value in said.items() if value]
        return ["", "## Where", "", " ".join(lines)] if lines else []

    def stage(self, source, page):
        lines, fenced = [], False
        for text in self.read(source).split("\n"):
            fenced ^= text.startswith("```")
            is_code = fenced or text.startswith(("    ", "```")) and not re.match(r"\s+[*\d-]", text)
            if source == "docs/bibliography.md":
                text = re.sub(r"^\*\*\[(\w+)\]\*\*", r'<a id="\1"></a>**[\1]**', text)
            elif not is_code and not text.startswith("#"):
                text = self.line(source, page, text)
            lines.append(text)
        if source in ("docs/start/help.md", "SECURITY.md"):
            lines += self.contact()
        self.write(page, "\n".join(lines))

    def write(self, page, text):
        path = self.pages / page
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def main():
    output = pathlib.Path(sys.argv[1])
    site = Site(output)
    for source, page in ROOT_PAGES.items():
        site.stage(source, page)
    docs = sorted(f for f in site.files if f.startswith("docs/") and f.endswith(".md"))
    for source in docs:
        site.stage(source, source.removeprefix("docs/"))
    shutil.copy("docs/site/extra.css", site.pages)
    for picture in (f for f in site.files if f.startswith("docs/pictures/")):
        target = site.pages / picture.removeprefix("docs/")
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(picture, target)
    examples = sorted(f for f in site.files if f.startswith("examples/") and f.endswith(".cpp"))
    for source in examples:
        page = site.staged(source)
        site.write(page, f"# {pathlib.Path(source).name}\n\n```cpp\n{site.read(source)}```\n")
    names = [pathlib.Path(e).name for e in examples]
    site.write("examples/index.md", "# Examples\n\nPrograms of a few lines that use Arete as a library "
               "([how to build them](../topics/library.md)).\n\n"
               + "".join(f"* [{name}]({name.removesuffix('.cpp')}.md)\n" for name in names))

    def section(name, pages):
        return [f"  - {name}:"] + [f"    - {page}" for page in pages]

    def listed(folder, names):
        missing = [f"{folder}/{name}.md" for name in names if f"{folder}/{name}.md" not in site.files]
        site.errors += [f"docs/site/stage.py: there is no {path}" for path in missing]
        return [f"{folder}/{name}.md" for name in names]

    start, topics = listed("docs/start", START), [t for names in READERS.values() for t in listed("docs/topics", names)]
    for page in docs:
        if page.startswith(("docs/start/", "docs/topics/")) and page not in start + topics:
            site.errors.append(f"{page} is in no group of docs/site/stage.py")
    nav = ["nav:", "  - Home: index.md"]
    nav += section("Start", [site.staged(page) for page in start])
    nav += ["  - Topics:"]
    for reader, names in READERS.items():
        nav += [f"    - {reader}:"] + [f"      - topics/{name}.md" for name in names]
    nav += ["  - Reference:", "    - Headers: api/files.html", "    - glossary.md", "    - bibliography.md",
            "    - performance.md", "    - figures.md", "    - changelog.md"]
    nav += section("Examples", ["examples/index.md"] + [site.staged(e) for e in examples])
    nav += ["  - Inside:", "    - architecture.md", "    - contributing.md", "    - security.md"]
    nav += section("Decisions", ["decisions/README.md"] +
                   [site.staged(d) for d in docs if re.match(r"docs/decisions/\d", d)])
    config = site.read("docs/site/mkdocs.yml")
    (output / "mkdocs.yml").write_text(config + "\n".join(nav) + "\n", encoding="utf-8")
    for error in sorted(set(site.errors)):
        print(error, file=sys.stderr)
    sys.exit(1 if site.errors else 0)


main()
