# SPDX-License-Identifier: GPL-3.0-or-later
"""Every C++ block of the pages compiles against an installed Arete, and runs in a folder with the inputs of inputs.py.

A block with `main` is a program of its own. All others are fragments: one source file has a function for each, in which the
names that the fragment leaves to its reader are declared first (CONTEXT), below the headers that the pages name. Blocks of CMake
are the CMakeLists.txt of that project.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import blocks
import inputs

BUILD = pathlib.Path(os.environ["ARETE_BUILD"])
STANDARD = ("algorithm", "array", "chrono", "cstdint", "iostream", "span", "string", "variant", "vector")
MODEL = 'const auto model = arete::loadAmt("dem.amt"); if (!model) throw std::string("dem.amt");\n'
PLACE = "const double x = 409050, y = 3801450;\n"
CAMERA = "arete::Camera camera; camera.xy = {409050, 3801450}; camera.height = 2500; camera.pitchDegrees = -20;\n"
DRAW = "[[maybe_unused]] const auto draw = [](auto&&...) {};\n"

# (what a fragment contains, what is declared before it), in this order.
CONTEXT = (
    (r"\bmodel\b(?![\s\S]*auto model =)(?!\s*=)", MODEL),
    (r"\bheights\.at\b", PLACE),
    (r"\bcamera\b", CAMERA),
    (r"\bcut\.update\b", "arete::IncrementalCut cut(model->mt);\n"),
    (r"\bdraw\(", DRAW),
    (r"\bupload\(", CAMERA + "const auto view = *arete::viewOf(camera, *model);\n" + "".join(
        f"const auto {name} = [](auto&&...) {{}};\n" for name in ("upload", "uploadTriangles", "uploadHeight"))),
)


def context(text):
    found = ""
    for pattern, declared in CONTEXT:
        if re.search(pattern, text) and not (declared == MODEL and re.search(r"auto model =", text)):
            found += declared
    return found


def sources(folder):
    """Writes the project; returns the names of its programs."""
    found = [b for b in blocks.all_blocks() if b.kind == "cpp"]
    programs = [b for b in found if re.search(r"\bint main\(", b.text)]
    fragments = [b for b in found if b not in programs]
    headers = sorted({h for page in {b.page for b in fragments}
                      for h in re.findall(r"`(arete/[\w./]+\.h)`", (blocks.ROOT / page).read_text(encoding="utf-8"))} | {"arete/arete.h"})
    text = "".join(f"#include <{h}>\n" for h in (*headers, *STANDARD))
    for i, block in enumerate(fragments):
        text += f'\nvoid fragment{i}() {{\n{context(block.text)}#line {block.line} "{block.page}"\n{block.text}\n}}\n'
    calls = "".join(f'  std::cerr << "{b.page}:{b.line}\\n"; fragment{i}();\n' for i, b in enumerate(fragments))
    (folder / "fragments.cpp").write_text(text + f"\nint main() {{\n{calls}}}\n")
    names = ["fragments"]
    for block in programs:
        names.append("program" + re.sub(r"\W", "_", f"{block.page}_{block.line}"))
        (folder / f"{names[-1]}.cpp").write_text(f'#line {block.line} "{block.page}"\n{block.text}\n')
    cmake = "cmake_minimum_required(VERSION 3.22)\nproject(pages LANGUAGES CXX)\n"
    stated = [b.text for b in blocks.all_blocks() if b.kind == "cmake"]
    for name in names:
        cmake += f"add_executable({name} {name}.cpp)\n"
        cmake += "".join(re.sub(r"\byours\b", name, text) + "\n" for text in stated)
    (folder / "CMakeLists.txt").write_text(cmake)
    print(f"{len(fragments)} fragments, {len(programs)} programs, {len(stated)} blocks of CMake")
    return names


def main():
    with tempfile.TemporaryDirectory(prefix="arete-pages-") as name:
        folder = pathlib.Path(name)

        def run(*command):
            result = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=500)
            if result.returncode:
                print(*command, "\n", result.stdout[-3000:], result.stderr[-6000:])
                sys.exit(1)

        cmake = os.environ["ARETE_CMAKE"]
        run(cmake, "--install", str(BUILD), "--prefix", str(folder / "prefix"))
        names = sources(folder)
        run(cmake, "-S", ".", "-B", "build", "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={os.environ['ARETE_CXX']}", "-DCMAKE_BUILD_TYPE=Debug",
            f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}")
        run(cmake, "--build", "build", "--parallel", str(os.cpu_count()))
        inputs.make(folder, str(BUILD / "arete"))
        (folder / "alps.amt").write_bytes((folder / "dem.amt").read_bytes())
        for program in names:
            run(f"build/{program}")
    print("all of them compile and run")


main()
