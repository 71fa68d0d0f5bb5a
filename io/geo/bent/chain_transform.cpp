// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/bent/chain_transform.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/reader.h"
#include "io/geo/gdal/support.h"

namespace arete {
namespace {

ChainProjection::Map mapBy(OGRCoordinateTransformation& transformation) {
  return [&transformation](Vec2 p) -> std::optional<Vec2> {
    if (!transformation.Transform(1, &p.x, &p.y) || !std::isfinite(p.x) || !std::isfinite(p.y))
      return std::nullopt;
    return p;
  };
}

}  // namespace

Result<ChainTransform> ChainTransform::between(const OGRSpatialReference& source,
                                               const OGRSpatialReference& target, double deviation,
                                               Ballpark ballpark) {
  ChainTransform made;
  if (source.IsSame(&target)) return made;
  const GdalErrors errors;
  OGRCoordinateTransformationOptions options;
  options.SetBallparkAllowed(ballpark == Ballpark::allowed);
  made.there_.reset(OGRCreateCoordinateTransformation(&source, &target, options));
  made.back_.reset(made.there_ ? OGRCreateCoordinateTransformation(&target, &source, options) : nullptr);
  if (!made.there_ || !made.back_)
    return failure(ErrorCode::invalidData,
                   fmt::format("there is no way from its CRS to that of the DEM: {}", errors.firstFailure()));
  made.chains_.forward = mapBy(*made.there_);
  made.chains_.back = mapBy(*made.back_);
  made.chains_.deviation = deviation;
  Georeference onTarget;
  ARETE_CHECK(describeCrs(target, onTarget));
  made.chains_.turn = turnOf(onTarget);
  // In a cylindrical map no pole is nearer than this; in some it is infinitely far.
  made.chains_.pole = target.IsGeographic() ? made.chains_.turn / 4 : made.chains_.turn;
  return made;
}

Result<std::vector<Vec2>> ChainTransform::operator()(const std::vector<Vec2>& chain, bool isRing) const {
  if (isIdentity()) return chain;
  const GdalErrors quiet;
  auto projected = isRing ? projectRing(chain, chains_) : projectLine(chain, chains_);
  if (!projected)
    return failure(ErrorCode::invalidData, "has a vertex, or an edge, that the CRS of the DEM cannot tell");
  return std::move(*projected);
}

double turnOfDegrees(const OGRSpatialReference& crs) {
  Georeference described;
  return !crs.IsEmpty() && crs.IsGeographic() && describeCrs(crs, described) ? turnOf(described) : 0;
}

bool leadsTheLongWay(double way, double turn) {
  return std::abs(way) > turn / 2 && std::abs(way) < turn * (1 - 1e-9);
}

void takeShortWays(std::vector<Vec2>& line, double turn) {
  if (turn == 0) return;
  for (std::size_t i = 1; i < line.size(); ++i)
    if (const double way = line[i].x - line[i - 1].x; leadsTheLongWay(way, turn))
      line[i].x -= turn * std::round(way / turn);
}

}  // namespace arete
