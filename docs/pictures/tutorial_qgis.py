# SPDX-License-Identifier: GPL-3.0-or-later
"""tutorial_qgis.py MODEL.amt OUT.png: an .amt in QGIS, as a shaded raster and as triangles, drawn without a window."""
import os
import sys

from qgis.core import (QgsApplication, QgsFillSymbol, QgsHillshadeRenderer, QgsMapRendererParallelJob, QgsMapSettings,
                       QgsRasterLayer, QgsRectangle, QgsVectorLayer)
from qgis.PyQt.QtCore import QSize

QgsApplication.setPrefixPath("/usr", True)
application = QgsApplication([], False)
application.initQgis()
raster = QgsRasterLayer(sys.argv[1] + "|option:TOLERANCE=5", "raster")
triangles = QgsVectorLayer(sys.argv[1] + "|option:TOLERANCE=50", "triangles", "ogr")
assert raster.isValid() and triangles.isValid()
raster.setRenderer(QgsHillshadeRenderer(raster.dataProvider(), 1, 315, 45))
triangles.renderer().setSymbol(QgsFillSymbol.createSimple({"style": "no", "outline_color": "170,30,10,140", "outline_width": "0.16"}))
settings = QgsMapSettings()
settings.setLayers([triangles, raster])
settings.setDestinationCrs(raster.crs())
settings.setOutputSize(QSize(640, 400))
middle = raster.extent().center()
settings.setExtent(QgsRectangle(middle.x() - 9600, middle.y() - 6000, middle.x() + 9600, middle.y() + 6000))
job = QgsMapRendererParallelJob(settings)
job.start()
job.waitForFinished()
assert job.renderedImage().save(sys.argv[2])
os._exit(0)  # the order in which Python takes QGIS down is not safe
