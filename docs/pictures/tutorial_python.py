# SPDX-License-Identifier: GPL-3.0-or-later
"""tutorial_python.py MODEL.amt OUT.png: the picture that the Python step of docs/start/tutorial.md draws."""
import sys

import arete
import matplotlib

matplotlib.use("Agg")

tin = arete.open(sys.argv[1]).cut(max_error=100)
axes = tin.plot(edges=True, title=f"{len(tin.triangles)} triangles within {tin.error:.0f} m")
axes.figure.savefig(sys.argv[2], dpi=120)
