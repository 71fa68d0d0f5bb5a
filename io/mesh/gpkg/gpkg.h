// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/mesh/mesh_file.h"

namespace arete {

/// Reads the triangles of a GeoPackage: of the only layer that may hold surfaces, its polygons,
/// multipolygons, triangles, TINs and polyhedral surfaces, each of three corners with heights. Corners at one
/// place become one vertex, numbered in the order in which they come; a numeric field "error" that no feature
/// leaves open is the triangles' error. Errors as readMesh(); unsupported for polygons that are no triangles
/// or have no heights, and for files with several such layers.
Result<MeshFile> readGpkg(const std::filesystem::path& path, const RunContext& context = {});

/// Whether a GeoPackage holds surfaces rather than points or rasters. False for what cannot be opened.
bool holdsSurfaces(const std::filesystem::path& path);

/// Writes a GeoPackage with one layer, "triangles", in options.crsWkt, with a spatial index: a PolygonZ for
/// each triangle, counter-clockwise, its number from 0 in the field "triangle" and its error, where there is
/// one, in "error". The unit of the heights is metadata of the layer. Coordinates are doubles. The same mesh
/// gives the same bytes: the "last change" that the format wants is always the first second of 1970. Errors
/// as writeMesh(); usage for a CRS that GDAL does not understand.
Status writeGpkg(const TriangleMesh& mesh, const std::filesystem::path& path,
                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete
