#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is fetched of a model on a server: requests and bytes of some questions, and whether the answers are the local ones.

    bench/web_requests.py ARETE MODEL.amt

Serves the folder of the model, a raster in the units of its heights, on this machine and asks in the middle of it: a height, a
line of sight of 20 000 units, 1 % of the area at three tolerances, and all of it coarsely. Prints a line for each question.
"""

import http.server
import json
import os
import re
import subprocess
import sys
import tempfile
import threading


class Files(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    folder = "."

    def do_GET(self):
        path = os.path.join(Files.folder, os.path.basename(self.path))
        span = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
        if not span or not os.path.isfile(path):
            self.send_error(404)
            return
        size = os.path.getsize(path)
        first, last = int(span[1]), min(int(span[2]), size - 1)
        self.send_response(206)
        self.send_header("Content-Range", f"bytes {first}-{last}/{size}")
        self.send_header("Content-Length", str(last - first + 1))
        self.send_header("ETag", f'"{os.stat(path).st_mtime_ns}"')
        self.end_headers()
        with open(path, "rb") as file:
            file.seek(first)
            self.wfile.write(file.read(last - first + 1))

    def log_message(self, *_):
        pass


def questions(facts):
    g, grid = facts["grid"]["geoTransform"], facts["grid"]
    x, y = g[0] + g[1] * grid["columns"] / 2, g[3] + g[5] * grid["rows"] / 2
    across, down = abs(g[1]) * grid["columns"] / 20, abs(g[5]) * grid["rows"] / 20
    box, step = f"{x - across},{y - down},{x + across},{y + down}", 10_000 / 2 ** 0.5
    yield "info", ["info"], False
    yield "height", ["height", "--at", f"{x},{y}"], False
    yield "line of sight of 20 000", ["los", "--from", f"{x - step},{y - step},5", "--to", f"{x + step},{y + step},5"], False
    for error in (50, 5, 0):
        yield f"1 % of the area within {error}", ["extract", "--max-error", str(error), "--region", box], True
    yield "all within 100", ["extract", "--max-error", "100"], True


def ask(arete, words, model, output, writes):
    command = [arete, words[0], model, *words[1:], "--json"] + (["-o", output, "--overwrite"] if writes else [])
    answer = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    if words[0] == "info":  # what needs the whole file is null
        return answer, [answer[key] for key in ("bytes", "samples", "vertices", "grid", "columns")]
    if not writes:
        return answer, {key: value for key, value in answer.items() if key not in ("model", "network") and "econds" not in key}
    with open(output, "rb") as file:
        return answer, file.read()


def main():
    arete, model = sys.argv[1], os.path.abspath(sys.argv[2])
    Files.folder = os.path.dirname(model)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Files)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    address = f"http://127.0.0.1:{server.server_port}/{os.path.basename(model)}"
    facts = json.loads(subprocess.run([arete, "info", address, "--json"], check=True, capture_output=True, text=True).stdout)
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a.ply")
        for name, words, writes in questions(facts):
            remote, got = ask(arete, words, address, output, writes)
            _, wanted = ask(arete, words, model, output, writes)
            use = remote["network"]
            print(f"{name:32} {use['requests']:5} requests {use['bytes'] / 1e6:9.3f} MB  {'the same' if got == wanted else 'DIFFERENT'}")
    server.shutdown()


if __name__ == "__main__":
    main()
