# SPDX-License-Identifier: GPL-3.0-or-later
"""Each algorithm is a command of arete; its parameters are options of that command."""

import re

from qgis.core import (QgsCoordinateReferenceSystem, QgsProcessingAlgorithm, QgsProcessingException, QgsProcessingOutputNumber,
                       QgsProcessingOutputString, QgsProcessingParameterBand, QgsProcessingParameterCrs,
                       QgsProcessingParameterEnum, QgsProcessingParameterFile, QgsProcessingParameterFileDestination,
                       QgsProcessingParameterNumber, QgsProcessingParameterPoint, QgsProcessingParameterRasterDestination,
                       QgsProcessingParameterRasterLayer, QgsProcessingParameterVectorDestination)

from .layers import words_of
from .program import run

MODEL = "Multitriangulation (*.amt)"


class Algorithm(QgsProcessingAlgorithm):
    """What the algorithms share: they are made anew for every run, and their texts are class attributes."""

    NAME = TITLE = HELP = ""

    def createInstance(self):
        return type(self)()

    def name(self):
        return self.NAME

    def displayName(self):
        return self.TITLE

    def shortHelpString(self):
        return self.HELP

    def model_parameter(self):
        self.addParameter(QgsProcessingParameterFile("MODEL", "Multitriangulation", extension="amt"))

    def number(self, name, title, default=None, optional=False, least=0.0):
        parameter = QgsProcessingParameterNumber(name, title, QgsProcessingParameterNumber.Double, default, optional, least)
        self.addParameter(parameter)

    def dem_parameter(self, name):
        self.addParameter(QgsProcessingParameterRasterLayer(name, "DEM"))
        self.addParameter(QgsProcessingParameterBand("BAND", "Band", 1, name, optional=True))

    def dem(self, parameters, name, context):
        band = self.parameterAsInt(parameters, "BAND", context) if self.stated(parameters, "BAND") else None
        return words_of(self.parameterAsRasterLayer(parameters, name, context), band)

    def stated(self, parameters, name):
        return parameters.get(name) not in (None, "")


class Build(Algorithm):
    NAME, TITLE = "build", "Build a multitriangulation"
    HELP = ("Builds the multitriangulation of a DEM, once. Triangle meshes and rasters of every tolerance are then taken from "
            "the file without the DEM.")
    SHAPES = ["delaunay", "fidelity"]

    def initAlgorithm(self, configuration=None):
        self.dem_parameter("INPUT")
        self.addParameter(QgsProcessingParameterEnum("SHAPE", "Shape of the triangles", self.SHAPES, defaultValue=0))
        self.addParameter(QgsProcessingParameterFileDestination("OUTPUT", "Multitriangulation", MODEL))

    def processAlgorithm(self, parameters, context, feedback):
        dem = self.dem(parameters, "INPUT", context)
        output = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        shape = self.SHAPES[self.parameterAsEnum(parameters, "SHAPE", context)]
        run(["build", *dem, "-o", output, "--shape", shape], feedback)
        return {"OUTPUT": output}


class ExtractTin(Algorithm):
    NAME, TITLE = "extracttin", "Extract a TIN"
    HELP = ("The fewest triangles whose vertical error is nowhere above the tolerance, as a layer of polygons with heights and "
            "their errors; or the best of a number of triangles; or both, and whichever is reached first ends it.")

    def initAlgorithm(self, configuration=None):
        self.model_parameter()
        self.number("MAX_ERROR", "Largest error, in the unit of heights", optional=True)
        self.addParameter(QgsProcessingParameterNumber("MAX_TRIANGLES", "Triangles at most",
                                                       QgsProcessingParameterNumber.Integer, optional=True, minValue=1))
        self.addParameter(QgsProcessingParameterVectorDestination("OUTPUT", "TIN"))
        self.addOutput(QgsProcessingOutputNumber("ERROR", "Error at most"))
        self.addOutput(QgsProcessingOutputNumber("TRIANGLES", "Triangles"))
        self.addOutput(QgsProcessingOutputString("ENDED_BY", "What ended it, of both: maxError or maxTriangles"))

    def supportedOutputVectorLayerExtensions(self):
        return ["gpkg"]

    def processAlgorithm(self, parameters, context, feedback):
        output = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        words = ["extract", self.parameterAsFile(parameters, "MODEL", context), "-o", output]
        if self.stated(parameters, "MAX_ERROR"):
            words += ["--max-error", self.parameterAsDouble(parameters, "MAX_ERROR", context)]
        if self.stated(parameters, "MAX_TRIANGLES"):
            words += ["--max-triangles", self.parameterAsInt(parameters, "MAX_TRIANGLES", context)]
        if len(words) == 4:
            raise QgsProcessingException("state the largest error, the number of triangles, or both")
        answer = run(words, feedback)["exports"][0]
        ended = answer.get("endedBy", "")
        if ended:
            feedback.pushInfo("ended by the " + {"maxError": "largest error",
                                                 "maxTriangles": "number of triangles"}.get(ended, ended))
        return {"OUTPUT": output, "ERROR": answer["storedError"], "TRIANGLES": answer["triangles"], "ENDED_BY": ended}


class ExtractRaster(Algorithm):
    NAME, TITLE = "extractraster", "Extract a raster"
    HELP = "The TIN of a tolerance sampled on the grid of the DEM."

    def initAlgorithm(self, configuration=None):
        self.model_parameter()
        self.number("MAX_ERROR", "Largest error, in the unit of heights", 1.0)
        self.addParameter(QgsProcessingParameterRasterDestination("OUTPUT", "Raster"))

    def processAlgorithm(self, parameters, context, feedback):
        output = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        run(["extract", self.parameterAsFile(parameters, "MODEL", context), "-o", output, "--max-error",
             self.parameterAsDouble(parameters, "MAX_ERROR", context)], feedback)
        return {"OUTPUT": output}


class Measure(Algorithm):
    NAME, TITLE = "measure", "Measure a TIN against a DEM"
    HELP = "The vertical error of a TIN at every sample of a DEM, by code that the build does not share."

    def initAlgorithm(self, configuration=None):
        self.addParameter(QgsProcessingParameterFile("TIN", "TIN (ply, obj, gpkg, ...)"))
        self.dem_parameter("DEM")
        for name, title in (("MAX_ERROR", "Largest error"), ("RMS_ERROR", "Root mean square")):
            self.addOutput(QgsProcessingOutputNumber(name, title))

    def processAlgorithm(self, parameters, context, feedback):
        dem = self.dem(parameters, "DEM", context)
        answer = run(["measure", self.parameterAsFile(parameters, "TIN", context), *dem], feedback)
        return {"MAX_ERROR": answer["error"]["maximum"], "RMS_ERROR": answer["error"]["rms"]}


class Viewshed(Algorithm):
    NAME, TITLE = "viewshed", "Viewshed"
    HELP = ("What an observer sees of the terrain at full resolution: 255 seen, 0 hidden, 100 unknown because of missing data. "
            "Over the ellipsoid, with refraction.")

    def initAlgorithm(self, configuration=None):
        self.model_parameter()
        self.addParameter(QgsProcessingParameterPoint("OBSERVER", "Observer"))
        self.addParameter(QgsProcessingParameterCrs("CRS", "CRS of the terrain, where the multitriangulation has none",
                                                    optional=True))
        self.number("HEIGHT", "Height of the observer above the ground", 2.0)
        self.number("TARGET_HEIGHT", "Height of targets above the ground", 0.0)
        self.number("RADIUS", "Radius, in metres", optional=True)
        self.addParameter(QgsProcessingParameterRasterDestination("OUTPUT", "Viewshed"))

    def processAlgorithm(self, parameters, context, feedback):
        model = self.parameterAsFile(parameters, "MODEL", context)
        crs = self.crs_of(model, feedback)
        stated = self.parameterAsCrs(parameters, "CRS", context)
        if crs.isValid() and stated.isValid() and crs != stated:
            feedback.pushWarning(f"the terrain is in {crs.userFriendlyIdentifier()}, not in {stated.userFriendlyIdentifier()}, "
                                 "which is ignored")
        crs = crs if crs.isValid() else stated
        place = self.parameterAsPoint(parameters, "OBSERVER", context, crs)
        height = self.parameterAsDouble(parameters, "HEIGHT", context)
        output = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        words = ["viewshed", model, "--observer",
                 f"{place.x()!r},{place.y()!r},{height!r}", "--target-height",
                 self.parameterAsDouble(parameters, "TARGET_HEIGHT", context), "-o", output]
        if self.stated(parameters, "RADIUS"):
            words += ["--radius", self.parameterAsDouble(parameters, "RADIUS", context)]
        run(words, feedback)
        return {"OUTPUT": output}

    def crs_of(self, model, feedback):
        """That of a model, as it says itself; invalid where it has none."""
        said = run(["info", model], feedback)
        if said.get("crsWkt"):
            return QgsCoordinateReferenceSystem.fromWkt(said["crsWkt"])
        number = re.search(r"\(([A-Z]+:\d+)\)$", said.get("crs") or "")
        return QgsCoordinateReferenceSystem(number[1]) if number else QgsCoordinateReferenceSystem()
