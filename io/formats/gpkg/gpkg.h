// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/formats/common/file.h"

namespace arete {

/// Reads the triangles of a GeoPackage: the polygons, multipolygons, triangles, TINs and polyhedral surfaces
/// of its layer "triangles" if writeGpkg() made that, else of its only layer that may hold surfaces, with
/// heights. Polygons, with holes or without, are triangulated (io/formats/common/polygon.h). Corners at equal
/// positions become one vertex, in the order of first occurrence. A numeric field "error" that is set in
/// every feature gives the errors of the triangles.
///
/// Errors: those of readMesh(). unsupported: also polygons without heights, polygons with holes whose rings
/// cross, and several layers of surfaces.
Result<MeshFile> readGpkg(const std::filesystem::path& path, const RunContext& context = {});

/// @return True if a GeoPackage holds surfaces and no points, or a layer that writeGpkg() made. False if it
/// cannot be opened.
bool holdsSurfaces(const std::filesystem::path& path);

/// Writes a GeoPackage with one layer, "triangles", in options.crsWkt, with a spatial index. Each triangle is
/// a counter-clockwise PolygonZ of doubles with its index in the field "triangle" and, given
/// options.triangleErrors, its error in "error". The vertical unit is metadata of the layer. The same mesh
/// gives the same bytes: the time of the last change, which the format requires, is always the first second
/// of 1970. A file that exists keeps its other layers (options.existing).
///
/// Errors: those of writeMesh() and writeGeoPackage(). usage: a CRS that GDAL does not understand.
Result<MeshWriteReport> writeGpkg(MeshRef mesh, const std::filesystem::path& path,
                                  const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete
