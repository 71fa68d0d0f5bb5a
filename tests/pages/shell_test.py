# SPDX-License-Identifier: GPL-3.0-or-later
"""Every line of the shell that a page shows runs, every flight in JSON is flown and every scene is seen, in a folder of its page, and writes the file that it names.

Each page starts with the inputs of inputs.py. What is not run is counted with its reason (marks.py)."""
import collections
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import blocks
import inputs
import marks

BUILD = pathlib.Path(os.environ["ARETE_BUILD"])
OUTPUT = re.compile(r"(?:^|\s)(?:-o|--output|--screenshot|--png|--figures|--film|--certificate|--map|--error-raster|--error-mesh)\s+([\w./-]+\.\w+)")

# What is done with a block of JSON that has frames, a flight, and with one that has objects, a scene.
FLY = "arete view dem.amt --headless --path flight.json --frames frames --fps 1 --size 96x54"
SEE = "arete view scene.json --screenshot scene.png --size 192x108"
JSON_FILES = {'"frames"': ("flight.json", FLY), '"objects"': ("scene.json", SEE)}


def json_file(block):
    """The name of the file that a block of JSON is, and what is done with it; nothing for others."""
    return next((made for word, made in JSON_FILES.items() if block.kind == "json" and word in block.text), None)


def environment(scratch):
    """The variables of a run: our programs first on PATH, a home of its own, and no driver but ours."""
    tools = scratch / "bin"
    tools.mkdir()
    for name in ("arete", "arete-datasets"):
        (tools / name).symlink_to(BUILD / name)
    return dict(os.environ, PATH=f"{tools}:{os.environ['PATH']}", HOME=str(scratch / "home"), GDAL_DRIVER_PATH=str(BUILD / "gis"),
                PYTHONPATH=str(BUILD / "python"))


def missing_program(command):
    needed = [p for p in marks.PROGRAMS if re.search(rf"(?:^|[\s|]){re.escape(p)}(?:\s|$)", command)]
    needed += ["ffmpeg"] * ("--film" in command)
    needed += ["xvfb-run"] * ("--window-frames" in marks.as_run(command))
    return next((p for p in needed if shutil.which(p) is None), None)


def outputs_of(command):
    """The files that a command names as outputs, but for lists and patterns, of which each makes several."""
    several = re.search(r"--(max-error|max-triangles) \S*,", command)
    return [] if several else OUTPUT.findall(command.split("  #")[0])


def run_page(page, page_blocks, made, variables, scratch):
    folder = scratch / page.replace("/", "_")
    shutil.copytree(made, folder)
    (folder / "build").mkdir()
    (folder / "build" / "release").symlink_to(BUILD)
    run, left, failures = 0, [], []
    for block in page_blocks:
        commands = blocks.commands_of(block) if block.kind == "shell" else [(block.line, json_file(block)[1])]
        if block.kind == "json":
            (folder / json_file(block)[0]).write_text(block.text)
        for line, command in commands:
            reason = marks.reason_not_to_run(command)
            if not reason and (lacking := missing_program(command)):
                reason = f"needs {lacking}, which is not here"
            if reason:
                left.append((f"{page}:{line}", reason))
                continue
            whole = marks.as_run(command)
            if "--window-frames" in whole:
                whole = 'xvfb-run -a -s "-screen 0 1280x800x24" ' + whole
            try:
                result = subprocess.run(["bash", "-o", "pipefail", "-c", whole], cwd=folder, env=variables, stdin=subprocess.DEVNULL,
                                        capture_output=True, text=True, timeout=120)
                code, said = result.returncode, (result.stdout + result.stderr)[-1500:]
            except subprocess.TimeoutExpired:
                code, said = "none", "it ran for 120 seconds"
            run += 1
            lost = [] if code else [o for o in outputs_of(command) if not (folder / o).exists()]
            if code or lost:
                failures.append(f"{page}:{line}: {whole}\n    exit code {code}; not written: {lost}\n    {said}")
    return page, run, left, failures


def main():
    of_page = collections.defaultdict(list)
    for block in blocks.all_blocks():
        is_run = block.kind == "shell" or json_file(block) is not None
        if is_run and (len(sys.argv) < 2 or block.page in sys.argv[1:]):
            of_page[block.page].append(block)
    total, left_out, failed = 0, collections.Counter(), []
    with tempfile.TemporaryDirectory(prefix="arete-pages-") as name:
        scratch = pathlib.Path(name)
        (scratch / "home").mkdir()
        variables = environment(scratch)
        made = scratch / "inputs"
        made.mkdir()
        inputs.make(made, str(BUILD / "arete"))
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            tasks = [pool.submit(run_page, page, found, made, variables, scratch) for page, found in of_page.items()]
            for task in tasks:
                page, run, left, failures = task.result()
                total += run
                left_out.update(reason for _, reason in left)
                failed += failures
                print(f"{page}: {run} lines run, {len(left)} not run, {len(failures)} failed")
                print("".join(f"  {place}: {reason}\n" for place, reason in left), end="")
    print(f"\nall pages: {total} lines run, {sum(left_out.values())} not run:")
    for reason, count in left_out.most_common():
        print(f"  {count} x {reason}")
    print("\n".join(failed))
    sys.exit(1 if failed or not total else 0)


main()
