# SPDX-License-Identifier: GPL-3.0-or-later
"""Models in pages are read in part: each question has the answer of the whole, and fetches what it needs."""

import contextlib
import http.server
import os
import re
import shutil
import signal
import tempfile
import threading
import time
import unittest

import numpy as np

import arete
from arrays_test import Affine

PLACE = Affine(30, 0, 500000, 0, -30, 4000000)


def mountains(rows=520, columns=640):
    """Waves of many lengths, with a void."""
    y, x = np.mgrid[0:rows, 0:columns]
    heights = 0.1 * x + 0.07 * y
    for k in range(7):
        a, b, c, d = np.random.default_rng(k).uniform(0.7, 1.4, 4)
        heights += 150 / 2**k * np.sin(2**k * (a * x + 0.3 * y) / 80 + c) * np.cos(2**k * (b * y - 0.2 * x) / 90 + d)
    heights[100:140, 200:260] = np.nan
    return heights


def bumpy_ball(rings=180):
    """A closed mesh with bumps: vertices and triangles."""
    around = 2 * rings
    u, v = np.meshgrid(np.arange(around) / around * 2 * np.pi, np.arange(1, rings) / rings * np.pi)
    r = 10 + 0.4 * np.sin(7 * u) * np.sin(5 * v) + 0.05 * np.sin(31 * u) * np.sin(23 * v)
    inner = np.column_stack([(r * np.sin(v) * np.cos(u)).ravel(), (r * np.sin(v) * np.sin(u)).ravel(), (r * np.cos(v)).ravel()])
    vertices = np.vstack([inner, [[0, 0, 10], [0, 0, -10]]])
    triangles = []
    for i in range(rings - 1):
        for j in range(around):
            a, b = i * around + j, i * around + (j + 1) % around
            if i == 0:
                triangles.append((len(inner), a, b))
            if i == rings - 2:
                triangles.append((len(inner) + 1, b, a))
            else:
                triangles += [(a, a + around, b), (b, a + around, b + around)]
    return vertices, np.array(triangles)


class Server(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    lock = threading.Lock()
    files = {}
    requests, sent = 0, 0
    tag = '"one"'
    is_down = False
    seconds = 0.0

    def do_GET(self):
        time.sleep(Server.seconds)
        whole = Server.files.get(self.path)
        span = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
        if whole is None or not span or Server.is_down:
            self.send_response(503 if Server.is_down else 404)
            self.send_header("Content-Length", "0")
            self.end_headers()
            return
        first, last = int(span[1]), min(int(span[2]), len(whole) - 1)
        with Server.lock:
            Server.requests += 1
            Server.sent += last + 1 - first
        self.send_response(206)
        self.send_header("Content-Range", f"bytes {first}-{last}/{len(whole)}")
        self.send_header("Content-Length", str(last + 1 - first))
        self.send_header("ETag", Server.tag)
        self.end_headers()
        # A question that was stopped no longer waits for it.
        with contextlib.suppress(ConnectionError):
            self.wfile.write(whole[first : last + 1])

    def log_message(self, *_):
        pass


class Stopped(Exception):
    pass


def settings_of_tests(case):
    for name, value in (("GDAL_HTTP_MAX_RETRY", "1"), ("GDAL_HTTP_RETRY_DELAY", "0.01")):
        os.environ[name] = value
        case.addClassCleanup(os.environ.pop, name)


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        settings_of_tests(cls)
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        built = arete.build(mountains(), transform=PLACE, crs=32611)
        cls.country = cls.path("country.amt")
        built.save(cls.country, paged=True)
        # The same numbers of vertices and triangles: of the file, and read whole.
        cls.whole = arete.open(cls.country)
        cls.whole.measure(cls.whole.cut(max_error=100))
        cls.ball = cls.path("ball.amt")
        arete.build_surface(*bumpy_ball()).save(cls.ball, paged=True)
        cls.whole_ball = arete.open(cls.ball)
        cls.whole_ball.measure(cls.whole_ball.cut(max_error=1), samples=100)
        for name in ("country.amt", "ball.amt"):
            with open(cls.path(name), "rb") as file:
                Server.files["/" + name] = file.read()
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Server)
        cls.addClassCleanup(server.server_close)
        cls.addClassCleanup(server.shutdown)
        cls.port = server.server_port
        threading.Thread(target=server.serve_forever, daemon=True).start()

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder, name)

    @classmethod
    def address(cls, name):
        return f"http://127.0.0.1:{cls.port}/{name}"

    def setUp(self):
        Server.tag, Server.is_down, Server.seconds = '"one"', False, 0.0

    def fetched(self, question):
        """The answer to a question, and the requests and bytes that it took."""
        requests, sent = Server.requests, Server.sent
        answer = question()
        return answer, Server.requests - requests, Server.sent - sent

    def expect_same(self, part, whole):
        self.assertTrue(np.array_equal(part.vertices, whole.vertices))
        self.assertTrue(np.array_equal(part.triangles, whole.triangles))
        self.assertTrue(np.array_equal(part.errors, whole.errors))
        self.assertTrue(np.array_equal(part.source_vertices, whole.source_vertices))
        self.assertEqual((part.error, part.is_complete, part.pixels), (whole.error, whole.is_complete, whole.pixels))
        self.assertEqual(part._tin.file_parts, whole._tin.file_parts)

    def test_what_a_model_says_of_itself_takes_the_beginning_of_the_file(self):
        for name, whole in (("country.amt", self.whole), ("ball.amt", self.whole_ball)):
            model, requests, sent = self.fetched(lambda name=name: arete.open(self.address(name)))
            self.assertLessEqual(requests, 3, name)
            self.assertLess(sent, len(Server.files["/" + name]) / 5, name)
            facts, requests, _ = self.fetched(model.info)
            self.assertEqual(requests, 0)
            self.assertEqual(facts, whole.info())
            for attribute in ("crs", "largest_error", "finest_triangles"):
                self.assertEqual(getattr(model, attribute), getattr(whole, attribute))
            self.assertEqual(repr(model), repr(whole))
        model = arete.open(self.address("country.amt"))
        for attribute in ("vertical_unit", "transform", "shape", "bounds"):
            self.assertEqual(getattr(model, attribute), getattr(self.whole, attribute))
        (mine, requests, _), its = self.fetched(model.curve), self.whole.curve()
        self.assertEqual(requests, 0)
        for column in ("max_error", "minimal", "saturated"):
            self.assertTrue(np.array_equal(getattr(mine, column), getattr(its, column)))
        ball = arete.open(self.address("ball.amt"))
        self.assertEqual((ball.diagonal, ball.position_error, ball.is_displaced),
                         (self.whole_ball.diagonal, self.whole_ball.position_error, self.whole_ball.is_displaced))

    def test_a_cut_of_terrain_fetches_its_part_and_is_that_of_the_whole(self):
        camera = arete.Camera((505000, 3990000, 40), azimuth=60, pitch=-20, fov=40)
        size = len(Server.files["/country.amt"])
        for options, share in (({"max_error": 20}, 0.4), ({"max_error": "5%"}, 0.4), ({"max_triangles": 1000}, 0.4),
                               ({"max_error": 0, "region": (503000, 3994000, 504000, 3995000)}, 0.4),
                               ({"max_error": 1, "focus": (503000, 3994000), "error_growth": 0.02}, 0.4),
                               ({"camera": camera, "pixel_error": 4}, 0.8),
                               ({"camera": camera, "max_triangles": 800}, 0.8),
                               ({"max_error": 20, "max_triangles": 800}, 0.6), ({"max_error": 20, "method": "saturated"}, 0.4),
                               ({"max_error": 1, "where": lambda *box: None if box[2] - box[0] > 2000 else box[0] < 502000}, 0.6)):
            with self.subTest(options):
                model = arete.open(self.address("country.amt"))
                tin, requests, sent = self.fetched(lambda model=model, options=options: model.cut(**options))
                self.assertLess(sent, share * size)
                self.assertLess(requests, 40)
                self.expect_same(tin, self.whole.cut(**options))
                again, requests, _ = self.fetched(lambda model=model, options=options: model.cut(**options))
                self.assertEqual(requests, 0)
                self.expect_same(again, tin)

    def test_a_cut_of_a_surface_fetches_its_part_and_is_that_of_the_whole(self):
        camera = arete.SurfaceCamera((14, 0, 0), (10, 0, 0), fov=20)
        size = len(Server.files["/ball.amt"])
        for options, share in (({"max_error": 0.1}, 0.4), ({"max_error": "1%"}, 0.4), ({"max_triangles": 800}, 0.6),
                               ({"max_error": 0, "region": (10, 0, 0, 1)}, 0.6),
                               ({"max_error": 0.01, "focus": (10, 0, 0), "error_growth": 0.1}, 0.6),
                               ({"camera": camera, "pixel_error": 8}, 0.9), ({"max_error": 0.1, "method": "saturated"}, 0.4)):
            with self.subTest(options):
                model = arete.open(self.address("ball.amt"))
                tin, _, sent = self.fetched(lambda model=model, options=options: model.cut(**options))
                self.assertLess(sent, share * size)
                self.expect_same(tin, self.whole_ball.cut(**options))

    def test_heights_profiles_and_sight_fetch_the_ground_that_they_touch(self):
        size = len(Server.files["/country.amt"])
        random = np.random.default_rng(3)
        x, y = random.uniform(504000, 505000, 50), random.uniform(3994000, 3995000, 50)
        line = [(503000, 3994000), (504500, 3993000), (504700, 3992000)]
        ends = (504000, 3994000, 10), (505500, 3993000, 3)
        for name, ask in (("height", lambda model: model.height(x, y)), ("coarse height", lambda model: model.height(x, y, 5)),
                          ("one height", lambda model: model.height(504321, 3994321)),
                          ("profile", lambda model: model.profile(line).height),
                          ("line of sight", lambda model: [str(model.los(*ends))]),
                          ("clear zone", lambda model: [str(model.los(*ends, frequency=2400).fresnel)]),
                          ("line in a profile", lambda model: model.profile(ends).line_height),
                          ("viewshed", lambda model: model.viewshed(ends[0], radius=1500)),
                          ("viewshed of two", lambda model: model.viewshed(ends, radius=800, mode="count"))):
            with self.subTest(name):
                model = arete.open(self.address("country.amt"))
                answer, _, sent = self.fetched(lambda model=model, ask=ask: ask(model))
                self.assertLess(sent, 0.6 * size)
                self.assertTrue(np.array_equal(answer, ask(self.whole)))
                _, requests, _ = self.fetched(lambda model=model, ask=ask: ask(model))
                self.assertEqual(requests, 0)

    def test_places_without_terrain_have_no_height_and_cost_little(self):
        model = arete.open(self.address("country.amt"))
        void, outside = (500000 + 230 * 30, 4000000 - 120 * 30), (400000, 3000000)
        heights, _, sent = self.fetched(lambda: model.height(*np.transpose([void, outside])))
        self.assertTrue(np.isnan(heights).all())
        self.assertLess(sent, 0.4 * len(Server.files["/country.amt"]))
        # A rim of the void, and beyond the rim of the DEM.
        x, y = 500000 + np.arange(190, 270, 0.5) * 30, np.full(160, 4000000 - 100.5 * 30)
        self.assertTrue(np.array_equal(model.height(x, y), self.whole.height(x, y), equal_nan=True))
        with self.assertRaisesRegex(ValueError, "target"):
            model.los((504000, 3994000, 10), (*outside, 3))
        with self.assertRaisesRegex(ValueError, "observer"):
            model.viewshed((*outside, 3), radius=500)

    def test_what_needs_the_whole_fetches_it_once(self):
        for name, whole in (("country.amt", self.whole), ("ball.amt", self.whole_ball)):
            with self.subTest(name):
                model = arete.open(self.address(name))
                tin = whole.cut(max_triangles=2000)
                found, _, sent = self.fetched(lambda model=model, tin=tin: model.measure(tin))
                self.assertGreater(sent, len(Server.files["/" + name]) / 2)
                self.assertEqual(found, whole.measure(tin))
                copy = self.path("copy-of-" + name)

                def more(model=model, copy=copy):
                    self.assertEqual(len(model.curve(at=[1.0]).minimal), 1)
                    model.save(copy, paged=True)
                    return model.cut(max_error=0)

                finest, requests, _ = self.fetched(more)
                self.assertEqual(requests, 0)
                self.expect_same(finest, whole.cut(max_error=0))
                self.assertEqual(arete.open(copy).info(), model.info())

    def test_fits_certificates_and_samples_are_those_of_the_whole(self):
        model = arete.open(self.address("country.amt"))
        self.expect_same(model.cut(max_error=20, fit="triangles"), self.whole.cut(max_error=20, fit="triangles"))
        model = arete.open(self.address("country.amt"))
        for name, one in (("part.ply", model), ("whole.ply", self.whole)):
            one.cut(max_error=30).save(self.path(name), certificate=True)
        files = []
        for name in ("part.ply", "whole.ply"):
            with open(self.path(name), "rb") as file:
                files.append(file.read())
        self.assertEqual(*files)
        for name in ("part.stl", "whole.stl"):  # heights are rounded: the cut is taken again
            (arete.open(self.country) if name == "part.stl" else self.whole).cut(max_error=2).save(self.path(name), certificate=True)
            with open(self.path(name), "rb") as file:
                files.append(file.read()[84:])
        self.assertEqual(*files[2:])
        self.assertTrue(np.array_equal(arete.open(self.country)._terrain.samples(), self.whole._terrain.samples(), equal_nan=True))

    def test_threads_ask_at_once_and_get_their_own_answers(self):
        for path in (self.country, self.address("country.amt")):
            model, wrong = arete.open(path), []

            def ask(seed, model=model, wrong=wrong):
                random = np.random.default_rng(seed)
                for _ in range(6):
                    x, y = random.uniform(500000, 519000, 9), random.uniform(3985000, 4000000, 9)
                    mine, its = model.height(x, y), self.whole.height(x, y)
                    if not np.array_equal(mine, its, equal_nan=True):
                        wrong.append((x, y))
                    error = float(random.integers(10, 40))
                    if not np.array_equal(model.cut(max_error=error).vertices, self.whole.cut(max_error=error).vertices):
                        wrong.append(error)
                if seed % 3 == 0 and model.measure(self.whole.cut(max_error=30))["covered"] == 0:
                    wrong.append("measure")

            threads = [threading.Thread(target=ask, args=(seed,)) for seed in range(6)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(wrong, [])

    def test_many_questions_to_a_file_of_this_machine_keep_their_answers(self):
        model = arete.open(self.country)
        random = np.random.default_rng(5)
        for _ in range(150):
            place = random.uniform(500000, 519000), random.uniform(3985000, 4000000)
            self.assertTrue(np.array_equal(model.height(*place), self.whole.height(*place), equal_nan=True))

    def test_a_question_that_is_stopped_ends_neither_the_next_nor_those_of_other_threads(self):
        model, others = arete.open(self.address("country.amt")), []
        whole = self.whole.height(*np.transpose([(518000, 3986000)] * 2))

        def ask():
            try:
                others.append(np.array_equal(model.height(*np.transpose([(518000, 3986000)] * 2)), whole))
            except BaseException as error:  # noqa: BLE001
                others.append(error)

        def stop(*_):
            raise Stopped

        Server.seconds = 0.5
        before = signal.signal(signal.SIGALRM, stop)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.7)
            thread = threading.Thread(target=ask)
            with self.assertRaises(Stopped):
                thread.start()
                for place in range(20):
                    model.height(500000 + 900 * place, 3999000 - 500 * place)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        Server.seconds = 0.0
        thread.join()
        self.assertEqual(others, [True])
        self.assertEqual(model.height(510000, 3990000), self.whole.height(510000, 3990000))
        self.expect_same(model.cut(max_error=10), self.whole.cut(max_error=10))

    def test_a_server_that_does_not_answer_is_an_error_of_its_question_alone(self):
        for name, whole in (("country.amt", self.whole), ("ball.amt", self.whole_ball)):
            model = arete.open(self.address(name))
            Server.is_down = True
            for _ in range(2):
                with self.assertRaises(OSError) as raised:
                    model.cut(max_error=0)
                self.assertIn(self.address(name), str(raised.exception))
            Server.is_down = False
            self.expect_same(model.cut(max_error=0), whole.cut(max_error=0))

    def test_a_file_that_a_server_replaces_is_an_error(self):
        for name in ("country.amt", "ball.amt"):
            model = arete.open(self.address(name))
            kept = Server.files["/" + name]
            other = "ball.amt" if name == "country.amt" else "country.amt"
            try:
                Server.tag, Server.files["/" + name] = '"two"', Server.files["/" + other]
                for _ in range(3):  # found while it is read, then when it is opened again
                    with self.assertRaisesRegex(OSError, "replaced") as raised:
                        model.cut(max_error=0)
                    self.assertIn(self.address(name), str(raised.exception))
            finally:
                Server.tag, Server.files["/" + name] = '"one"', kept
            self.assertGreater(len(model.cut(max_error=0).triangles), 1000)

    def test_a_file_that_is_written_over_in_place_is_an_error_and_one_renamed_away_is_not(self):
        copy, other = self.path("changing.amt"), self.path("other.amt")
        shutil.copy(self.country, copy)
        arete.build(mountains(60, 80)).save(other, paged=True)
        model = arete.open(copy)
        with open(other, "rb") as source, open(copy, "r+b") as target:
            target.write(source.read())
        with self.assertRaisesRegex(OSError, "changed"):
            model.height(518000, 3986000)
        with self.assertRaises((OSError, RuntimeError)) as raised:
            model.height(518000, 3986000)
        self.assertIn(copy, str(raised.exception))
        shutil.copy(self.country, copy + "2")
        model = arete.open(copy + "2")
        os.replace(other, copy + "2")
        self.assertEqual(model.height(518000, 3986000), self.whole.height(518000, 3986000))

    def test_a_damaged_page_refuses_the_questions_that_need_it(self):
        damaged = self.path("damaged.amt")
        shutil.copy(self.country, damaged)
        with open(damaged, "r+b") as file:
            place = os.path.getsize(damaged) * 2 // 3
            file.seek(place)
            byte = file.read(1)[0]
            file.seek(place)
            file.write(bytes([byte ^ 0x55]))
        model, refused, answered = arete.open(damaged), 0, 0
        self.assertEqual(model.info(), self.whole.info())
        self.expect_same(model.cut(max_error=20), self.whole.cut(max_error=20))
        for x in range(500500, 519000, 1500):
            for y in range(3985000, 4000000, 1500):
                try:
                    height = model.height(x, y)
                except RuntimeError as error:
                    self.assertIn(damaged, str(error))
                    refused += 1
                else:
                    self.assertTrue(np.array_equal(height, self.whole.height(x, y), equal_nan=True))
                    answered += 1
        self.assertGreater(refused, 0)
        self.assertGreater(answered, refused)
        with self.assertRaisesRegex(RuntimeError, "damaged.amt"):
            model.measure(self.whole.cut(max_error=50))

    def test_scattered_points_in_pages_answer_as_the_whole(self):
        random = np.random.default_rng(11)
        xy = random.uniform(0, 1000, (30000, 2))
        points = np.column_stack([xy, 30 * np.sin(xy[:, 0] / 60) * np.cos(xy[:, 1] / 90)])
        path = self.path("points.amt")
        arete.build_points(points).save(path, paged=True)
        whole, model = arete.open(path), arete.open(path)
        whole.measure(whole.cut(max_error=20))
        self.assertEqual(model.info(), whole.info())
        self.assertEqual(model.bounds, whole.bounds)
        self.expect_same(model.cut(max_error=5), whole.cut(max_error=5))
        x, y = random.uniform(-50, 1050, (2, 500))
        self.assertTrue(np.array_equal(model.height(x, y), whole.height(x, y), equal_nan=True))

    def test_files_that_are_not_in_pages_are_read_whole_as_ever(self):
        for packed in (False, True):
            path = self.path(f"whole-{packed}.amt")
            self.whole.save(path, packed=packed)
            model = arete.open(path)
            os.remove(path)
            self.assertEqual(model.height(510000, 3990000), self.whole.height(510000, 3990000))


if __name__ == "__main__":
    unittest.main()
