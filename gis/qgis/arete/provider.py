# SPDX-License-Identifier: GPL-3.0-or-later
from qgis.core import QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .algorithm import ICON
from .cuts import ExtractRaster, ExtractTin, ExtractTinByRegion, ExtractTinForCamera
from .meshes import Decimate, MeasureMeshes
from .models import Build, Measure
from .queries import Heights, Profile, SightLines, Viewshed


class Provider(QgsProcessingProvider):
    def id(self):
        return "arete"

    def name(self):
        return "Arete"

    def icon(self):
        return QIcon(ICON)

    def svgIconPath(self):
        return ICON

    def loadAlgorithms(self):
        for algorithm in (Build, Measure, ExtractTin, ExtractTinByRegion, ExtractTinForCamera, ExtractRaster, Heights, Profile,
                          SightLines, Viewshed, Decimate, MeasureMeshes):
            self.addAlgorithm(algorithm())
