# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the program arete for an algorithm: its answer, its progress, its errors."""

import json
import os
import re
import shutil
import signal
import subprocess

from qgis.core import QgsProcessingException


def run(words, feedback):
    """The answer of a command as its --json says it. Progress and Cancel are those of QGIS."""
    program = os.environ.get("ARETE") or shutil.which("arete")
    if not program:
        raise QgsProcessingException("the program arete is not installed, or not in PATH (ARETE names it)")
    words = [program, *map(str, words), "--json", "--progress"]
    feedback.pushCommandInfo(" ".join(words))
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace") as process:
        said = []
        for line in _lines(process.stderr):
            percent = re.search(r"(\d+) ?%", line)
            if percent:
                feedback.setProgress(float(percent[1]))
            elif line.strip():
                said.append(line.strip())
                feedback.pushInfo(line.strip())
            if feedback.isCanceled():
                process.send_signal(signal.SIGINT)
        answer = process.stdout.read()
    if feedback.isCanceled():
        raise QgsProcessingException("canceled")
    if process.returncode != 0:
        raise QgsProcessingException("\n".join(said) or f"arete gave exit code {process.returncode}")
    return json.loads(answer)


def _lines(stream):
    """Lines of text, and of progress, which end in a carriage return."""
    line = ""
    while True:
        character = stream.read(1)
        if not character:
            break
        if character in "\r\n":
            yield line
            line = ""
        else:
            line += character
    yield line
