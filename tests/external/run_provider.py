# SPDX-License-Identifier: GPL-3.0-or-later
"""What the algorithms of the QGIS plugin make of a DEM, as JSON on the last line: PLUGINS DEM FOLDER TOLERANCE X Y EPSG.

ARETE names the program."""

import json
import os
import sys

plugins, dem, folder, tolerance, x, y, epsg = sys.argv[1:8]
sys.path[:0] = ["/usr/share/qgis/python/plugins", plugins]

from qgis.core import QgsApplication, QgsRasterLayer, QgsVectorLayer  # noqa: E402

application = QgsApplication([], False)
application.initQgis()
import arete  # noqa: E402
import processing  # noqa: E402
from processing.core.Processing import Processing  # noqa: E402

Processing.initialize()
plugin = arete.classFactory(None)
plugin.initProcessing()
found = {"algorithms": [one.name() for one in QgsApplication.processingRegistry().providerById("arete").algorithms()]}
model = processing.run("arete:build", {"INPUT": dem, "OUTPUT": f"{folder}/provider.amt"})["OUTPUT"]
tin = processing.run("arete:extracttin", {"MODEL": model, "MAX_ERROR": float(tolerance),
                                          "OUTPUT": f"{folder}/provider.gpkg"})
layer = QgsVectorLayer(tin["OUTPUT"], "tin", "ogr")
found.update(triangles=[tin["TRIANGLES"], layer.featureCount()], error=tin["ERROR"], crs=layer.crs().authid())
raster = processing.run("arete:extractraster", {"MODEL": model, "MAX_ERROR": float(tolerance),
                                                "OUTPUT": f"{folder}/provider.tif"})["OUTPUT"]
found["measured"] = processing.run("arete:measure", {"TIN": tin["OUTPUT"], "DEM": dem})["MAX_ERROR"]
seen = processing.run("arete:viewshed", {"MODEL": model, "OBSERVER": f"{x},{y} [EPSG:{epsg}]", "CRS": f"EPSG:{epsg}",
                                         "RADIUS": 2000, "OUTPUT": f"{folder}/provider_seen.tif"})["OUTPUT"]
found["rasters"] = [QgsRasterLayer(path).isValid() for path in (raster, seen)]
found["refused"] = []
for name, parameters in (("extracttin", {"MODEL": model, "OUTPUT": f"{folder}/none.gpkg"}),
                         ("extractraster", {"MODEL": f"{folder}/none.amt", "MAX_ERROR": 1, "OUTPUT": f"{folder}/none.tif"}),
                         ("extracttin", {"MODEL": model, "MAX_TRIANGLES": 1, "OUTPUT": f"{folder}/none.gpkg"})):
    try:
        processing.run(f"arete:{name}", parameters)
        found["refused"].append("")
    except Exception as error:  # noqa: BLE001: whatever QGIS makes of it
        found["refused"].append(str(error))
plugin.unload()
print(json.dumps(found))
sys.stdout.flush()
os._exit(0)  # QGIS 3.22 sometimes crashes while it takes its layers down
