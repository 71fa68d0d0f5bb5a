# SPDX-License-Identifier: GPL-3.0-or-later
"""What GDAL and PROJ find in a file, as JSON: dem FILE | tif FILE DEM | gpkg FILE | glb FILE GPKG.
place FROM TO EPSG ULX ULY LRX LRY puts a raster elsewhere, for open_elsewhere.py."""

import json
import struct
import sys

import numpy
from osgeo import gdal, ogr, osr

gdal.UseExceptions()
ogr.UseExceptions()
osr.UseExceptions()


def epsg_of(crs):
    return int(crs.GetAuthorityCode(None)) if crs and crs.GetAuthorityCode(None) else None


def heights_of(dataset):
    band = dataset.GetRasterBand(1)
    heights, nodata = band.ReadAsArray().astype(float), band.GetNoDataValue()
    if nodata is not None:
        heights[heights == nodata] = numpy.nan
    return heights


def dem(path):
    dataset = gdal.Open(path)
    g, heights = dataset.GetGeoTransform(), heights_of(dataset)
    ends = [(g[0] + g[1] * (c + 0.5) + g[2] * (r + 0.5), g[3] + g[4] * (c + 0.5) + g[5] * (r + 0.5))
            for c in (0, dataset.RasterXSize - 1) for r in (0, dataset.RasterYSize - 1)]
    xs, ys = zip(*ends)
    return {"extent": [min(xs), min(ys), max(xs), max(ys)], "epsg": epsg_of(dataset.GetSpatialRef()),
            "heights": [float(numpy.nanmin(heights)), float(numpy.nanmax(heights))]}


def tif(path, source):
    made, origin = gdal.Open(path), gdal.Open(source)
    heights, expected = heights_of(made), heights_of(origin)
    return {"sameGrid": heights.shape == expected.shape and made.GetGeoTransform() == origin.GetGeoTransform(),
            "epsg": epsg_of(made.GetSpatialRef()),
            "nodata": int(numpy.isnan(heights[~numpy.isnan(expected)]).sum()),
            "largestError": float(numpy.nanmax(numpy.abs(heights - expected)))}


def gpkg(path):
    dataset = ogr.Open(path)
    layer = dataset.GetLayer(0)
    heights, area, largest, open_rings, features = [], 0.0, 0.0, 0, 0
    for feature in layer:
        features += 1
        ring = feature.GetGeometryRef().GetGeometryRef(0)
        points = ring.GetPoints()
        open_rings += len(points) != 4 or points[0] != points[3]
        heights += [points[0][2], points[1][2], points[2][2]]
        (ax, ay), (bx, by), (cx, cy) = (p[:2] for p in points[:3])
        area += ((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2  # counter-clockwise: positive
        largest = max(largest, feature.GetField("error"))
    xmin, xmax, ymin, ymax = layer.GetExtent()
    return {"features": features, "epsg": epsg_of(layer.GetSpatialRef()), "extent": [xmin, ymin, xmax, ymax],
            "geometry": ogr.GeometryTypeToName(layer.GetGeomType()), "heights": [min(heights), max(heights)],
            "area": area, "largestError": largest, "openRings": open_rings}


def glb_positions(path):
    """The first primitive's positions, and what the file says of its frame."""
    with open(path, "rb") as file:
        content = file.read()
    length = struct.unpack_from("<I", content, 12)[0]
    scene = json.loads(content[20:20 + length])
    accessor = scene["accessors"][scene["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
    view = scene["bufferViews"][accessor["bufferView"]]
    begin = 20 + length + 8 + view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    positions = numpy.frombuffer(content, "<f4", accessor["count"] * 3, begin).reshape(-1, 3).astype(float)
    return positions, scene["asset"]["extras"]["arete"]


def glb(path, triangles):
    positions, frame = glb_positions(path)
    layer = ogr.Open(triangles)
    crs = layer.GetLayer(0).GetSpatialRef()
    corners = sorted({point for feature in layer.GetLayer(0)
                      for point in feature.GetGeometryRef().GetGeometryRef(0).GetPoints()[:3]})
    corners, origin = numpy.array(corners), numpy.array(frame["origin"])
    if crs.IsGeographic():
        # PROJ turns longitude, latitude, height into geocentric metres; east, north, up at the origin turn those.
        ellipsoid, geocentric = osr.SpatialReference(), osr.SpatialReference()
        ellipsoid.ImportFromEPSG(4979)
        ellipsoid.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
        geocentric.ImportFromEPSG(4978)
        change = osr.CoordinateTransformation(ellipsoid, geocentric)
        there = numpy.array(change.TransformPoints([tuple(c) for c in corners]))
        lon, lat = numpy.radians(origin[:2])
        turn = numpy.array([[-numpy.sin(lon), numpy.cos(lon), 0],
                            [-numpy.sin(lat) * numpy.cos(lon), -numpy.sin(lat) * numpy.sin(lon), numpy.cos(lat)],
                            [numpy.cos(lat) * numpy.cos(lon), numpy.cos(lat) * numpy.sin(lon), numpy.sin(lat)]])
        expected = (there - numpy.array(change.TransformPoint(*origin))) @ turn.T
    else:
        expected = corners - origin
    expected = expected[:, [0, 2, 1]] * [1, 1, -1]  # x = east, y = up, z = south
    if len(expected) != len(positions):
        return {"farthestMetres": float("inf"), "frame": frame["frame"]}
    # Vertices stand in an order of their own: each finds its partner by place.
    farthest = 0.0
    cells = {}
    for point in expected:
        cells.setdefault((int(point[0] // 10), int(point[2] // 10)), []).append(point)
    for point in positions:
        x, z = int(point[0] // 10), int(point[2] // 10)
        close = [numpy.abs(q - point).max() for i in (-1, 0, 1) for k in (-1, 0, 1) for q in cells.get((x + i, z + k), ())]
        farthest = max(farthest, min(close, default=float("inf")))
    return {"farthestMetres": float(farthest), "frame": frame["frame"]}


def place(source, target, epsg, *box):
    gdal.Translate(target, source, outputSRS=f"EPSG:{epsg}", outputBounds=[float(number) for number in box])
    return {}


if __name__ == "__main__":
    kinds = {"dem": dem, "tif": tif, "gpkg": gpkg, "glb": glb, "place": place}
    print(json.dumps(kinds[sys.argv[1]](*sys.argv[2:])))
