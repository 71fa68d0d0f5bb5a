# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples of the pages: fenced blocks, whose language the fence names, and indented ones.

An indented block begins after an empty line. It is C++ if it begins with `#include`, CMake if with `find_package`, Python if
with `import` or `from`, else lines of the shell.
"""
import dataclasses
import pathlib
import re

KINDS = {"sh": "shell", "bash": "shell", "cpp": "cpp", "python": "python", "cmake": "cmake", "json": "json", "xml": "xml",
         "bibtex": "text", "text": "text"}
BEGINNINGS = (("#include", "cpp"), ("find_package", "cmake"), ("import ", "python"), ("from ", "python"))
ROOT = pathlib.Path(__file__).resolve().parents[2]


@dataclasses.dataclass
class Block:
    page: str
    line: int  # of its first line, from 1
    kind: str  # a value of KINDS; "?" where the fence says nothing that is known
    text: str


def pages():
    docs = sorted(p for p in (ROOT / "docs").rglob("*.md"))
    return sorted(ROOT.glob("*.md")) + docs


def indented_kind(text):
    return next((kind for start, kind in BEGINNINGS if text.startswith(start)), "shell")


def blocks_of(page, text):
    """The blocks of one page, in order."""
    lines, found, i = text.split("\n"), [], 0
    while i < len(lines):
        fence = re.match(r"```(\w*)", lines[i])
        if fence:
            end = next((j for j in range(i + 1, len(lines)) if lines[j].startswith("```")), len(lines))
            found.append(Block(page, i + 2, KINDS.get(fence[1], "?"), "\n".join(lines[i + 1:end])))
            i = end + 1
        elif lines[i].startswith("    ") and not lines[i - 1].strip() and not in_a_list(lines, i):
            end = i
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            text = "\n".join(line[4:] for line in lines[i:end]).rstrip()
            found.append(Block(page, i + 1, indented_kind(text), text))
            i = end
        else:
            i += 1
    return found


def in_a_list(lines, i):
    """Whether an indented line goes on with an item of a list."""
    before = next((line for line in reversed(lines[:i]) if line and not line.startswith(" ")), "")
    return bool(re.match(r"([*-]|\d+\.) ", before))


def all_blocks():
    return [block for page in pages()
            for block in blocks_of(str(page.relative_to(ROOT)), page.read_text(encoding="utf-8"))]


def commands_of(block):
    """(line, command) of a block of the shell; a command goes on over lines that end with a backslash or stand deeper."""
    found = []
    for i, text in enumerate(block.text.split("\n")):
        if found and (found[-1][1].endswith("\\") or (text.startswith(" ") and text.strip())):
            found[-1][1] = found[-1][1].removesuffix("\\") + text
        elif text.strip() and not text.startswith("#"):
            found.append([block.line + i, text])
    return found
