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
from qgis.core import (Qgis, QgsApplication, QgsCoordinateReferenceSystem, QgsFeature, QgsGeometry, QgsProcessingContext,
                       QgsProcessingFeedback, QgsProcessingOutputLayerDefinition, QgsProject, QgsRasterLayer,
                       QgsVectorLayer)  # noqa: E402

application = QgsApplication([], False)
application.initQgis()
import arete  # noqa: E402
import processing  # noqa: E402
from processing.core.Processing import Processing  # noqa: E402

Processing.initialize()
red = []  # what QGIS shows in red of our plugin and our files
QgsApplication.messageLog().messageReceived[str, str, Qgis.MessageLevel].connect(
    lambda text, tag, level: red.append(f"{tag}: {text}") if level == Qgis.Critical else None)
gdal.PushErrorHandler(lambda kind, number, text: red.append(text) if kind >= gdal.CE_Failure else None)
plugin = arete.classFactory(None)
plugin.initProcessing()
loading = list(red)
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
# What is asked of places: layers in the DEM's CRS, whose points are samples of it.
step = source.GetGeoTransform()
columns, rows = source.RasterXSize, source.RasterYSize


def sample(column, row):
    """The middle of a pixel, and its height."""
    place = gdal.ApplyGeoTransform(step, column + 0.5, row + 0.5)
    return place, float(source.GetRasterBand(1).ReadAsArray(column, row, 1, 1)[0, 0])


def layer_of(kind, texts):
    made = QgsVectorLayer(f"{kind}?crs=EPSG:{epsg}&field=fid:integer&field=height:string", kind, "memory")
    for text in texts:
        feature = QgsFeature(made.fields())
        feature.setAttributes([7, text[:4]])
        feature.setGeometry(QgsGeometry.fromWkt(text))
        made.dataProvider().addFeature(feature)
    return made


def point(place):
    return f"POINT({place[0]!r} {place[1]!r})"


def command(*words):
    return json.loads(subprocess.run([os.environ["ARETE"], *map(str, words), "--json"], capture_output=True, text=True,
                                     check=True).stdout)


asked = [sample(columns // 4, rows // 4), sample(columns // 2, rows // 3), sample(3 * columns // 4, rows // 2)]
far = (step[0] - 90 * step[1] * columns, step[3])
answer = processing.run("arete:heights", {"MODEL": model, "INPUT": layer_of("Point", [point(far)] + [point(p) for p, _ in asked]),
                                          "OUTPUT": f"{folder}/heights.gpkg"})
answers = list(QgsVectorLayer(answer["OUTPUT"]).getFeatures())
found["heights"] = [answer["WITH_HEIGHT"], len(answers), bool(answers[0]["height_2"]), answers[1]["height"],
                    max(abs(one["height_2"] - h) for one, (_, h) in zip(answers[1:], asked))]
one, other = asked[0][0], asked[2][0]
lines = layer_of("MultiLineString", [f"MULTILINESTRING(({far[0]!r} {far[1]!r},{far[0]!r} {far[1] - 1!r}))",
                                     f"MULTILINESTRING(({one[0]!r} {one[1]!r},{other[0]!r} {other[1]!r}))"])
profile = list(QgsVectorLayer(processing.run("arete:profile", {"MODEL": model, "INPUT": lines, "OUTPUT": f"{folder}/profile.gpkg"})
                              ["OUTPUT"]).getFeatures())
distances = [f["distance"] for f in profile]
found["profile"] = [sorted({f["line"] for f in profile}), distances == sorted(distances), profile[0]["height"] == "MULT",
                    max(abs(profile[0]["height_2"] - asked[0][1]), abs(profile[-1]["height_2"] - asked[2][1]))]
sight = processing.run("arete:sightlines", {"MODEL": model, "OBSERVERS": layer_of("Point", [point(one)]), "OBSERVER_HEIGHT": 30,
                                            "TARGETS": layer_of("Point", [point(p) for p in (far, asked[1][0], other)]),
                                            "TARGET_HEIGHT": 10, "OUTPUT": f"{folder}/sight.gpkg"})
verdicts = [feature["verdict"] or "" for feature in QgsVectorLayer(sight["OUTPUT"]).getFeatures()]
found["sight"] = [verdicts, [""] + [command("los", model, f"--from={one[0]!r},{one[1]!r},30", f"--to={p[0]!r},{p[1]!r},10")["verdict"]
                                    for p in (asked[1][0], other)], sight["VISIBLE"] == verdicts.count("visible")]
# One by one: a pair without an end is left out, and the others stay pairs; a height that is not stated is the one for all.
ends = layer_of("Point", [point(one), point(one), point(other)])
ends.startEditing()
ends.changeGeometry(2, QgsGeometry())
ends.commitChanges()
pairs = processing.run("arete:sightlines", {"MODEL": model, "OBSERVERS": ends, "TARGETS": layer_of("Point", [
    point(asked[1][0]), point(far), point(one)]), "PAIRS": 1, "OUTPUT": f"{folder}/pairs.gpkg"})
starts = [feature.geometry().asPolyline() for feature in QgsVectorLayer(pairs["OUTPUT"]).getFeatures()]
found["pairs"] = [len(starts), max(abs(starts[1][0].x() - other[0]), abs(starts[1][1].x() - one[0]))]
# Cuts: as many triangles as the command has.
box = [min(one[0], other[0]), min(one[1], other[1]), max(one[0], other[0]), max(one[1], other[1])]
context = QgsProcessingContext()
context.setProject(QgsProject.instance())
region = processing.run("arete:extracttinbyregion", {
    "MODEL": model, "EXTENT": f"{box[0]!r},{box[2]!r},{box[1]!r},{box[3]!r} [EPSG:{epsg}]", "MAX_ERROR": float(tolerance),
    "OUTSIDE_ERROR": 10 * float(tolerance), "OUTPUT": QgsProcessingOutputLayerDefinition(f"{folder}/region.gpkg", context.project())},
    context=context)
found["names"] = [details.name for details in context.layersToLoadOnCompletion().values()]
camera = processing.run("arete:extracttinforcamera", {
    "MODEL": model, "CAMERA": f"{one[0]!r},{one[1]!r} [EPSG:{epsg}]", "HEIGHT": 50, "AZIMUTH": 120, "PITCH": -8, "PIXEL_ERROR": 3,
    "OUTPUT": f"{folder}/camera.gpkg"})
found["cuts"] = [[region["TRIANGLES"], camera["TRIANGLES"]], [command(
    "extract", model, "-o", f"{folder}/asked.ply", *words)["exports"][0]["triangles"] for words in (
        ("--region", ",".join(map(repr, box)), "--max-error", tolerance, "--outside-error", 10 * float(tolerance)),
        (f"--camera={one[0]!r},{one[1]!r},50", "--look=120,-8", "--pixel-error", 3))]]
small = processing.run("arete:decimatemesh", {"INPUT": f"{folder}/asked.ply", "MAX_TRIANGLES": 60, "OUTPUT": f"{folder}/small.2dm"})
apart = processing.run("arete:measuremeshes", {"FIRST": f"{folder}/small.2dm", "SECOND": f"{folder}/asked.ply"})
found["meshes"] = [small["TRIANGLES"], apart["MAX_DISTANCE_BACK"], small["ERROR"]]


class Impatient(QgsProcessingFeedback):
    """Cancels at the first progress."""

    def setProgressText(self, text):
        self.cancel()


try:
    processing.run("arete:build", {"INPUT": dem, "OUTPUT": f"{folder}/canceled.amt"}, feedback=Impatient())
    found["canceled"] = "not"
except Exception as error:  # noqa: BLE001: whatever QGIS makes of it
    found["canceled"] = [str(error), os.path.exists(f"{folder}/canceled.amt")]
# Opening a model, as QGIS does it: for an update first.
red.clear()
found["opened"] = [QgsVectorLayer(model, "triangles", "ogr").isValid(), QgsRasterLayer(model, "heights", "gdal").isValid()]
found["red"] = loading + red
found["icons"] = all(not one.icon().isNull() and os.path.exists(one.svgIconPath()) and "<img" in one.shortHelpString()
                     for one in QgsApplication.processingRegistry().providerById("arete").algorithms()
                     if not one.name().startswith("measure"))
plugin.unload()
print(json.dumps(found))
sys.stdout.flush()
os._exit(0)  # QGIS 3.22 sometimes crashes while it takes its layers down
