# SPDX-License-Identifier: GPL-3.0-or-later
"""TINs and rasters that are taken from a multitriangulation: by error and number, by region, for a camera."""

from qgis.core import (QgsProcessing, QgsProcessingException, QgsProcessingOutputNumber, QgsProcessingOutputString,
                       QgsProcessingParameterExtent, QgsProcessingParameterFeatureSource,
                       QgsProcessingParameterPoint, QgsProcessingParameterRasterDestination,
                       QgsProcessingParameterVectorDestination, QgsWkbTypes)

from .algorithm import Algorithm, title_of
from .layers import write_geometries
from .program import run

ENDED_BY = {"maxError": "largest error", "pixelError": "error in the picture", "maxTriangles": "number of triangles"}


class Tin(Algorithm):
    """What the algorithms share that give a layer of triangles."""

    GROUP = "Cuts"

    def tin_outputs(self):
        self.add(QgsProcessingParameterVectorDestination("OUTPUT", "TIN"))
        self.addOutput(QgsProcessingOutputNumber("ERROR", "Error at most"))
        self.addOutput(QgsProcessingOutputNumber("TRIANGLES", "Triangles"))
        self.addOutput(QgsProcessingOutputString("ENDED_BY", "What ended it, of both: maxError or maxTriangles"))

    def supportedOutputVectorLayerExtensions(self):
        return ["gpkg"]

    def extracted(self, parameters, context, feedback, model, words, name):
        output = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        self.name_layer(context, output, name)
        answer = run(["extract", model, "-o", output, *words], feedback)["exports"][0]
        ended = answer.get("endedBy", "")
        if ended:
            feedback.pushInfo("ended by the " + ENDED_BY.get(ended, ended))
        error = answer["storedError"] if "storedError" in answer else answer["error"]  # of terrain, of a surface
        feedback.pushInfo(f"{answer['triangles']} triangles, error at most {error:g}")
        return {"OUTPUT": output, "ERROR": error, "TRIANGLES": answer["triangles"], "ENDED_BY": ended}


class ExtractTin(Tin):
    NAME, TITLE, PICTURE = "extracttin", "Extract a TIN", "tin.png"
    HELP = ("The fewest triangles whose vertical error is nowhere above the tolerance, as a layer of polygons with heights and "
            "their errors; or the best of a number of triangles; or both, and whichever is reached first ends it.")

    def initAlgorithm(self, configuration=None):
        self.model_parameter()
        self.number("MAX_ERROR", "Largest error, in the unit of heights", optional=True)
        self.count("MAX_TRIANGLES", "Triangles at most")
        self.tin_outputs()

    def processAlgorithm(self, parameters, context, feedback):
        model = self.model(parameters, context)
        error = self.option(parameters, context, "MAX_ERROR", "--max-error")
        number = self.option(parameters, context, "MAX_TRIANGLES", "--max-triangles")
        if not error and not number:
            raise QgsProcessingException("state the largest error, the number of triangles, or both")
        limit = f"within {float(error[1]):g}" if error else f"with {number[1]} triangles"
        return self.extracted(parameters, context, feedback, model, error + number, f"TIN of {title_of(model)} {limit}")


class ExtractTinByRegion(Tin):
    NAME, TITLE, PICTURE = "extracttinbyregion", "Extract a TIN by region", "region.png"
    HELP = ("Fine in a region, coarse elsewhere, without a crack between. The region is a layer, of polygons or of lines and "
            "points with a distance along the ground, or a rectangle, or both together. Inside it the vertical error is nowhere "
            "above the tolerance; outside, the error is the one stated for there, or is not limited.\n"
            "A number of triangles ends the refinement, where it is reached before.")

    def initAlgorithm(self, configuration=None):
        self.model_parameter()
        self.add(QgsProcessingParameterFeatureSource("REGION", "Region", [QgsProcessing.TypeVectorAnyGeometry], optional=True))
        self.number("DISTANCE", "Distance around the region, in metres along the ground", optional=True)
        self.add(QgsProcessingParameterExtent("EXTENT", "Rectangle", optional=True))
        self.number("MAX_ERROR", "Largest error in the region, in the unit of heights", 1.0)
        self.number("OUTSIDE_ERROR", "Largest error outside (none: no limit)", optional=True)
        self.count("MAX_TRIANGLES", "Triangles at most")
        self.model_crs_parameter()
        self.tin_outputs()

    def processAlgorithm(self, parameters, context, feedback):
        model = self.model(parameters, context)
        region = self.region(model, parameters, context, feedback)
        words = ["--region", region, "--max-error", repr(self.parameterAsDouble(parameters, "MAX_ERROR", context))]
        for name, word in (("DISTANCE", "--distance"), ("OUTSIDE_ERROR", "--outside-error"), ("MAX_TRIANGLES", "--max-triangles")):
            words += self.option(parameters, context, name, word)
        return self.extracted(parameters, context, feedback, model, words, f"TIN of {title_of(model)} by region")

    def region(self, model, parameters, context, feedback):
        """A file of the layer's shapes and the rectangle."""
        source = self.parameterAsSource(parameters, "REGION", context) if self.stated(parameters, "REGION") else None
        if source is None and not self.stated(parameters, "EXTENT"):
            raise QgsProcessingException("state a region: a layer, a rectangle, or both")
        crs, is_known = self.crs_of_terrain(model, parameters, context, feedback, source.sourceCrs() if source else
                                            self.parameterAsExtentCrs(parameters, "EXTENT", context))
        own = source.sourceCrs() if source is not None and source.sourceCrs().isValid() else crs
        shapes = []
        if source is not None:
            shapes = [feature.geometry() for feature in source.getFeatures() if not feature.geometry().isEmpty()]
            if not shapes:
                raise QgsProcessingException("the layer of the region has no shapes")
        if self.stated(parameters, "EXTENT"):
            box = self.parameterAsExtentGeometry(parameters, "EXTENT", context, own)
            if box.isEmpty() or not box.area() > 0:
                raise QgsProcessingException("the rectangle is empty")
            shapes.append(box)
        is_wide = all(shape.type() == QgsWkbTypes.PolygonGeometry for shape in shapes)
        if not is_wide and not self.parameterAsDouble(parameters, "DISTANCE", context) > 0:
            raise QgsProcessingException("lines and points are no region by themselves: state a distance around them")
        return write_geometries(shapes, own, crs, is_known, context)


class ExtractTinForCamera(Tin):
    NAME, TITLE, PICTURE = "extracttinforcamera", "Extract a TIN for a camera", "camera.png"
    HELP = ("The fewest triangles whose error is nowhere above so many pixels in the picture that a camera takes: fine near "
            "the camera, coarse far away and behind it.\n"
            "A number of triangles ends the refinement, where it is reached before.")

    def initAlgorithm(self, configuration=None):
        self.model_parameter()
        self.add(QgsProcessingParameterPoint("CAMERA", "Position of the camera"))
        self.number("HEIGHT", "Height of the camera above the ground, in the unit of heights", 100.0, least=None)
        self.number("AZIMUTH", "Direction, in degrees clockwise from north", 0.0, least=-360.0, most=360.0)
        self.number("PITCH", "Direction, in degrees above the horizon", -10.0, least=-90.0, most=90.0)
        self.number("FOV", "Vertical field of view, in degrees", 60.0, least=0.1, most=179.0)
        self.number("PIXEL_ERROR", "Largest error, in pixels", 1.0)
        self.count("MAX_TRIANGLES", "Triangles at most")
        self.count("WIDTH", "Width of the picture, in pixels", 1920, is_advanced=True)
        self.count("LENGTH", "Height of the picture, in pixels", 1080, is_advanced=True)
        self.number("OUTSIDE_ERROR", "Largest error out of view (none: no limit)", optional=True, is_advanced=True)
        self.model_crs_parameter()
        self.tin_outputs()

    def processAlgorithm(self, parameters, context, feedback):
        model = self.model(parameters, context)
        crs, _ = self.crs_of_terrain(model, parameters, context, feedback,
                                     self.parameterAsPointCrs(parameters, "CAMERA", context))
        place = self.parameterAsPoint(parameters, "CAMERA", context, crs)
        value = {name: self.parameterAsDouble(parameters, name, context) for name in ("HEIGHT", "AZIMUTH", "PITCH", "FOV")}
        words = [f"--camera={place.x()!r},{place.y()!r},{value['HEIGHT']!r}", f"--look={value['AZIMUTH']!r},{value['PITCH']!r}",
                 "--fov", repr(value["FOV"]), "--viewport",
                 f"{self.parameterAsInt(parameters, 'WIDTH', context)}x{self.parameterAsInt(parameters, 'LENGTH', context)}",
                 "--pixel-error", repr(self.parameterAsDouble(parameters, "PIXEL_ERROR", context))]
        for name, word in (("MAX_TRIANGLES", "--max-triangles"), ("OUTSIDE_ERROR", "--outside-error")):
            words += self.option(parameters, context, name, word)
        return self.extracted(parameters, context, feedback, model, words, f"TIN of {title_of(model)} for a camera")


class ExtractRaster(Algorithm):
    NAME, TITLE, GROUP, PICTURE = "extractraster", "Extract a raster", "Cuts", "raster.png"
    HELP = "The TIN of a tolerance sampled on the grid of the DEM."

    def initAlgorithm(self, configuration=None):
        self.model_parameter()
        self.number("MAX_ERROR", "Largest error, in the unit of heights", 1.0)
        self.add(QgsProcessingParameterRasterDestination("OUTPUT", "Raster"))

    def processAlgorithm(self, parameters, context, feedback):
        model = self.model(parameters, context)
        output = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        error = self.parameterAsDouble(parameters, "MAX_ERROR", context)
        self.name_layer(context, output, f"{title_of(model)} within {error:g}")
        run(["extract", model, "-o", output, "--max-error", repr(error)], feedback)
        return {"OUTPUT": output}
