# SPDX-License-Identifier: GPL-3.0-or-later
"""tutorial_python.py MODEL.amt OUT.png: the picture that the Python step of docs/start/tutorial.md draws."""
import sys

import arete
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

tin = arete.open(sys.argv[1]).cut(max_error=100)
x, y, z = tin.vertices.T
figure, axes = plt.subplots(figsize=(6.4, 5), layout="constrained")
drawn = axes.tripcolor(x, y, tin.triangles, z, cmap="terrain", edgecolors="black", linewidth=0.15)
figure.colorbar(drawn, label="height, m")
axes.set_aspect("equal")
axes.ticklabel_format(useOffset=False, style="plain")
axes.set_title(f"{len(tin.triangles)} triangles within {tin.error:.0f} m")
figure.savefig(sys.argv[2], dpi=120)
