# SPDX-License-Identifier: GPL-3.0-or-later
"""What the algorithms share: each is a command of arete, and its parameters are options of that command."""

import os
import re

from qgis.core import (QgsApplication, QgsCoordinateReferenceSystem, QgsProcessingAlgorithm, QgsProcessingException,
                       QgsProcessingParameterBand, QgsProcessingParameterCrs, QgsProcessingParameterDefinition,
                       QgsProcessingParameterFile, QgsProcessingParameterNumber, QgsProcessingParameterRasterLayer)
from qgis.PyQt.QtCore import QUrl
from qgis.PyQt.QtGui import QIcon

from .layers import words_of
from .program import run

FOLDER = os.path.dirname(__file__)
ICON = os.path.join(FOLDER, "icon.svg")


class Algorithm(QgsProcessingAlgorithm):
    """Algorithms are made anew for every run, and their texts are class attributes."""

    NAME = TITLE = GROUP = HELP = PICTURE = ""
    TAGS = ["arete", "dem", "terrain", "tin", "level of detail"]

    def createInstance(self):
        return type(self)()

    def name(self):
        return self.NAME

    def displayName(self):
        return self.TITLE

    def group(self):
        return self.GROUP

    def groupId(self):
        return self.GROUP.lower().replace(" ", "")

    def tags(self):
        return self.TAGS

    def icon(self):
        return QIcon(ICON)

    def svgIconPath(self):
        return ICON

    def shortHelpString(self):
        """With a picture in the dialog, which reads HTML; qgis_process prints the text as it is."""
        picture = os.path.join(FOLDER, "pictures", self.PICTURE)
        if not self.PICTURE or QgsApplication.platform() == "qgis_process" or not os.path.exists(picture):
            return self.HELP
        return f'{self.HELP}\n<img width="240" src="{QUrl.fromLocalFile(picture).toString()}">'

    def helpUrl(self):
        """The page of the documentation, where it is installed beside the plugin."""
        share = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(FOLDER)))))
        page = os.path.join(share, "share", "doc", "arete", "docs", "topics", "qgis.md")
        return QUrl.fromLocalFile(page).toString() if os.path.exists(page) else ""

    # --- parameters -----------------------------------------------------------------------------------------------

    def add(self, parameter, is_advanced=False):
        if is_advanced:
            parameter.setFlags(parameter.flags() | QgsProcessingParameterDefinition.FlagAdvanced)
        self.addParameter(parameter)

    def model_parameter(self):
        self.add(QgsProcessingParameterFile("MODEL", "Multitriangulation (.amt)", extension="amt"))

    def model_crs_parameter(self):
        self.add(QgsProcessingParameterCrs("CRS", "CRS of the terrain, where the multitriangulation has none", optional=True), True)

    def number(self, name, title, default=None, optional=False, least=0.0, most=None, is_advanced=False):
        parameter = QgsProcessingParameterNumber(name, title, QgsProcessingParameterNumber.Double, default, optional)
        if least is not None:
            parameter.setMinimum(least)
        if most is not None:
            parameter.setMaximum(most)
        self.add(parameter, is_advanced)

    def count(self, name, title, default=None, is_advanced=False):
        self.add(QgsProcessingParameterNumber(name, title, QgsProcessingParameterNumber.Integer, default, default is None, 1),
                 is_advanced)

    def dem_parameter(self, name):
        self.add(QgsProcessingParameterRasterLayer(name, "DEM"))
        self.add(QgsProcessingParameterBand("BAND", "Band", 1, name, optional=True))

    # --- their values ---------------------------------------------------------------------------------------------

    def stated(self, parameters, name):
        return parameters.get(name) not in (None, "")

    def option(self, parameters, context, name, word):
        """[word, value] of a number that is stated, [] of one that is not."""
        if not self.stated(parameters, name):
            return []
        is_whole = self.parameterDefinition(name).dataType() == QgsProcessingParameterNumber.Integer
        return [word, self.parameterAsInt(parameters, name, context) if is_whole
                else repr(self.parameterAsDouble(parameters, name, context))]

    def model(self, parameters, context):
        path = self.parameterAsFile(parameters, "MODEL", context)
        if not path.startswith("/vsi") and not os.path.isfile(path):
            raise QgsProcessingException(f"there is no multitriangulation {path}")
        return path

    def dem(self, parameters, name, context):
        band = self.parameterAsInt(parameters, "BAND", context) if self.stated(parameters, "BAND") else None
        return words_of(self.parameterAsRasterLayer(parameters, name, context), band)

    def crs_of_terrain(self, model, parameters, context, feedback, otherwise):
        """(CRS of a model, whether the file says it): where it does not, what is stated, and else that of the layer asked with it."""
        crs = crs_of(model, feedback)
        stated = self.parameterAsCrs(parameters, "CRS", context)
        if crs.isValid():
            if stated.isValid() and crs != stated:
                feedback.pushWarning(f"the terrain is in {crs.userFriendlyIdentifier()}, not in "
                                     f"{stated.userFriendlyIdentifier()}, which is ignored")
            return crs, True
        if stated.isValid():
            return stated, False
        if otherwise is not None and otherwise.isValid():
            feedback.pushWarning("the multitriangulation has no CRS: coordinates are taken as they are, in "
                                 f"{otherwise.userFriendlyIdentifier()}")
            return otherwise, False
        return crs, False

    def name_layer(self, context, destination, name):
        """What the layer is called when QGIS shows the output, unless a name is stated for it."""
        if context.willLoadLayerOnCompletion(destination):
            details = context.layerToLoadOnCompletionDetails(destination)
            if details.name in ("", self.parameterDefinition("OUTPUT").description()):
                details.name = name


def crs_of(model, feedback):
    """That of a model, as it says itself; invalid where it has none."""
    said = run(["info", model, "--curve", "0"], feedback)
    if said.get("crsWkt"):
        crs = QgsCoordinateReferenceSystem.fromWkt(said["crsWkt"])
        if crs.isValid():
            return crs
    number = re.search(r"\(([A-Z]+:\d+)\)$", said.get("crs") or "")
    return QgsCoordinateReferenceSystem(number[1]) if number else QgsCoordinateReferenceSystem()


def title_of(model):
    """A model's name without its folder and extension, for the names of layers."""
    return os.path.splitext(os.path.basename(model))[0]
