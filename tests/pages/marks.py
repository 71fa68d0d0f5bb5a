# SPDX-License-Identifier: GPL-3.0-or-later
"""Which lines of the pages are not run, each with its reason, and which are run smaller than they stand there."""
import re

# (what a line matches, why it is not run). A mark that no line matches fails blocks_test.py.
NOT_RUN = [(re.compile(pattern), reason) for pattern, reason in (
    (r"^\./dev ", "builds Arete, or runs the tests of which this is one"),
    (r"^git clone ", "needs a network"),
    (r"^arete-datasets fetch ", "needs a network"),
    (r"^arete \w+ +https://", "needs a network"),
    (r"^sudo |^apt(-get)? ", "installs packages"),
    (r"^cmake ", "tests/library installs Arete and builds the examples"),
    (r"^(GDAL_DRIVER_PATH=\S+ )?qgis( |$)", "opens the window of QGIS"),
    (r"^qgis_process ", "needs QGIS: tests/external runs the plugin"),
    (r"^PYTHONPATH=\S+ /usr/bin/python3$", "waits for what a person types"),
)]

# (what a line matches, what is added): a window closes by itself after two frames, terrains and
# flights are small.
CHANGED = [(re.compile(pattern), added) for pattern, added in (
    (r"^arete-datasets generate(?!.*--size)", " --size 257"),
    (r"^arete view\s(?!.*--headless)", " --window-frames 2"),
    (r"^arete view\s.*--headless.*--round", " --size 96x54 --fps 2"),
    (r"^arete view\s.*--headless(?!.*--size)(?!.*--round)", " --size 320x180"),
)]

# Programs that a page uses and that a machine may lack; what needs them is then counted as not run here.
PROGRAMS = ("gdalinfo", "gdal_translate", "gdalbuildvrt", "gdaldem", "gdalwarp", "ogr2ogr", "ogrinfo", "rio", "jq", "xvfb-run", "ffmpeg", "assimp")

# Python packages of which the same holds.
MODULES = {"rasterio", "rioxarray", "xarray", "geopandas", "shapely", "fiona", "meshio", "matplotlib", "trimesh", "pyvista", "osgeo",
           "pandas", "affine", "pyproj", "IPython"}


def reason_not_to_run(command):
    return next((reason for pattern, reason in NOT_RUN if pattern.search(command)), None)


def as_run(command):
    """The command with what is added to it, before a comment or a pipe."""
    body, comment = re.match(r"(.*?)(\s+#.*|\s+\|.*)?$", command).groups()
    return body + "".join(added for pattern, added in CHANGED if pattern.search(body)) + (comment or "")
