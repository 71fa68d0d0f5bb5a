# SPDX-License-Identifier: GPL-3.0-or-later
"""A raster layer of QGIS as words of a command: its file, with the options it is opened with, its band and its CRS."""

import os

from osgeo import gdal
from qgis.core import QgsProcessingException, QgsProcessingUtils

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
