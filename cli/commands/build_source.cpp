// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/build_source.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <variant>

#include "cli/surface/build.h"
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

/// A text that fills a grid is a raster, unless points are asked for.
DemArguments sourceOf(DemArguments dem, const std::string& kind) {
  dem.staysPoints = kind == "points";
  return dem;
}

Result<DemRead> readVertices(const DemArguments& dem, MeshFile mesh, Session& session) {
  ARETE_TRY(PointReadOptions options, pointOptions(dem.reading));
  if (options.verticalUnit.empty()) options.verticalUnit = mesh.verticalUnit;
  session.warn(mesh.warnings, dem.path);
  if (mesh.up == MeshUp::y) ARETE_CHECK(placeMesh(mesh, {.up = MeshUp::y}, MeshUp::z));
  Result<PointRead> points = pointsFrom(mesh.mesh.positions, mesh.crsWkt, dem.path, options);
  if (!points) {
    if (!dem.reading.crs.empty() && points.error().culprit == dem.reading.crs)
      points.error().culprit = fmt::format("--crs {}", dem.reading.crs);
    return tl::unexpected(points.error());
  }
  session.warn(points->warnings, dem.path);
  return DemRead{std::move(points->heightfield), {}};
}

}  // namespace

bool isMesh(const DemArguments& dem) {
  std::error_code ignored;
  if (!dem.reading.otherFiles.empty() || !std::filesystem::is_regular_file(dem.path, ignored)) return false;
  const Result<MeshFormat> format = meshFormatOf(dem.path);
  return format && format->read && !format->holds.sharesFile;
}

Result<DemRead> readSource(const DemArguments& dem, const std::string& kind, Session& session) {
  if (isMesh(dem)) {
    Result<MeshFile> mesh = readMeshOrPoints(dem.path, session.context());
    if (!mesh) {
      // A text of vertices alone reads as a text of points.
      if (mesh.error().code == ErrorCode::unsupported && kind != "surface" && looksLikePointText(dem.path))
        return sourceOf(dem, kind).read(session);
      return tl::unexpected(mesh.error());
    }
    const bool hasFaces = !mesh->mesh.triangles.empty();
    if (kind == "surface" && !hasFaces)
      return failure(ErrorCode::usage, fmt::format("{} has no faces: it is no surface", dem.path),
                     "--as surface");
    return readVertices(dem, std::move(*mesh), session);
  }
  if (kind == "surface")
    return failure(ErrorCode::usage, fmt::format("{} is no mesh", dem.path), "--as surface");
  Result<DemRead> read = sourceOf(dem, kind).read(session);
  if (read && kind == "points" && std::holds_alternative<RasterHeightfield>(read->heightfield))
    return failure(ErrorCode::usage, fmt::format("{} is a raster", dem.path), "--as points");
  return read;
}

ExpectedAmtSize announceSize(const DemRead& dem, const std::string& output, bool isPacked, Session& session) {
  const ExpectedAmtSize size =
      std::visit([](const auto& field) { return expectedAmtSize(field); }, dem.heightfield);
  announceSize(size, output, isPacked, session);
  return size;
}

}  // namespace arete
