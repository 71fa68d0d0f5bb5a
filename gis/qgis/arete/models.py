# SPDX-License-Identifier: GPL-3.0-or-later
"""Multitriangulations: building one, and the check of a TIN that was taken from it."""

from qgis.core import (QgsProcessingOutputNumber, QgsProcessingParameterBoolean, QgsProcessingParameterEnum,
                       QgsProcessingParameterFile, QgsProcessingParameterFileDestination)

from .algorithm import Algorithm
from .program import run

MODEL = "Multitriangulation (*.amt)"


class Build(Algorithm):
    NAME, TITLE, GROUP, PICTURE = "build", "Build a multitriangulation", "Multitriangulation", "levels.png"
    HELP = ("Builds the multitriangulation of a DEM, once. Triangle meshes and rasters of every tolerance are then taken from "
            "the file without the DEM.\n"
            "<b>fidelity</b> has a third fewer triangles at the same error than <b>delaunay</b>, whose triangles have "
            "larger angles. A packed file has a tenth of the bytes; its heights are rounded within what info says.")
    SHAPES = ["delaunay", "fidelity"]

    def initAlgorithm(self, configuration=None):
        self.dem_parameter("INPUT")
        self.add(QgsProcessingParameterEnum("SHAPE", "Shape of the triangles", self.SHAPES, defaultValue=0))
        self.add(QgsProcessingParameterBoolean("PACKED", "Packed: a tenth of the bytes", False), True)
        self.add(QgsProcessingParameterFileDestination("OUTPUT", "Multitriangulation", MODEL))

    def processAlgorithm(self, parameters, context, feedback):
        dem = self.dem(parameters, "INPUT", context)
        output = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        words = ["build", *dem, "-o", output, "--shape", self.SHAPES[self.parameterAsEnum(parameters, "SHAPE", context)]]
        if self.parameterAsBoolean(parameters, "PACKED", context):
            words.append("--packed")
        run(words, feedback)
        return {"OUTPUT": output}


class Measure(Algorithm):
    NAME, TITLE, GROUP = "measure", "Measure a TIN against a DEM", "Multitriangulation"
    HELP = "The vertical error of a TIN at every sample of a DEM, by code that the build does not share."

    def initAlgorithm(self, configuration=None):
        self.add(QgsProcessingParameterFile("TIN", "TIN (ply, obj, gpkg, ...)"))
        self.dem_parameter("DEM")
        for name, title in (("MAX_ERROR", "Largest error"), ("RMS_ERROR", "Root mean square")):
            self.addOutput(QgsProcessingOutputNumber(name, title))

    def processAlgorithm(self, parameters, context, feedback):
        dem = self.dem(parameters, "DEM", context)
        answer = run(["measure", self.parameterAsFile(parameters, "TIN", context), *dem], feedback)
        error = answer["error"]
        feedback.pushInfo(f"largest error {error['maximum']:g}, root mean square {error['rms']:g}")
        return {"MAX_ERROR": error["maximum"], "RMS_ERROR": error["rms"]}
