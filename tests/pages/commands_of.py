# SPDX-License-Identifier: GPL-3.0-or-later
"""commands_of.py PAGE...: the lines of the shell that pages show, those that run without a network, a window or other programs.

A script for a machine of which nothing else is known: in a bare Debian with the package, for instance.
"""
import re
import sys

import blocks
import marks

for block in blocks.all_blocks():
    if block.kind == "shell" and block.page in sys.argv[1:]:
        for _, command in blocks.commands_of(block):
            needs_other = any(re.search(rf"(?:^|[\s|]){re.escape(p)}(?:\s|$)", command) for p in marks.PROGRAMS) or "--film" in command
            if not marks.reason_not_to_run(command) and not needs_other and "--window-frames" not in marks.as_run(command):
                print(command)
