# SPDX-License-Identifier: GPL-3.0-or-later
"""A DEM and a model on a server, and GDAL's own files of the network beside ours in the process."""

import ctypes
import http.server
import os
import re
import tempfile
import threading
import unittest

import numpy

import arete

GRID = b"ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 10\n" + b"1 2 3 4\n5 9 7 8\n1 0 1 2\n"


class Server(http.server.BaseHTTPRequestHandler):
    asked = []
    sends_half = False
    files = {"/dem.asc": GRID}

    def answer(self, method):
        Server.asked.append((method, self.path))
        if self.path not in Server.files:
            self.send_response(404)
            self.send_header("Content-Length", "0")
            self.end_headers()
            return
        whole = Server.files[self.path]
        body = whole
        span = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
        if span:
            first, last = int(span[1]), min(int(span[2]), len(whole) - 1)
            body = whole[first : last + 1]
            self.send_response(206)
            self.send_header("Content-Range", f"bytes {first}-{last}/{len(whole)}")
        else:
            self.send_response(200)
        if Server.sends_half:
            body = body[: len(body) // 2]
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        if method == "GET":
            self.wfile.write(body)

    def do_GET(self):
        self.answer("GET")

    def do_HEAD(self):
        self.answer("HEAD")

    def log_message(self, *_):
        pass


class Addresses(unittest.TestCase):
    def setUp(self):
        os.environ["GDAL_HTTP_RETRY_DELAY"] = "0.01"
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Server)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.address = f"http://127.0.0.1:{self.server.server_port}/dem.asc"
        Server.asked.clear()
        Server.sends_half = False

    def tearDown(self):
        self.server.shutdown()
        self.server.server_close()
        del os.environ["GDAL_HTTP_RETRY_DELAY"]

    def test_a_dem_is_read_by_checked_requests(self):
        for path in (self.address, "/vsicurl/" + self.address):
            self.assertEqual(arete.build(path).shape, (3, 4))
        self.assertNotIn("HEAD", [method for method, _ in Server.asked])

    def test_a_server_that_sends_half_is_an_error_with_the_address(self):
        Server.sends_half = True
        with self.assertRaises(OSError) as raised:
            arete.build(self.address)
        self.assertIn(self.address, str(raised.exception))
        self.assertNotIn("vsiarete", str(raised.exception))

    def test_a_model_is_opened_by_its_address(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "m.amt")
            x, y = numpy.meshgrid(numpy.arange(60.0), numpy.arange(50.0))
            arete.build(numpy.sin(x / 5) * numpy.cos(y / 7) * 40).save(path)
            with open(path, "rb") as file:
                Server.files["/m.amt"] = file.read()
            local = arete.open(path)
        address = f"http://127.0.0.1:{self.server.server_port}/m.amt"
        for name in (address, "/vsicurl/" + address):
            model = arete.open(name)
            self.assertEqual(model.shape, local.shape)
            for error in (0, 1, 10):
                mine, its = model.cut(max_error=error), local.cut(max_error=error)
                numpy.testing.assert_array_equal(mine.triangles, its.triangles)
                numpy.testing.assert_array_equal(mine.vertices, its.vertices)
        with self.assertRaises(FileNotFoundError):
            arete.open(address + "x")
        Server.sends_half = True
        with self.assertRaises(OSError) as raised:
            arete.open(address)
        self.assertIn("127.0.0.1", str(raised.exception))

    def test_files_of_the_network_that_others_read_are_gdals_own(self):
        arete.build(self.address)
        gdal = ctypes.CDLL(arete_gdal())
        gdal.VSIFOpenL.restype = ctypes.c_void_p
        gdal.VSIFCloseL.argtypes = [ctypes.c_void_p]
        file = gdal.VSIFOpenL(f"/vsicurl/{self.address}".encode(), b"rb")
        self.assertTrue(file)
        gdal.VSIFCloseL(file)
        # GDAL's own handler asks for the length first; ours asks for a piece.
        self.assertIn(("HEAD", "/dem.asc"), Server.asked)


def arete_gdal():
    """The libgdal that the module has loaded."""
    with open("/proc/self/maps", encoding="utf-8") as maps:
        return next(line.split()[-1] for line in maps if "/libgdal.so" in line)


if __name__ == "__main__":
    unittest.main()
