#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of the plugin's help with the plugin itself: draw_pictures.py OUTPUT_FOLDER. ARETE and ARETE_DATASETS
name the programs (default: those in PATH). The pictures that are shipped are in gis/qgis/arete/pictures."""

import os
import subprocess
import sys
import tempfile

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = ["/usr/share/qgis/python/plugins", HERE]

from PIL import Image  # noqa: E402
from qgis.core import (QgsApplication, QgsBilinearRasterResampler, QgsColorRampShader, QgsCoordinateReferenceSystem,  # noqa: E402
                       QgsFeature, QgsFillSymbol,
                       QgsGeometry, QgsHillshadeRenderer, QgsLineSymbol, QgsMapRendererParallelJob, QgsMapSettings,
                       QgsMarkerSymbol, QgsRasterLayer, QgsRasterShader, QgsRectangle, QgsSingleBandPseudoColorRenderer,
                       QgsSingleSymbolRenderer, QgsVectorLayer)
from qgis.PyQt.QtCore import QPointF, QRectF, QSize, Qt  # noqa: E402
from qgis.PyQt.QtGui import QColor, QFont, QImage, QPainter, QPen, QPolygonF  # noqa: E402

WIDTH, HEIGHT = 300, 190
CRS = "EPSG:32611"
application = QgsApplication([], False)
application.initQgis()
import arete  # noqa: E402
import processing  # noqa: E402
from processing.core.Processing import Processing  # noqa: E402

Processing.initialize()
plugin = arete.classFactory(None)
plugin.initProcessing()
output, folder = os.path.abspath(sys.argv[1]), tempfile.mkdtemp()
os.makedirs(output, exist_ok=True)
os.chdir(folder)
subprocess.run([os.environ.get("ARETE_DATASETS", "arete-datasets"), "generate", "-o", "plain.tif", "--size", "257", "--no-lake",
                "--no-sea", "--quiet"], check=True)
processing.run("gdal:translate", {"INPUT": "plain.tif", "TARGET_CRS": CRS, "OUTPUT": "dem.tif"})
model = processing.run("arete:build", {"INPUT": "dem.tif", "OUTPUT": "dem.amt"})["OUTPUT"]
box = QgsRasterLayer("dem.tif").extent()
WEST, SOUTH = box.xMinimum(), box.yMinimum()
view = QgsRectangle(WEST + 1200, SOUTH + 2200, WEST + 6200, SOUTH + 2200 + 5000 * HEIGHT / WIDTH)


def at(x, y):
    """A place by its shares of the picture, from the lower left."""
    return view.xMinimum() + x * view.width(), view.yMinimum() + y * view.height()


def shapes(kind, texts):
    layer = QgsVectorLayer(f"{kind}?crs={CRS}", kind, "memory")
    for text in texts:
        feature = QgsFeature()
        feature.setGeometry(QgsGeometry.fromWkt(text))
        layer.dataProvider().addFeature(feature)
    layer.updateExtents()
    return layer


def point(*shares):
    return "POINT({!r} {!r})".format(*at(*shares))


def look(layer, symbol):
    layer.setRenderer(QgsSingleSymbolRenderer(symbol))
    return layer


def triangles(path, width="0.18"):
    return look(QgsVectorLayer(path, "tin"), QgsFillSymbol.createSimple(
        {"style": "no", "outline_color": "22,50,79,190", "outline_width": width}))


def hills(path="dem.tif"):
    layer = QgsRasterLayer(path)
    renderer = QgsHillshadeRenderer(layer.dataProvider(), 1, 315, 45)
    renderer.setZFactor(0.45)
    layer.setRenderer(renderer)
    layer.setOpacity(0.75)
    layer.resampleFilter().setZoomedInResampler(QgsBilinearRasterResampler())
    return layer


def picture(layers):
    settings = QgsMapSettings()
    settings.setLayers(layers)
    settings.setDestinationCrs(QgsCoordinateReferenceSystem(CRS))
    settings.setOutputSize(QSize(WIDTH, HEIGHT))
    settings.setExtent(view)
    settings.setBackgroundColor(QColor("white"))
    job = QgsMapRendererParallelJob(settings)
    job.start()
    job.waitForFinished()
    return job.renderedImage()


def save(image, name):
    """In 96 colours, rare ones too: a third of the bytes."""
    image.convertToFormat(QImage.Format_RGB888).save(f"{folder}/{name}.png")
    Image.open(f"{folder}/{name}.png").quantize(96, Image.Quantize.MAXCOVERAGE).save(f"{output}/{name}.png", optimize=True)


def tin(name, algorithm, **parameters):
    return processing.run(f"arete:{algorithm}", {"MODEL": model, "OUTPUT": f"{name}.gpkg", **parameters})["OUTPUT"]


# Three levels of detail, side by side.
image, part = picture([hills()]).convertToFormat(QImage.Format_RGB32), WIDTH // 3
for n, number in enumerate((300, 2000, 12000)):
    one = picture([triangles(tin(f"level{n}", "extracttin", MAX_TRIANGLES=number), "0.12"), hills()])
    painter = QPainter(image)
    painter.drawImage(QRectF(n * part, 0, part, HEIGHT), one, QRectF(100, 0, part, HEIGHT))
    painter.setPen(QPen(QColor("white"), 2))
    painter.drawLine(n * part, 0, n * part, HEIGHT) if n else None
    painter.end()
save(image, "levels")
save(picture([triangles(tin("tin", "extracttin", MAX_ERROR=30)), hills()]), "tin")

region = "POLYGON((" + ",".join("{!r} {!r}".format(*at(*p)) for p in ((.3, .25), (.55, .2), (.68, .5), (.5, .8), (.3, .65), (.3, .25))) + "))"
area = shapes("Polygon", [region])
layer = triangles(tin("region", "extracttinbyregion", REGION=area, MAX_ERROR=6, OUTSIDE_ERROR=150))
save(picture([look(area, QgsFillSymbol.createSimple({"color": "255,160,0,40", "outline_color": "#d9480f", "outline_width": "0.6"})),
              layer, hills()]), "region")

eye = "{!r},{!r} [{}]".format(*at(.12, .15), CRS)
layer = triangles(tin("camera", "extracttinforcamera", CAMERA=eye, HEIGHT=60.0, AZIMUTH=55.0, PITCH=-5.0, FOV=40.0, PIXEL_ERROR=10.0))
marker = look(shapes("Point", [point(.12, .15)]), QgsMarkerSymbol.createSimple(
    {"name": "filled_arrowhead", "angle": "-35", "color": "#d9480f", "outline_color": "white", "size": "6"}))
save(picture([marker, layer, hills()]), "camera")

coarse = processing.run("arete:extractraster", {"MODEL": model, "MAX_ERROR": 80.0, "OUTPUT": "coarse.tif"})["OUTPUT"]
save(picture([hills(coarse)]), "raster")

# Heights: the answers beside the points.
places = [(.2, .3), (.45, .55), (.7, .35), (.82, .75), (.3, .8)]
found = QgsVectorLayer(processing.run("arete:heights", {"MODEL": model, "INPUT": shapes("Point", [point(*p) for p in places]),
                                                        "OUTPUT": "heights.gpkg"})["OUTPUT"])
dots = look(shapes("Point", [point(*p) for p in places]), QgsMarkerSymbol.createSimple(
    {"color": "#d9480f", "outline_color": "white", "size": "2.6"}))
image = picture([dots, hills()])
painter = QPainter(image)
painter.setFont(QFont("DejaVu Sans", 9, QFont.Bold))
for (x, y), feature in zip(places, found.getFeatures()):
    where, text = QPointF(x * WIDTH + 7, (1 - y) * HEIGHT + 4), f"{feature['height']:.1f}"
    painter.setPen(QColor("white"))
    for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1)):
        painter.drawText(where + QPointF(dx, dy), text)
    painter.setPen(QColor("#16324f"))
    painter.drawText(where, text)
painter.end()
save(image, "heights")

# The profile: the table of the answer as a chart.
ends = [at(.1, .2), at(.9, .8)]
line = shapes("LineString", ["LINESTRING({!r} {!r},{!r} {!r})".format(*ends[0], *ends[1])])
rows = [(f["distance"], f["height"]) for f in QgsVectorLayer(processing.run(
    "arete:profile", {"MODEL": model, "INPUT": line, "OUTPUT": "profile.gpkg"})["OUTPUT"]).getFeatures()]
low, high, far = min(h for _, h in rows), max(h for _, h in rows), rows[-1][0]
image = QImage(WIDTH, HEIGHT, QImage.Format_RGB32)
image.fill(QColor("white"))
painter = QPainter(image)
painter.setRenderHint(QPainter.Antialiasing)
curve = [QPointF(10 + (WIDTH - 20) * d / far, HEIGHT - 20 - (HEIGHT - 40) * (h - low) / (high - low)) for d, h in rows]
painter.setBrush(QColor("#a8cc83"))
painter.setPen(Qt.NoPen)
painter.drawPolygon(QPolygonF([QPointF(10, HEIGHT - 10), *curve, QPointF(WIDTH - 10, HEIGHT - 10)]))
painter.setBrush(Qt.NoBrush)
painter.setPen(QPen(QColor("#16324f"), 1.5))
painter.drawPolyline(QPolygonF(curve))
painter.end()
save(image, "profile")

one, others = shapes("Point", [point(.2, .2)]), shapes("Point", [point(*p) for p in ((.9, .9), (.85, .5), (.7, .15), (.5, .8), (.15, .85), (.55, .45))])
answer = processing.run("arete:sightlines", {"MODEL": model, "OBSERVERS": one, "TARGETS": others, "OBSERVER_HEIGHT": 60.0,
                                             "TARGET_HEIGHT": 60.0, "OUTPUT": "sight.gpkg"})["OUTPUT"]
layers = [look(layer, QgsMarkerSymbol.createSimple({"color": colour, "outline_color": "white", "size": "2.8"}))
          for layer, colour in ((one, "#d9480f"), (others, "#16324f"))]
for verdict, colour in (("visible", "#2f9e44"), ("blocked", "#c92a2a")):
    layer = QgsVectorLayer(answer)
    layer.setSubsetString(f"verdict = '{verdict}'")
    layers.append(look(layer, QgsLineSymbol.createSimple({"color": colour, "width": "0.7"})))
save(picture([*layers, hills()]), "sight")

eye = "{!r},{!r} [{}]".format(*at(.45, .45), CRS)
seen = QgsRasterLayer(processing.run("arete:viewshed", {"MODEL": model, "OBSERVER": eye, "HEIGHT": 30.0, "OUTPUT": "seen.tif"})["OUTPUT"])
ramp, shader = QgsColorRampShader(0, 255, None, QgsColorRampShader.Exact), QgsRasterShader()
ramp.setColorRampItemList([QgsColorRampShader.ColorRampItem(255, QColor(255, 200, 0, 150))])
shader.setRasterShaderFunction(ramp)
seen.setRenderer(QgsSingleBandPseudoColorRenderer(seen.dataProvider(), 1, shader))
marker = look(shapes("Point", [point(.45, .45)]), QgsMarkerSymbol.createSimple({"color": "#d9480f", "outline_color": "white", "size": "2.8"}))
save(picture([marker, seen, hills()]), "viewshed")
# A mesh before and after: pictures of the documentation.
image = QImage(WIDTH, HEIGHT, QImage.Format_RGB32)
image.fill(QColor("white"))
painter = QPainter(image)
painter.setRenderHint(QPainter.SmoothPixmapTransform)
for n, name in enumerate(("rock", "rock-16")):
    one = QImage(os.path.join(HERE, "..", "..", "docs", "pictures", f"{name}.png")).scaled(
        WIDTH // 2, HEIGHT, Qt.KeepAspectRatio, Qt.SmoothTransformation)
    painter.drawImage(n * WIDTH // 2 + (WIDTH // 2 - one.width()) // 2, (HEIGHT - one.height()) // 2, one)
painter.end()
save(image, "decimate")
sys.stdout.flush()
os._exit(0)  # QGIS 3.22 sometimes crashes while it takes its layers down
