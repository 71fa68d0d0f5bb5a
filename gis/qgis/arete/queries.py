# SPDX-License-Identifier: GPL-3.0-or-later
"""What is asked of the terrain: heights at points, profiles along lines, lines of sight, what an observer sees."""

import csv

from qgis.core import (QgsFeature, QgsFeatureSink, QgsField, QgsFields, QgsGeometry, QgsPoint, QgsProcessing,
                       QgsProcessingException, QgsProcessingOutputNumber, QgsProcessingParameterEnum,
                       QgsProcessingParameterFeatureSink, QgsProcessingParameterFeatureSource, QgsProcessingParameterField,
                       QgsProcessingParameterFileDestination, QgsProcessingParameterPoint,
                       QgsProcessingParameterRasterDestination, QgsProcessingUtils, QgsWkbTypes)
from qgis.PyQt.QtCore import QVariant

from .algorithm import Algorithm, title_of
from .layers import parts_of, places_of, write_geometries
from .program import run


def fields_of(names):
    """Fields of numbers, but for those whose type is stated: "verdict:text"."""
    types = {"": QVariant.Double, "whole": QVariant.Int, "text": QVariant.String}
    fields = QgsFields()
    for name in names:
        name, _, kind = name.partition(":")
        fields.append(QgsField(name, types[kind]))
    return fields


def value_of(row, field):
    text = row.get(field.name())
    if text in (None, ""):
        return None
    return text if field.type() == QVariant.String else int(text) if field.type() == QVariant.Int else float(text)


class Query(Algorithm):
    GROUP = "Queries"

    def sink(self, parameters, context, fields, kind, crs):
        """A row of the input may have several in the output: keys of the input's table are made anew."""
        sink, destination = self.parameterAsSink(parameters, "OUTPUT", context, fields, kind, crs,
                                                 QgsFeatureSink.RegeneratePrimaryKey)
        if sink is None:
            raise QgsProcessingException(self.invalidSinkError(parameters, "OUTPUT"))
        return sink, destination

    def put(self, sink, parameters, geometry, values):
        feature = QgsFeature()
        if geometry is not None:
            feature.setGeometry(geometry)
        feature.setAttributes(values)
        if not sink.addFeature(feature, QgsFeatureSink.FastInsert):
            raise QgsProcessingException(self.writeFeatureError(sink, parameters, "OUTPUT"))

    def source(self, parameters, name, context):
        source = self.parameterAsSource(parameters, name, context)
        if source is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, name))
        return source


class Heights(Query):
    NAME, TITLE, PICTURE = "heights", "Heights at points", "heights.png"
    HELP = ("The height of the terrain at each point of a layer, in any CRS. The output has the points and their fields, and "
            "<b>height</b>, with <b>below</b> and <b>above</b>: how far the height at full resolution may be below and above "
            "it, 0 unless an error is stated. A point outside the terrain, or on missing data, has no height.")

    def initAlgorithm(self, configuration=None):
        self.model_parameter()
        self.add(QgsProcessingParameterFeatureSource("INPUT", "Points", [QgsProcessing.TypeVectorPoint]))
        self.number("MAX_ERROR", "How far from full resolution a height may be", 0.0, is_advanced=True)
        self.model_crs_parameter()
        self.add(QgsProcessingParameterFeatureSink("OUTPUT", "Heights", QgsProcessing.TypeVectorPoint))
        self.addOutput(QgsProcessingOutputNumber("WITH_HEIGHT", "Points that have a height"))

    def processAlgorithm(self, parameters, context, feedback):
        model = self.model(parameters, context)
        source = self.source(parameters, "INPUT", context)
        crs, _ = self.crs_of_terrain(model, parameters, context, feedback, source.sourceCrs())
        table, answers = (QgsProcessingUtils.generateTempFilename(name) for name in ("points.csv", "heights.csv"))
        asked = []
        with open(table, "w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file)
            rows.writerow(["asked", "x", "y"])
            for feature, point, place in places_of(source, crs, context, feedback):
                rows.writerow([len(asked), *([repr(place.x()), repr(place.y())] if place else ["", ""])])
                asked.append((feature, point))
        fields = fields_of(["height", "below", "above"])
        sink, destination = self.sink(parameters, context, QgsProcessingUtils.combineFields(source.fields(), fields),
                                      QgsWkbTypes.Point, source.sourceCrs())
        self.name_layer(context, destination, f"Heights of {title_of(model)}")
        if not asked:
            feedback.pushWarning("the layer has no points")
            return {"OUTPUT": destination, "WITH_HEIGHT": 0}
        run(["height", model, "--points", table, "-o", answers, "--max-error",
             repr(self.parameterAsDouble(parameters, "MAX_ERROR", context))], feedback)
        found = 0
        for row, (feature, point) in zip(_rows(answers, len(asked)), asked):
            values = [value_of(row, field) for field in fields]
            found += values[0] is not None
            self.put(sink, parameters, point, feature.attributes() + values)
        feedback.pushInfo(f"{found} of {len(asked)} points have a height")
        return {"OUTPUT": destination, "WITH_HEIGHT": found}


class Profile(Query):
    NAME, TITLE, PICTURE = "profile", "Profiles along lines", "profile.png"
    HELP = ("The terrain along each line of a layer, as points with <b>line</b> (counted from 1), <b>part</b>, <b>distance</b> "
            "in metres along the ground, and <b>height</b>: at full resolution one wherever the line crosses an edge of a "
            "triangle, so that straight between them is the surface itself. Where there is no terrain a new part begins.\n"
            "The table makes a chart by itself: distance against height. Of one line a picture is drawn too, if it is asked for.")

    def initAlgorithm(self, configuration=None):
        self.model_parameter()
        self.add(QgsProcessingParameterFeatureSource("INPUT", "Lines", [QgsProcessing.TypeVectorLine]))
        self.number("MAX_ERROR", "Largest error of the profile, in the unit of heights", 0.0, is_advanced=True)
        self.model_crs_parameter()
        self.add(QgsProcessingParameterFeatureSink("OUTPUT", "Profile", QgsProcessing.TypeVectorPoint))
        self.add(QgsProcessingParameterFileDestination("PNG", "Picture of the profile (of one line)", "PNG (*.png)",
                                                       optional=True, createByDefault=False))

    def processAlgorithm(self, parameters, context, feedback):
        model = self.model(parameters, context)
        source = self.source(parameters, "INPUT", context)
        crs, is_known = self.crs_of_terrain(model, parameters, context, feedback, source.sourceCrs())
        lines = [(feature, part) for feature in source.getFeatures() for part in parts_of(feature.geometry())
                 if part.constGet().nCoordinates() > 1]
        if not lines:
            raise QgsProcessingException("the layer has no lines")
        answers = QgsProcessingUtils.generateTempFilename("profile.csv")
        own = source.sourceCrs() if source.sourceCrs().isValid() else crs
        shapes = write_geometries([line for _, line in lines], own, crs, is_known, context)
        words = ["profile", model, "--along", shapes, "-o", answers, "--max-error",
                 repr(self.parameterAsDouble(parameters, "MAX_ERROR", context))]
        results = {}
        if self.stated(parameters, "PNG"):
            results["PNG"] = self.parameterAsFileOutput(parameters, "PNG", context)
            if len(lines) > 1:
                raise QgsProcessingException(f"a picture is drawn of one line, not of {len(lines)}: select one, or leave it out")
            words += ["--png", results["PNG"]]
        fields = fields_of(["line:whole", "part:whole", "distance", "height"])
        sink, destination = self.sink(parameters, context, QgsProcessingUtils.combineFields(source.fields(), fields),
                                      QgsWkbTypes.PointZ, crs)
        self.name_layer(context, destination, f"Profile of {title_of(model)}")
        run(words, feedback)
        for row in _rows(answers):
            values = [value_of(row, field) for field in fields]
            place = QgsPoint(float(row["x"]), float(row["y"]), values[3])
            self.put(sink, parameters, QgsGeometry(place), lines[values[0] - 1][0].attributes() + values)
        return {"OUTPUT": destination, **results}


class SightLines(Query):
    NAME, TITLE, PICTURE = "sightlines", "Lines of sight", "sight.png"
    HELP = ("Whether points see each other: each observer with every target, or the first with the first, the second with the "
            "second and so on. The output is a line for each pair, with the fields of both points, and <b>verdict</b> (visible, "
            "blocked, unknown), <b>distance</b>, <b>azimuth</b>, <b>elevation</b>, <b>clearance</b> and the place of the "
            "obstruction. Over the ellipsoid, with refraction, at full resolution.\n"
            "With a frequency, <b>fresnel</b> says how much of the first Fresnel zone is clear.")
    PAIRS = ["every observer with every target", "the first with the first, the second with the second, ..."]
    ANSWERS = ["verdict:text", "distance", "azimuth", "elevation", "clearance", "obstruction_x", "obstruction_y",
               "obstruction_height", "obstruction_distance", "fresnel", "fresnel_clear:whole", "error:text"]

    def initAlgorithm(self, configuration=None):
        self.model_parameter()
        for name, title, one, height in (("OBSERVERS", "Observers", "observer", 2.0), ("TARGETS", "Targets", "target", 0.0)):
            self.add(QgsProcessingParameterFeatureSource(name, title, [QgsProcessing.TypeVectorPoint]))
            self.number(f"{one.upper()}_HEIGHT", f"Height of each {one} above the ground, in the unit of heights", height, least=None)
            self.add(QgsProcessingParameterField(f"{one.upper()}_FIELD", f"Field with the height of each {one}", None, name,
                                                 QgsProcessingParameterField.Numeric, optional=True), True)
        self.add(QgsProcessingParameterEnum("PAIRS", "Pairs", self.PAIRS, defaultValue=0))
        self.number("FREQUENCY", "Frequency, in MHz", optional=True, is_advanced=True)
        self.model_crs_parameter()
        self.add(QgsProcessingParameterFeatureSink("OUTPUT", "Lines of sight", QgsProcessing.TypeVectorLine))
        self.addOutput(QgsProcessingOutputNumber("VISIBLE", "Pairs that see each other"))

    def processAlgorithm(self, parameters, context, feedback):
        model = self.model(parameters, context)
        observers, targets = (self.source(parameters, name, context) for name in ("OBSERVERS", "TARGETS"))
        crs, _ = self.crs_of_terrain(model, parameters, context, feedback, observers.sourceCrs())
        first = self.ends(observers, "OBSERVER", crs, parameters, context, feedback)
        second = self.ends(targets, "TARGET", crs, parameters, context, feedback)
        if self.parameterAsEnum(parameters, "PAIRS", context) == 0:
            pairs = [(a, b) for a in first for b in second]
        elif len(first) == len(second):
            pairs = list(zip(first, second))
        else:
            raise QgsProcessingException(f"there are {len(first)} observers and {len(second)} targets: of pairs one by one "
                                         "there are as many of both")
        placed = [pair for pair in pairs if None not in (pair[0][1], pair[1][1])]
        if len(placed) < len(pairs):
            feedback.pushWarning(f"{len(pairs) - len(placed)} of {len(pairs)} pairs have an end without a place, and are left out")
        pairs, number = placed, len(placed)
        answers_fields = fields_of(self.ANSWERS)
        fields = QgsProcessingUtils.combineFields(observers.fields(), targets.fields(), "target_")
        sink, destination = self.sink(parameters, context, QgsProcessingUtils.combineFields(fields, answers_fields),
                                      QgsWkbTypes.LineString, crs)
        self.name_layer(context, destination, f"Lines of sight of {title_of(model)}")
        if not number:
            feedback.pushWarning("there are no pairs")
            return {"OUTPUT": destination, "VISIBLE": 0}
        table, answers = (QgsProcessingUtils.generateTempFilename(name) for name in ("pairs.csv", "sight.csv"))
        with open(table, "w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file)
            rows.writerow(["asked", "x1", "y1", "h1", "x2", "y2", "h2"])
            for n, ((_, a, h1), (_, b, h2)) in enumerate(pairs):
                rows.writerow([n, repr(a.x()), repr(a.y()), repr(h1), repr(b.x()), repr(b.y()), repr(h2)])
        run(["los", model, "--pairs", table, "-o", answers,
             *self.option(parameters, context, "FREQUENCY", "--frequency")], feedback)
        visible = 0
        for row, ((one, a, _), (other, b, _)) in zip(_rows(answers, number), pairs):
            values = [value_of(row, field) for field in answers_fields]
            visible += values[0] == "visible"
            line = QgsGeometry.fromPolylineXY([a, b])
            self.put(sink, parameters, line, one.attributes() + other.attributes() + values)
        feedback.pushInfo(f"{visible} of {number} pairs see each other")
        return {"OUTPUT": destination, "VISIBLE": visible}

    def ends(self, source, which, crs, parameters, context, feedback):
        """(feature, place in the terrain's CRS, height) of each point; None where a point has no place there."""
        height = self.parameterAsDouble(parameters, f"{which}_HEIGHT", context)
        field = self.parameterAsString(parameters, f"{which}_FIELD", context)
        index = source.fields().lookupField(field) if field else -1
        ends = []
        for feature, _, place in places_of(source, crs, context, feedback):
            own = feature.attribute(index) if index >= 0 else None
            ends.append((feature, place, float(own) if own not in (None, QVariant()) else height))
        return ends


class Viewshed(Query):
    NAME, TITLE, PICTURE = "viewshed", "Viewshed", "viewshed.png"
    HELP = ("What an observer sees of the terrain at full resolution: 255 seen, 0 hidden, 100 unknown because of missing data. "
            "Over the ellipsoid, with refraction.")

    def initAlgorithm(self, configuration=None):
        self.model_parameter()
        self.add(QgsProcessingParameterPoint("OBSERVER", "Observer"))
        self.model_crs_parameter()
        self.number("HEIGHT", "Height of the observer above the ground", 2.0)
        self.number("TARGET_HEIGHT", "Height of targets above the ground", 0.0)
        self.number("RADIUS", "Radius, in metres", optional=True)
        self.add(QgsProcessingParameterRasterDestination("OUTPUT", "Viewshed"))

    def processAlgorithm(self, parameters, context, feedback):
        model = self.model(parameters, context)
        crs, _ = self.crs_of_terrain(model, parameters, context, feedback,
                                     self.parameterAsPointCrs(parameters, "OBSERVER", context))
        place = self.parameterAsPoint(parameters, "OBSERVER", context, crs)
        height = self.parameterAsDouble(parameters, "HEIGHT", context)
        output = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        self.name_layer(context, output, f"Viewshed of {title_of(model)}")
        run(["viewshed", model, f"--observer={place.x()!r},{place.y()!r},{height!r}", "--target-height",
             repr(self.parameterAsDouble(parameters, "TARGET_HEIGHT", context)), "-o", output,
             *self.option(parameters, context, "RADIUS", "--radius")], feedback)
        return {"OUTPUT": output}


def _rows(path, number=None):
    """The rows of an answer, in the order of the question: as many as were asked."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if number is not None and ([row["asked"] for row in rows] != [str(n) for n in range(number)]):
        raise QgsProcessingException(f"arete answered {len(rows)} rows of {number}")
    return rows
