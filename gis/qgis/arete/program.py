# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the program arete for an algorithm: its answer, its progress, its errors."""

import json
import os
import re
import shutil
import signal
import subprocess
import threading

from qgis.core import QgsProcessingException

BAR = "0...10...20...30...40...50...60...70...80...90...100 - done."
TICKS = 40
WARNING = "arete: warning: "
SECONDS_TO_END = 20  # after Cancel, for temporary files to be removed


def run(words, feedback):
    """The answer of a command as its --json says it. Progress and Cancel are those of QGIS."""
    program = os.environ.get("ARETE") or shutil.which("arete")
    if not program:
        raise QgsProcessingException("the program arete is not installed, or not in PATH (ARETE names it)")
    words = [program, *map(str, words), "--json", "--progress"]
    feedback.pushCommandInfo(" ".join(words))
    with subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          errors="replace") as process:
        answer, said, stage = [], [], None
        # Beside stderr: the program waits where one of its pipes is full.
        reader = threading.Thread(target=lambda: answer.append(process.stdout.read()))
        reader.start()
        # Beside both: a stage that says nothing for a minute is canceled at once too.
        has_ended = threading.Event()
        watcher = threading.Thread(target=_interrupt_where_canceled, args=(process, feedback, has_ended))
        watcher.start()
        for line, is_whole in _lines(process.stderr):
            bar = progress_of(line)
            if bar:
                if bar[0] != stage:
                    stage = bar[0]
                    feedback.setProgressText(stage)
                feedback.setProgress(bar[1])
            elif is_whole and line.strip():
                text = line.strip()
                if text.startswith(WARNING):
                    feedback.pushWarning(text[len(WARNING):])
                else:
                    said.append(text)
                    feedback.pushInfo(text)
        reader.join()
        has_ended.set()
        watcher.join()
    if feedback.isCanceled():
        raise QgsProcessingException("canceled")
    if process.returncode != 0:
        said = [text[len("arete: "):] if text.startswith("arete: ") else text for text in said]
        raise QgsProcessingException("\n".join(said) or f"arete gave exit code {process.returncode}")
    return json.loads(answer[0])


def _interrupt_where_canceled(process, feedback, has_ended):
    while not has_ended.wait(0.1):
        if feedback.isCanceled():
            process.send_signal(signal.SIGINT)
            if not has_ended.wait(SECONDS_TO_END):
                process.kill()
            return


def progress_of(line):
    """Stage and percent of a line of progress as the program writes it ("build 0...10...2"), whole or not; None of others."""
    stage, space, bar = line.partition(" 0")
    if not space or not stage.strip() or ":" in stage or not BAR.startswith("0" + bar.rstrip()):
        return None
    ticks = len(re.findall(r"\.|\d+", ("0" + bar).split(" ")[0])) - 1
    return stage.strip(), 100 * min(ticks, TICKS) / TICKS


def _lines(stream):
    """Lines of text, and what there is of a line wherever progress may be read from it: (text, whether it is whole)."""
    line = ""
    while True:
        character = stream.read(1)
        if not character:
            break
        if character in "\r\n":
            yield line, True
            line = ""
        else:
            line += character
            if character == ".":
                yield line, False
    yield line, True
