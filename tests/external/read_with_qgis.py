# SPDX-License-Identifier: GPL-3.0-or-later
"""What QGIS finds in a 2DM and a GeoPackage, as JSON on the last line: MESH GEOPACKAGE."""

import json
import os
import sys

from qgis.core import Qgis, QgsApplication, QgsMesh, QgsMeshLayer, QgsVectorLayer, QgsWkbTypes


def rectangle(extent):
    return [extent.xMinimum(), extent.yMinimum(), extent.xMaximum(), extent.yMaximum()]


application = QgsApplication([], False)
application.initQgis()

layer = QgsMeshLayer(sys.argv[1], "mesh", "mdal")
mesh = {"valid": layer.isValid()}
if layer.isValid():
    provider, native = layer.dataProvider(), QgsMesh()
    provider.populateMesh(native)
    heights = [native.vertex(i).z() for i in range(native.vertexCount())]
    mesh.update(vertices=provider.vertexCount(), faces=provider.faceCount(), extent=rectangle(layer.extent()),
                heights=[min(heights), max(heights)])

layer = QgsVectorLayer(sys.argv[2], "triangles", "ogr")
vector = {"valid": layer.isValid()}
if layer.isValid():
    invalid = sum(not feature.geometry().isGeosValid() for feature in layer.getFeatures())
    error = layer.fields().indexOf("error")
    vector.update(features=layer.featureCount(), extent=rectangle(layer.extent()), crs=layer.crs().authid(),
                  geometry=QgsWkbTypes.displayString(layer.wkbType()), invalid=invalid,
                  largestError=layer.maximumValue(error) if error >= 0 else None)

print(json.dumps({"version": Qgis.QGIS_VERSION.split("-")[0], "mesh": mesh, "vector": vector}))
sys.stdout.flush()
os._exit(0)  # QGIS 3.22 sometimes crashes while it takes its layers down
