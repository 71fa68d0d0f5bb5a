// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh is read as one, and where that gives no faces, as points. A text of vertices alone may be an OBJ or
// a text of points: the latter reads both.
#include "io/query/source/source.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/formats/exchange/axes.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/dem/point_reader.h"
#include "io/geo/text/point_text.h"

namespace arete {
namespace {

Result<PointReadOptions> pointOptions(const SourceReading& reading) {
  if (reading.band) return failure(ErrorCode::usage, "is for rasters, and a mesh has no bands", "band");
  if (!reading.layer.empty()) return failure(ErrorCode::usage, "a mesh has no layers", "layer");
  if (!reading.zField.empty())
    return failure(ErrorCode::usage, "the height of a vertex of a mesh is its z", "zField");
  PointReadOptions options{.crs = reading.crs,
                           .nodata = reading.nodata,
                           .verticalUnit = reading.verticalUnit,
                           .isDepth = reading.isDepth};
  if (const auto rule = samePlaceNamed(reading.samePlace)) options.samePlace = *rule;
  return options;
}

Result<DemRead> readVertices(const std::string& path, const SourceReading& reading, MeshFile mesh) {
  ARETE_TRY(PointReadOptions options, pointOptions(reading));
  if (options.verticalUnit.empty()) options.verticalUnit = mesh.verticalUnit;
  if (mesh.up == MeshUp::y) ARETE_CHECK(placeMesh(mesh, {.up = MeshUp::y}, MeshUp::z));
  ARETE_TRY(PointRead points, pointsFrom(mesh.mesh.positions, mesh.crsWkt, path, options));
  DemRead read{std::move(points.heightfield), std::move(mesh.warnings)};
  for (Warning& warning : points.warnings) read.warnings.push_back(std::move(warning));
  return read;
}

/// A text that fills a grid is a raster, unless points are asked for.
Result<DemRead> readHeights(const std::string& path, const SourceOptions& options,
                            const RunContext& context) {
  return (options.kind == "points" ? readDemAsItIs : readDem)(path, options.reading, context);
}

Result<DemRead> readPointsOfMesh(const std::string& path, const SourceOptions& options,
                                 const RunContext& context) {
  Result<MeshFile> mesh = readMeshOrPoints(path, context);
  if (!mesh) {
    if (mesh.error().code == ErrorCode::unsupported && options.kind != "surface" && looksLikePointText(path))
      return readHeights(path, options, context);
    return tl::unexpected(mesh.error());
  }
  if (options.kind == "surface" && mesh->mesh.triangles.empty())
    return failure(ErrorCode::usage, fmt::format("{} has no faces, which a surface needs", path), "kind surface");
  return readVertices(path, options.reading, std::move(*mesh));
}

}  // namespace

bool isMeshSource(const std::string& path, const SourceReading& reading) {
  std::error_code ignored;
  if (!reading.otherFiles.empty() || !std::filesystem::is_regular_file(path, ignored)) return false;
  const Result<MeshFormat> format = meshFormatOf(path);
  return format && format->read && !format->holds.sharesFile;
}

Result<Source> readSource(const std::string& path, const SourceOptions& options,
                          const RunContext& context) try {
  if (!isMeshSource(path, options.reading)) {
    if (options.kind == "surface")
      return failure(ErrorCode::usage, fmt::format("{} is not a mesh", path), "kind surface");
    Result<DemRead> heights = readHeights(path, options, context);
    // A GeoPackage of triangles alone is a mesh.
    if (!heights && options.kind.empty() && options.reading.layer.empty() && isMeshFile(path)) {
      ARETE_TRY(MeshInput input, readMeshInput(path, context));
      ARETE_CHECK(warnOfGaps(input, context));
      return Source(std::move(input));
    }
    ARETE_TRY(DemRead read, std::move(heights));
    if (options.kind == "points" && std::holds_alternative<RasterHeightfield>(read.heightfield))
      return failure(ErrorCode::usage, fmt::format("{} is a raster", path), "kind points");
    return Source(std::move(read));
  }
  if (options.kind.empty() || options.kind == "surface") {
    Result<MeshInput> input = readMeshInput(path, context);
    if (input && !input->file.mesh.triangles.empty()) {
      ARETE_CHECK(warnOfGaps(*input, context));
      return Source(std::move(*input));
    }
  }
  // A mesh without faces, or one that cannot be read, is read anew: the error is that of its points.
  ARETE_TRY(DemRead read, readPointsOfMesh(path, options, context));
  return Source(std::move(read));
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
