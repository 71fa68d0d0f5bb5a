# SPDX-License-Identifier: GPL-3.0-or-later
"""Every Python block of every page runs as it stands, in a process and a folder with the inputs of inputs.py."""
import collections
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import blocks
import inputs
import marks

BUILD = pathlib.Path(os.environ["ARETE_BUILD"])


def main():
    run, left_out, failed = 0, collections.Counter(), []
    with tempfile.TemporaryDirectory(prefix="arete-pages-") as folder:
        inputs.make(folder, str(BUILD / "arete"))
        variables = dict(os.environ, PYTHONPATH=str(BUILD / "python"), GDAL_DRIVER_PATH=str(BUILD / "gis"), MPLBACKEND="Agg",
                         MPLCONFIGDIR=folder, QT_QPA_PLATFORM="offscreen")
        for block in blocks.all_blocks():
            if block.kind != "python" or (len(sys.argv) > 1 and block.page not in sys.argv[1:]):
                continue
            result = subprocess.run([sys.executable, "-c", block.text], cwd=folder, env=variables, capture_output=True, text=True, timeout=120)
            lacking = re.search(r"ModuleNotFoundError: No module named '(\w+)", result.stderr)
            if result.returncode and lacking and lacking[1] in marks.MODULES:
                left_out[f"needs {lacking[1]}, which is not here"] += 1
                continue
            run += 1
            if result.returncode:
                failed.append(f"{block.page}:{block.line}:\n{block.text}\n{result.stdout[-500:]}{result.stderr[-1500:]}")
    print(f"{run} blocks run, {sum(left_out.values())} not run:")
    for reason, count in left_out.most_common():
        print(f"  {count} x {reason}")
    print("\n".join(failed))
    sys.exit(1 if failed or not run else 0)


main()
