# SPDX-License-Identifier: GPL-3.0-or-later
"""Layers of QGIS as a command takes them: a raster by its file, options, band and CRS; shapes and places as files."""

import math
import os

from osgeo import gdal, ogr, osr
from qgis.core import QgsCoordinateTransform, QgsCsException, QgsGeometry, QgsPointXY, QgsProcessingException, QgsProcessingUtils

AUTHORITIES = ("EPSG:", "ESRI:", "OGC:", "IAU", "IGNF:")  # whose numbers PROJ knows


def words_of(layer, band=None):
    """The path and the options of a raster layer. A layer with options of its own is named by a VRT, which holds them."""
    if layer is None or not layer.isValid() or layer.dataProvider().name() != "gdal":
        raise QgsProcessingException("GDAL cannot read the DEM as a raster")
    words = [_path_of(layer)]
    if band and band != 1:
        words += ["--band", band]
    crs = layer.crs()
    # The file's own is left to the program, which also reads its vertical part.
    if crs.isValid() and crs != layer.dataProvider().crs():
        words += ["--crs", crs_text(crs)]
    return words


def crs_text(crs):
    """By its number where PROJ knows it; QGIS numbers CRS of its users too."""
    return crs.authid() if crs.authid().startswith(AUTHORITIES) else crs.toWkt(crs.WKT_PREFERRED)


def _path_of(layer):
    source = layer.source()
    if "|" not in source or os.path.exists(source):
        return source
    path, *parts = source.split("|")
    options = [part[len("option:"):] for part in parts if part.startswith("option:")]
    for part in parts:
        if part.startswith("layername=") and path.lower().endswith(".gpkg"):
            path = f"GPKG:{path}:{part[len('layername='):]}"
        elif not part.startswith("option:") and not part.startswith("layername="):
            raise QgsProcessingException(f"the layer {layer.name()} has the source {source}, of which the part \"{part}\" is "
                                         "not understood; export it as a GeoTIFF")
    if not options:
        return path
    opened = gdal.OpenEx(path, gdal.OF_RASTER, open_options=options)
    if opened is None:
        raise QgsProcessingException(f"GDAL does not open the layer {layer.name()}, {source}")
    name = os.path.splitext(os.path.basename(path))[0] or "layer"
    described = os.path.join(QgsProcessingUtils.generateTempFilename(name) + ".vrt")
    if gdal.GetDriverByName("VRT").CreateCopy(described, opened) is None:
        raise QgsProcessingException(f"the layer {layer.name()} cannot be described in {described}")
    return described


def parts_of(geometry):
    """The single points or lines of a geometry, without curves."""
    if geometry.isNull() or geometry.isEmpty():
        return []
    parts = [QgsGeometry(part.clone()) for part in geometry.constParts()]
    return [QgsGeometry(part.constGet().segmentize()) for part in parts if not part.isEmpty()]


def places_of(source, crs, context, feedback):
    """(feature, its point, the place of that in crs) of each point of a source; None for what there is not.

    Without a CRS on either side coordinates are taken as they are. A feature of several points comes once for each."""
    same = not crs.isValid() or not source.sourceCrs().isValid() or crs == source.sourceCrs()
    transform = None if same else QgsCoordinateTransform(source.sourceCrs(), crs, context.transformContext())
    lost = 0
    for feature in source.getFeatures():
        if feedback.isCanceled():
            raise QgsProcessingException("canceled")
        points = parts_of(feature.geometry())
        if not points:
            yield feature, None, None
        for point in points:
            place = QgsPointXY(point.constGet().x(), point.constGet().y())
            try:
                place = transform.transform(place) if transform else place
            except QgsCsException:
                place = None
            if place is not None and not (math.isfinite(place.x()) and math.isfinite(place.y())):
                place = None
            lost += place is None
            yield feature, point, place
    if lost:
        feedback.pushWarning(f"{lost} points have no place in {crs.userFriendlyIdentifier()}")


def write_geometries(geometries, crs, terrain, is_known, context):
    """A GeoPackage with these shapes, one after the other, in their CRS, from which the program brings them into that of the
    terrain. Where the program does not know that one (is_known), it is done here, and the file has no CRS."""
    path = QgsProcessingUtils.generateTempFilename("shapes.gpkg")
    reference, transform = None, None
    if not is_known and crs.isValid() and terrain.isValid() and crs != terrain:
        transform = QgsCoordinateTransform(crs, terrain, context.transformContext())
    if is_known and crs.isValid():
        reference = osr.SpatialReference()
        reference.ImportFromWkt(crs.toWkt(crs.WKT_PREFERRED))
        reference.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    file = ogr.GetDriverByName("GPKG").CreateDataSource(path)
    layer = file.CreateLayer("shapes", reference, ogr.wkbUnknown) if file is not None else None
    if layer is None:
        raise QgsProcessingException(f"{path} cannot be written")
    layer.StartTransaction()
    for geometry in geometries:
        feature = ogr.Feature(layer.GetLayerDefn())
        straight = QgsGeometry(geometry.constGet().segmentize())
        if transform is not None:
            try:
                straight.transform(transform)
            except QgsCsException as error:
                raise QgsProcessingException(f"a shape has no place in {terrain.userFriendlyIdentifier()}") from error
        feature.SetGeometryDirectly(ogr.CreateGeometryFromWkb(bytes(straight.asWkb())))
        if layer.CreateFeature(feature) != 0:
            raise QgsProcessingException(f"{path} cannot be written")
    layer.CommitTransaction()
    file = layer = None
    return path
