# SPDX-License-Identifier: GPL-3.0-or-later
"""What a program finds in an .amt file through GDAL's driver, as JSON on the last line: PROGRAM MODEL DEM TOLERANCE...
QGIS also writes slopes and contours beside the model.

GDAL_DRIVER_PATH names the driver's folder."""

import json
import os
import sys

program, model, dem = sys.argv[1:4]
tolerances = [float(word) for word in sys.argv[4:]]
found = {}

if program == "rasterio":
    import numpy
    import rasterio
    from rasterio.windows import Window

    with rasterio.open(dem) as source:
        wanted, grid = source.read(1, masked=True).astype("float64").filled(numpy.nan), source.transform
        epsg = source.crs.to_epsg()
    found["off"] = []
    for tolerance in tolerances:
        with rasterio.open(model, TOLERANCE=tolerance) as raster:
            heights = raster.read(1)
            found["off"].append(float(numpy.nanmax(numpy.abs(heights - wanted))))
            part = raster.read(1, window=Window(17, 23, 64, 48))
            found["sameInAWindow"] = bool(numpy.array_equal(part, heights[23:71, 17:81]))
            small = raster.read(1, out_shape=(32, 40))
            found["small"] = [float(numpy.nanmin(small)), float(numpy.nanmax(small))]
            found["masked"] = bool((raster.read_masks(1) == 0).sum() == numpy.isnan(heights).sum())
            found["sameGrid"] = raster.transform == grid and heights.shape == wanted.shape
            found["epsg"] = [raster.crs.to_epsg(), epsg]
elif program == "geopandas":
    import fiona
    import geopandas

    fiona.drvsupport.supported_drivers["AMT"] = "r"  # it has a list of its own
    found["features"], found["largestError"] = [], []
    for tolerance in tolerances:
        frame = geopandas.read_file(model, TOLERANCE=str(tolerance))
        found["features"].append(len(frame))
        found["largestError"].append(float(frame["error"].max()))
        found["hasHeights"] = bool(frame.geometry.has_z.all())
        found["epsg"] = frame.crs.to_epsg()
elif program == "xarray":
    import rioxarray
    import xarray

    array = rioxarray.open_rasterio(model)
    assert isinstance(array, xarray.DataArray)
    found.update(shape=list(array.shape), epsg=array.rio.crs.to_epsg(),
                 heights=[float(array.min()), float(array.max())])
elif program == "qgis":
    from qgis.core import QgsApplication, QgsRasterBandStats, QgsRasterLayer, QgsVectorLayer

    application = QgsApplication([], False)
    application.initQgis()
    found["heights"], found["features"] = [], []
    for tolerance in tolerances:
        raster = QgsRasterLayer(f"{model}|option:TOLERANCE={tolerance}", "heights", "gdal")
        layer = QgsVectorLayer(f"{model}|option:TOLERANCE={tolerance}|layername=triangles", "triangles", "ogr")
        found.update(valid=found.get("valid", True) and raster.isValid() and layer.isValid(),
                     crs=[raster.crs().authid(), layer.crs().authid()], size=[raster.width(), raster.height()])
        statistics = raster.dataProvider().bandStatistics(1, QgsRasterBandStats.Min | QgsRasterBandStats.Max)
        found["heights"].append([statistics.minimumValue, statistics.maximumValue])
        found["features"].append(layer.featureCount())
    sys.path.append("/usr/share/qgis/python/plugins")
    import processing
    from processing.core.Processing import Processing
    from qgis.analysis import QgsNativeAlgorithms

    QgsApplication.processingRegistry().addProvider(QgsNativeAlgorithms())
    Processing.initialize()
    folder = os.path.dirname(model)
    processing.run("native:slope", {"INPUT": model, "Z_FACTOR": 1, "OUTPUT": f"{folder}/slope.tif"})
    processing.run("gdal:contour", {"INPUT": model, "BAND": 1, "INTERVAL": 10 * tolerances[1],
                                    "OUTPUT": f"{folder}/contours.gpkg"})
    slope, lines = QgsRasterLayer(f"{folder}/slope.tif"), QgsVectorLayer(f"{folder}/contours.gpkg")
    steepest = slope.dataProvider().bandStatistics(1, QgsRasterBandStats.Max).maximumValue
    found.update(slopeSize=[slope.width(), slope.height()], steepest=steepest, contours=lines.featureCount())

print(json.dumps(found))
sys.stdout.flush()
os._exit(0)  # QGIS 3.22 sometimes crashes while it takes its layers down
