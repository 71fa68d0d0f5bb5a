// SPDX-License-Identifier: GPL-3.0-or-later
//
// Errors are in the unit of the heights, which a metric target changes to metres: all figures for bending are
// in the target's unit, and the report is in the source's.
#include "io/formats/exchange/placed_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/base/float_bounds.h"
#include "io/geo/bent/bend.h"
#include "io/geo/bent/place_map.h"
#include "io/geo/crs/local_origin.h"
#include "io/geo/crs/names.h"

namespace arete {
namespace {

constexpr double kLeastMetres = 1e-3;  // no edge is split for less

std::string noteOfBending(const std::string& target, double added) {
  return fmt::format("arete: led into {}, which adds at most {:.6g} to the error", target, added);
}

std::string noteOfMetres(const Georeference& source, const Vec3& origin) {
  return source.isGeographic ? fmt::format("arete: x east, y north, z up in metres about {}, {}, {} of {}",
                                           origin.x, origin.y, origin.z, crsName(source.crsWkt))
                             : fmt::format("arete: x, y and z of the map in metres about {}, {}, {} of {}",
                                           origin.x, origin.y, origin.z, crsName(source.crsWkt));
}

}  // namespace

void PlacedMesh::describe(MeshWriteOptions& options) const {
  options.crsWkt = crsWkt;
  options.verticalUnit = verticalUnit;
  options.verticalUnitMetres = verticalUnitMetres;
  if (!options.triangleErrors.empty()) options.triangleErrors = errors;
  options.origin = origin;
  options.metresAbout = metresAbout;
  options.up = MeshUp::z;
  if (!note.empty()) options.notes.push_back(note);
}

Status checkPlacing(const PlaceTarget& target, const MeshFormat& format) {
  if (target.isMetric && format.holds.sharesFile)
    return failure(
        ErrorCode::usage,
        fmt::format(
            "is not a frame of a map, which a {} holds; `toCrs` with the value utm gives it a CRS in metres",
            format.name),
        "metric");
  return {};
}

Result<PlacedMesh> placeInTarget(const TriangleMesh& mesh, std::span<const float> errors,
                                 const Georeference& source, const PlaceTarget& target,
                                 const MeshFormat& format, const PlacingOptions& options,
                                 const RunContext& context) try {
  ARETE_CHECK(checkPlacing(target, format));
  const Vec3 origin = options.origin.value_or(localOrigin(mesh.positions));
  ARETE_TRY(const PlaceMap map, PlaceMap::of(source, target, mesh.positions, origin));
  const double unit = target.isMetric ? source.verticalUnitMetres : 1;
  std::vector<float> scaled(errors.begin(), errors.end());
  if (unit != 1)
    for (float& e : scaled) e = floatAtLeast(double{e} * unit);
  ARETE_TRY(BentMesh bent,
            bendMesh(mesh, scaled, map,
                     {.tolerance = options.tolerance * unit,
                      .least = kLeastMetres / (target.isMetric ? 1 : source.verticalUnitMetres),
                      .samples = options.samples},
                     context));
  PlacedMesh placed;
  placed.figures = {.target = map.name(),
                    .isMetric = target.isMetric,
                    .unit = source.verticalUnit,
                    .addedVertices = bent.addedVertices,
                    .addedTriangles = bent.addedTriangles,
                    .added = bent.added / unit};
  placed.sourceErrors.reserve(bent.errors.size());
  for (const double e : bent.errors) {
    placed.errors.push_back(floatAtLeast(e));
    placed.sourceErrors.push_back(e / unit);
    placed.figures.largestError = std::max(placed.figures.largestError, e / unit);
  }
  placed.isFramedByWriter = target.isMetric && format.holds.isYUp;
  if (placed.isFramedByWriter) {
    placed.mesh = std::move(bent.source);
    placed.crsWkt = source.crsWkt;
    placed.verticalUnit = source.verticalUnit;
    placed.verticalUnitMetres = source.verticalUnitMetres;
    placed.origin = origin;
    // A glTF states errors in the unit of heights.
    for (std::size_t t = 0; t < placed.errors.size(); ++t)
      placed.errors[t] = floatAtLeast(placed.sourceErrors[t]);
    return placed;
  }
  placed.mesh = std::move(bent.mesh);
  if (target.isMetric) {
    placed.verticalUnit = "metre";
    placed.verticalUnitMetres = 1;
    placed.origin = Vec3{};
    placed.metresAbout = origin;
    placed.note = noteOfMetres(source, origin);
    if (!map.isLinear())
      placed.note += fmt::format(", which adds at most {:.6g} to the error", placed.figures.added * unit);
    return placed;
  }
  placed.crsWkt = map.crsWkt();
  if (!map.isLinear()) placed.note = noteOfBending(map.name(), placed.figures.added);
  placed.verticalUnit = source.verticalUnit;
  placed.verticalUnitMetres = source.verticalUnitMetres;
  const Vec3 led = map(origin);
  // The origin need not be a vertex of the mesh.
  placed.origin = isFinite(led) ? led : localOrigin(placed.mesh.positions);
  const double planMetres = map.unitMetres();
  if (!isGeographicCrs(placed.crsWkt) && std::abs(planMetres / source.verticalUnitMetres - 1) > 0.01)
    placed.warnings.push_back(
        {WarningCode::unit,
         fmt::format(
             "x and y count in units of {:.6g} m and heights, which keep their unit, in units of {:.6g} m; "
             "`metric` has metres throughout",
             planMetres, source.verticalUnitMetres)});
  return placed;
} catch (...) {
  return caughtFailure();
}

std::optional<Warning> warningOfDegrees(const MeshFormat& format, const std::string& crsWkt,
                                        const std::string& verticalUnit) {
  // Formats of maps (2DM, GeoPackage) go to programs that know what a CRS is; a glTF is in metres.
  const bool isForViewers = !format.holds.isYUp && !format.holds.sharesFile && format.extension != ".2dm";
  if (!isForViewers || !isGeographicCrs(crsWkt)) return std::nullopt;
  return Warning{
      WarningCode::position,
      fmt::format("x and y are degrees and heights {}: viewers of {} show a needle. extract and convert "
                  "write metres to the east, north and up with `metric`, coordinates of a map with `toCrs` "
                  "(utm, or EPSG:...)",
                  verticalUnit.empty() ? "metres" : verticalUnit, format.name)};
}

}  // namespace arete
