# SPDX-License-Identifier: GPL-3.0-or-later
"""What a command takes of memory, as the system counts it (ru_maxrss, mapped pages included), against --memory.

Each question is asked without a budget, then with several. Within a budget it gives the same bytes and takes at most the
budget and 64 MiB; or it refuses with exit code 1 and a sentence, and takes no more either.

    ARETE=... ARETE_DATASETS=... python3 memory_test.py

ARETE_FULL=1 asks of 16.8 million samples instead of 590 000.
"""

import hashlib
import json
import os
import shutil
import subprocess
import tempfile
import unittest

ARETE, DATASETS = os.environ["ARETE"], os.environ["ARETE_DATASETS"]
FULL = "ARETE_FULL" in os.environ
SIZE = 4096 if FULL else 768
MIB = 1 << 20
SLACK = 64 * MIB
BUDGETS = [8, 24, 64, 160, 400] + ([1200] if FULL else [])


def digest_of(name):
    """Of a file; nothing if it is not there. The peak of a child begins with that of this process, so files are not read whole."""
    path = os.path.join(folder, name) if name else ""
    if not os.path.isfile(path):
        return None
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def are_same_lines(a, b):
    """Whether tables of lines of sight are the same but for how much of the model their methods have visited, and for the last
    of twelve digits, in which two methods may place an obstruction differently."""
    rows = [[line.split(b",") for line in table.split(b"\n")] for table in (a, b)]
    visited = rows[0][0].index(b"visited")

    def is_same(x, y):
        try:
            return x == y or abs(float(x) - float(y)) <= 2e-11 * abs(float(x))
        except ValueError:
            return False

    return len(rows[0]) == len(rows[1]) and all(
        len(x) == len(y) and all(c == visited or is_same(x[c], y[c]) for c in range(len(x))) for x, y in zip(*rows))


class Ran:
    """A run: its exit code, what it wrote to stdout and stderr, and its peak of resident memory in bytes."""

    def __init__(self, words, folder):
        with open(os.path.join(folder, "out"), "w+b") as out, open(os.path.join(folder, "err"), "w+b") as err:
            process = subprocess.Popen([ARETE, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=err)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            self.code, self.peak = process.returncode, usage.ru_maxrss * 1024
            out.seek(0)
            err.seek(0)
            self.out, self.err = out.read(), err.read().decode(errors="replace")


def setUpModule():
    global folder
    folder = tempfile.mkdtemp(prefix="arete-memory-")
    unittest.addModuleCleanup(shutil.rmtree, folder, ignore_errors=True)
    make_models()
    make_questions()


def make_models():
    subprocess.run([DATASETS, "generate", "-o", "dem.tif", "--size", str(SIZE), "-q"], cwd=folder, check=True)
    subprocess.run([ARETE, "build", "dem.tif", "-o", "paged.amt", "--paged", "-q"], cwd=folder, check=True)
    for other in ("plain", "packed"):
        words = ["convert", "paged.amt", "-o", f"{other}.amt", "-q"] + (["--packed"] if other == "packed" else [])
        subprocess.run([ARETE, *words], cwd=folder, check=True)


def make_questions():
    global box, places
    facts = json.loads(subprocess.run([ARETE, "info", "paged.amt", "--json"], cwd=folder, check=True, capture_output=True).stdout)
    g, grid = facts["grid"]["geoTransform"], facts["grid"]

    def at(u, v):
        return g[0] + g[1] * grid["columns"] * u, g[3] + g[5] * grid["rows"] * v

    box = at
    with open(os.path.join(folder, "points.csv"), "w") as file:
        file.write("x,y\n")
        for i in range(20_000):  # a sequence without a pattern that batches could follow
            x, y = at((i * 0.7548776662) % 1, (i * 0.5698402910) % 1)
            file.write(f"{x:.3f},{y:.3f}\n")
        file.write("0,0\n")
    for name, lines in (("few", 9), ("many", 1500)):
        with open(os.path.join(folder, f"{name}.csv"), "w") as file:
            file.write("x1,y1,h1,x2,y2,h2\n")
            for i in range(lines):
                u, v, p, q = ((i * step) % 1 for step in (0.7548776662, 0.5698402910, 0.3247179572, 0.8191725134))
                # A few cross the terrain; many are short, as those of a network of masts.
                a, b = at(u, v), at(p, q) if name == "few" else at(u + (p - u) / 16, v + (q - v) / 16)
                file.write(f"{a[0]:.3f},{a[1]:.3f},20,{b[0]:.3f},{b[1]:.3f},10\n")
    x, y = at(0.5, 0.5)
    places = {"middle": f"{x},{y}", "line": "{},{},20:{},{},10".format(*at(0.2, 0.3), *at(0.7, 0.8))}


def question(name):
    """The words of a question to a model, and the file that it writes, if any."""
    middle, line = places["middle"], places["line"]
    first, second = line.split(":")
    near = ",".join(str(c) for c in (*box(0.45, 0.55), *box(0.55, 0.45)))
    return {
        "info": (["info"], None),
        "height": (["height", "--at", middle], None),
        "heights": (["height", "--points", "points.csv"], None),
        "los": (["los", "--from", first, "--to", second], None),
        "few lines": (["los", "--pairs", "few.csv"], None),
        "many lines": (["los", "--pairs", "many.csv"], None),
        "profile": (["profile", "--along", line], None),
        "viewshed": (["viewshed", "--observer", middle + ",20", "--radius", "2000", "-o", "seen.tif"], "seen.tif"),
        "coarse": (["extract", "--max-error", "100", "-o", "a.ply"], "a.ply"),
        "budget": (["extract", "--max-triangles", "5000", "-o", "a.ply"], "a.ply"),
        "region": (["extract", "--max-error", "1", "--region", near, "-o", "a.ply"], "a.ply"),
        "exact region": (["extract", "--max-error", "0", "--region", near, "-o", "a.ply"], "a.ply"),
        "whole": (["extract", "--max-error", "0", "-o", "a.ply"], "a.ply"),
    }[name]


class Memory(unittest.TestCase):
    def ask(self, words, budget=None, written=None):
        if written and os.path.exists(os.path.join(folder, written)):
            os.remove(os.path.join(folder, written))
        ran = Ran(words + (["--memory", f"{budget}M"] if budget else []), folder)
        ran.file = digest_of(written)
        return ran

    def held(self, words, budget, written=None):
        """Asks within a budget that is held; @return the run."""
        ran = self.ask(words, budget, written)
        self.assertIn(ran.code, (0, 1), ran.err)
        self.assertLessEqual(ran.peak, budget * MIB + SLACK, f"{ran.peak / MIB:.0f} MiB, exit code {ran.code}: {ran.err}")
        if os.environ.get("ARETE_SHOW"):
            print(f"{words[0]:9} {budget:5} MiB: peak {ran.peak / MIB:7.1f} MiB, code {ran.code} {ran.err.strip()[:150]}", flush=True)
        if ran.code != 0:
            self.assertIn("--memory", ran.err)
            self.assertIsNone(ran.file, "no file is left where a command refuses")
        return ran

    def holds(self, name, model="paged.amt", least=None):
        """Every budget is held with the same answer, from `least` MiB on without a refusal."""
        words, written = question(name)
        words = [words[0], model, *words[1:]]
        wanted = self.ask(words, None, written)
        self.assertEqual(wanted.code, 0, wanted.err)
        if os.environ.get("ARETE_SHOW"):
            print(f"{name}, {model}, without a budget: peak {wanted.peak / MIB:.1f} MiB", flush=True)
        for budget in BUDGETS:
            with self.subTest(question=name, model=model, budget=budget):
                ran = self.held(words, budget, written)
                if ran.code == 0:
                    # Many lines are answered by descents within a budget, else by a walk over all samples.
                    if name == "many lines":
                        self.assertTrue(are_same_lines(wanted.out, ran.out))
                    else:
                        self.assertEqual(ran.out, wanted.out)
                    self.assertEqual(ran.file, wanted.file)
                else:
                    self.assertTrue(least is None or budget < least, ran.err)

    def test_info_of_pages_takes_next_to_nothing(self):
        self.holds("info", least=8)

    def test_a_height_and_many_heights_are_answered_in_small_budgets(self):
        self.holds("height", least=24)
        self.holds("heights", least=64 if FULL else 24)

    def test_lines_of_sight_are_answered_in_batches(self):
        self.holds("los", least=160 if FULL else 64)
        self.holds("few lines", least=160)
        self.holds("many lines", least=160)

    def test_a_profile_holds_its_budget(self):
        self.holds("profile", least=400 if FULL else 64)

    def test_a_viewshed_holds_its_budget(self):
        self.holds("viewshed", least=1200 if FULL else 160)

    def test_cuts_of_pages_hold_their_budgets(self):
        self.holds("coarse", least=160 if FULL else 24)
        self.holds("budget", least=160 if FULL else 64)
        self.holds("region", least=160 if FULL else 64)
        self.holds("exact region", least=400 if FULL else 64)
        self.holds("whole")

    def test_other_forms_are_refused_or_hold_their_budgets(self):
        for model in ("plain.amt", "packed.amt"):
            for name in ("height", "coarse", "whole"):
                self.holds(name, model)

    def test_work_on_the_whole_is_refused_or_holds_its_budget(self):
        small = 24
        for words, written in (
            (["build", "dem.tif", "-o", "b.amt"], "b.amt"),
            (["convert", "plain.amt", "-o", "b.amt", "--paged"], "b.amt"),
            (["validate", "plain.amt"], None),
            (["view", "paged.amt", "--headless", "--screenshot", "b.png"], "b.png"),
        ):
            with self.subTest(words=words):
                self.assertEqual(self.held(words, small, written).code, 1)
        for budget in BUDGETS:
            with self.subTest(budget=budget):
                self.held(["build", "dem.tif", "-o", "b.amt"], budget, "b.amt")
                self.held(["convert", "plain.amt", "-o", "b.amt", "--paged"], budget, "b.amt")
                self.held(["validate", "paged.amt"], budget)

    def test_the_laws_of_pages_are_checked_in_parts_that_fit(self):
        words = ["validate", "paged.amt", "--fronts", "1", "--json"]
        whole = json.loads(self.ask(words).out)
        self.assertNotIn("parts", whole)
        counts = []
        for budget in BUDGETS:
            with self.subTest(budget=budget):
                ran = self.held(words, budget)
                if ran.code != 0:
                    self.assertLess(budget, 400 if FULL else 64)
                    continue
                answer = json.loads(ran.out)
                self.assertEqual((answer["holds"], answer["laws"]), (True, whole["laws"]))
                if "parts" in answer:
                    counts.append(answer["parts"]["count"])
                    self.assertGreater(answer["parts"]["pages"], 100)
        self.assertGreater(len(counts), 0)
        self.assertEqual(counts, sorted(counts, reverse=True), "less memory, more parts")

    def test_meshes_are_refused_or_hold_their_budgets(self):
        words, _ = question("whole")
        mesh = Ran([words[0], "paged.amt", *words[1:-1], "mesh.ply"], folder)
        self.assertEqual(mesh.code, 0, mesh.err)
        for words, written in (
            (["mesh", "info", "mesh.ply"], None),
            (["mesh", "decimate", "mesh.ply", "-o", "b.ply", "--max-triangles", "10%"], "b.ply"),
            (["convert", "mesh.ply", "-o", "b.glb"], "b.glb"),
            (["measure", "mesh.ply", "dem.tif"], None),
            (["build", "mesh.ply", "-o", "b.amt"], "b.amt"),
        ):
            for budget in BUDGETS[:3]:
                with self.subTest(words=words, budget=budget):
                    self.held(words, budget, written)

    def test_a_refusal_says_what_is_needed_what_is_left_and_the_way_out(self):
        words, _ = question("whole")
        refused = self.held([words[0], "paged.amt", *words[1:], "--json"], 8, "a.ply")
        self.assertEqual(refused.code, 1)
        error = json.loads(refused.out)["error"]
        self.assertEqual(error["code"], "out of memory")
        self.assertRegex(error["message"], r"needs about [\d.]+ [MG]B of memory, and [\d.]+ MB of the 8\.4 MB of --memory are left: .*larger tolerance")

    def test_budgets_that_are_none_are_refused(self):
        for text in ("512", "0", "-1G", "2 G", "2X", "", "lots", "1e30"):
            with self.subTest(text=text):
                ran = Ran(["info", "paged.amt", f"--memory={text}"], folder)
                self.assertEqual(ran.code, 2, ran.err)
                self.assertIn("--memory", ran.err)
        for text in ("1MB", "1.5G", "2000000", "64MiB", "3TB", "16M"):
            with self.subTest(text=text):
                self.assertEqual(Ran(["info", "paged.amt", "--memory", text], folder).code, 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
