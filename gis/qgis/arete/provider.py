# SPDX-License-Identifier: GPL-3.0-or-later
from qgis.core import QgsProcessingProvider

from .algorithms import Build, ExtractTin, ExtractRaster, Measure, Viewshed


class Provider(QgsProcessingProvider):
    def id(self):
        return "arete"

    def name(self):
        return "Arete"

    def loadAlgorithms(self):
        for algorithm in (Build, ExtractTin, ExtractRaster, Measure, Viewshed):
            self.addAlgorithm(algorithm())
