# SPDX-License-Identifier: GPL-3.0-or-later
"""What the algorithms of the QGIS plugin make of a DEM, as JSON on the last line: PLUGINS DEM FOLDER TOLERANCE X Y EPSG.

ARETE names the program."""

import json
import os
import subprocess
import sys

plugins, dem, folder, tolerance, x, y, epsg = sys.argv[1:8]
sys.path[:0] = ["/usr/share/qgis/python/plugins", plugins]

from osgeo import gdal  # noqa: E402
from qgis.core import (QgsApplication, QgsCoordinateReferenceSystem, QgsProcessingFeedback, QgsRasterLayer,
                       QgsVectorLayer)  # noqa: E402

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
# Layers as they are in QGIS: a CRS set by its user, options of the driver, another band.
layer = QgsRasterLayer(dem, "of a user")
layer.setCrs(QgsCoordinateReferenceSystem("EPSG:32701"))
feedback, progress = QgsProcessingFeedback(), []
feedback.progressChanged.connect(progress.append)
changed = processing.run("arete:build", {"INPUT": layer, "OUTPUT": f"{folder}/crs.amt"}, feedback=feedback)["OUTPUT"]
found["progress"] = [len(progress) > 10, feedback.progress(), "0..." in feedback.textLog()]
said = subprocess.run([os.environ["ARETE"], "info", changed, "--json"], capture_output=True, text=True, check=True).stdout
found["setCrs"] = json.loads(said)["crs"]
source = gdal.Open(dem)
two = gdal.GetDriverByName("GTiff").Create(f"{folder}/two.tif", source.RasterXSize, source.RasterYSize, 2, gdal.GDT_Float64)
two.SetGeoTransform(source.GetGeoTransform())
two.SetProjection(source.GetProjection())
two.GetRasterBand(1).Fill(7)
two.GetRasterBand(2).WriteArray(source.ReadAsArray())
if source.GetRasterBand(1).GetNoDataValue() is not None:
    two.GetRasterBand(2).SetNoDataValue(source.GetRasterBand(1).GetNoDataValue())
two = None
found["secondBand"] = processing.run("arete:measure", {"TIN": tin["OUTPUT"], "DEM": f"{folder}/two.tif", "BAND": 2})["MAX_ERROR"]
coarse = QgsRasterLayer(f"{model}|option:TOLERANCE={tolerance}", "coarse", "gdal")
if coarse.isValid():  # the driver is there
    found["options"] = processing.run("arete:measure", {"TIN": tin["OUTPUT"], "DEM": coarse})["MAX_ERROR"]
    processing.run("arete:build", {"INPUT": coarse, "OUTPUT": f"{folder}/coarse.amt"})
# An observer in another CRS, and a stated one that is wrong.
seen = processing.run("arete:viewshed", {"MODEL": model, "OBSERVER": f"{x},{y} [EPSG:{epsg}]", "CRS": "EPSG:4326",
                                         "RADIUS": 500, "OUTPUT": f"{folder}/wrong_crs.tif"})["OUTPUT"]
found["rasters"].append(QgsRasterLayer(seen).isValid())
plugin.unload()
print(json.dumps(found))
sys.stdout.flush()
os._exit(0)  # QGIS 3.22 sometimes crashes while it takes its layers down
