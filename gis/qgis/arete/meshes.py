# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangle meshes that are no terrain: made smaller, and compared."""

import re

from qgis.core import (QgsCoordinateReferenceSystem, QgsProcessingContext, QgsProcessingException,
                       QgsProcessingOutputNumber, QgsProcessingParameterEnum, QgsProcessingParameterFile,
                       QgsProcessingParameterFileDestination, QgsProcessingUtils)

from .algorithm import Algorithm, title_of
from .program import run

KINDS = ("ply", "obj", "off", "stl", "glb", "gltf", "2dm", "gpkg")
FILTER = ";;".join(f"{kind.upper()} (*.{kind})" for kind in KINDS)
ALL = f"Triangle meshes ({' '.join('*.' + kind for kind in KINDS)})"
# What QGIS shows; the other formats are for other programs.
SHOWN = {"2dm": QgsProcessingUtils.LayerHint.Mesh, "gpkg": QgsProcessingUtils.LayerHint.Vector}


class Decimate(Algorithm):
    NAME, TITLE, GROUP, PICTURE = "decimatemesh", "Decimate a mesh", "Meshes", "decimate.png"
    HELP = ("Makes a triangle mesh smaller: a scan, a model, a mesh of QGIS (2DM). State the number of triangles, or the "
            "largest distance from the mesh.\n"
            "<b>measured</b> is the closest and measures its error; <b>qem</b> takes a fraction of the time and states none.")
    OPERATORS = ["measured", "qem", "lindstrom-turk", "half-edge", "vertex-pair", "face", "cluster"]
    TAGS = ["arete", "mesh", "decimate", "simplify", "reduce", "scan"]

    def initAlgorithm(self, configuration=None):
        self.add(QgsProcessingParameterFile("INPUT", "Mesh", fileFilter=ALL))
        self.count("MAX_TRIANGLES", "Triangles at most")
        self.number("MAX_ERROR", "Largest distance from the mesh, in its unit", optional=True)
        self.add(QgsProcessingParameterEnum("OPERATOR", "Operator", self.OPERATORS, defaultValue=0))
        self.add(QgsProcessingParameterFileDestination("OUTPUT", "Decimated mesh", FILTER))
        self.addOutput(QgsProcessingOutputNumber("TRIANGLES", "Triangles"))
        self.addOutput(QgsProcessingOutputNumber("ERROR", "Distance from the mesh at most (operator measured)"))

    def processAlgorithm(self, parameters, context, feedback):
        output = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        words = ["mesh", "decimate", self.parameterAsFile(parameters, "INPUT", context), "-o", output, "--operator",
                 self.OPERATORS[self.parameterAsEnum(parameters, "OPERATOR", context)]]
        limits = [*self.option(parameters, context, "MAX_TRIANGLES", "--max-triangles"),
                  *self.option(parameters, context, "MAX_ERROR", "--max-error")]
        if not limits:
            raise QgsProcessingException("state the number of triangles, the largest distance, or both")
        answer = run(words + limits, feedback)
        number = re.search(r"\((EPSG:\d+)\)$", answer.get("crs") or "")
        if number and QgsCoordinateReferenceSystem(number[1]).isGeographic():
            feedback.pushWarning("x and y of the mesh are degrees, beside heights in another unit: its distances mean little. "
                                 "Take a mesh of a DEM in a projected CRS")
        feedback.pushInfo(f"{answer['triangles']} triangles of {answer['trianglesBefore']}")
        hint = SHOWN.get(output.rsplit(".", 1)[-1].lower())
        if hint is not None and context.project() is not None:
            details = QgsProcessingContext.LayerDetails(title_of(output), context.project(), "OUTPUT", hint)
            context.addLayerToLoadOnCompletion(output, details)
        result = {"OUTPUT": output, "TRIANGLES": answer["triangles"]}
        if answer.get("error") is not None:
            feedback.pushInfo(f"no point of the mesh is farther than {answer['error']:g}")
            result["ERROR"] = answer["error"]
        return result


class MeasureMeshes(Algorithm):
    NAME, TITLE, GROUP = "measuremeshes", "Measure the distance between two meshes", "Meshes"
    HELP = ("How far two triangle meshes are from each other, in space: the largest distance, with a certain upper bound, the "
            "mean and the root mean square, from the first to the second and back.")
    TAGS = ["arete", "mesh", "hausdorff", "distance", "compare"]
    NUMBERS = (("MAX_DISTANCE", "Largest distance, at most", "atMost"), ("MEAN_DISTANCE", "Mean distance", "mean"),
               ("RMS_DISTANCE", "Root mean square", "rms"))
    WAYS = (("", " from the first to the second", "fromFirst"), ("_BACK", " from the second to the first", "fromSecond"))

    def initAlgorithm(self, configuration=None):
        self.add(QgsProcessingParameterFile("FIRST", "First mesh", fileFilter=ALL))
        self.add(QgsProcessingParameterFile("SECOND", "Second mesh", fileFilter=ALL))
        for ending, way, _ in self.WAYS:
            for name, title, _ in self.NUMBERS:
                self.addOutput(QgsProcessingOutputNumber(name + ending, title + way))

    def processAlgorithm(self, parameters, context, feedback):
        answer = run(["measure", *(self.parameterAsFile(parameters, name, context) for name in ("FIRST", "SECOND"))], feedback)
        result = {}
        for ending, way, key in self.WAYS:
            for name, title, number in self.NUMBERS:
                result[name + ending] = answer[key][number]
                feedback.pushInfo(f"{title}{way}: {answer[key][number]:g}")
        return result
