// SPDX-License-Identifier: GPL-3.0-or-later
//
// PROJ returns longitudes within half a turn, and so the x of maps whose x is a longitude. A terrain across
// the antimeridian would be torn apart there. So x is moved by whole turns next to where the longitude of the
// source says that it is.
#include "io/geo/bent/place_map.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/geo/bent/utm.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/map_scale.h"
#include "io/geo/crs/names.h"
#include "io/geo/crs/reader.h"
#include "io/geo/gdal/support.h"

namespace arete {
namespace {

constexpr double kEarthRadius = 6.4e6;       // metres
constexpr double kRoundingOfPlaces = 4e-15;  // of the largest coordinate: a few ulp, also within PROJ

Result<OGRSpatialReference> targetCrs(const Georeference& source, const std::string& text,
                                      std::span<const Vec3> positions, const std::string& culprit) {
  if (text == "utm" || text == "UTM") return utmOf(source, positions);
  auto crs = crsFromUser(text);
  if (!crs) return failure(crs.error().code, crs.error().message, culprit);
  if (crs->IsCompound() || crs->IsVertical() || (crs->IsGeographic() && crs->GetAxesCount() == 3))
    return failure(ErrorCode::usage,
                   "states heights too, and heights are not transformed; state the CRS of its plan alone",
                   culprit);
  return crs;
}

}  // namespace

Result<PlaceMap> PlaceMap::of(const Georeference& source, const PlaceTarget& target,
                              std::span<const Vec3> positions, const Vec3& origin) try {
  PlaceMap map;
  map.culprit_ = target.isMetric ? "metric" : fmt::format("toCrs {}", target.crs);
  if (target.isMetric && !target.crs.empty())
    return failure(ErrorCode::usage, "cannot go with `metric`: they are two frames",
                   fmt::format("toCrs {}", target.crs));
  if (source.crsWkt.empty())
    return failure(ErrorCode::usage,
                   "needs coordinates with a CRS, and there is none; `crs` states it where it is known",
                   map.culprit_);
  map.isGeographicSource_ = source.isGeographic;
  map.verticalUnitMetres_ = source.verticalUnitMetres;
  registerGdal();
  double largest = 0;
  for (const Vec3& p : positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  if (target.isMetric) {
    Georeference scaled = source;
    stateMapScale(scaled, {origin.x, origin.y});  // as a GLB: of the origin
    ARETE_TRY(LocalFrame frame, LocalFrame::create(localFrameSpec(scaled, origin)));
    map.isLinear_ = !source.isGeographic;
    map.frame_ = std::move(frame);
    map.name_ = "metres";
    map.rounding_ = kRoundingOfPlaces * kEarthRadius;
    return map;
  }
  ARETE_TRY(OGRSpatialReference crs, targetCrs(source, target.crs, positions, map.culprit_));
  Georeference described;
  if (Status ok = describeCrs(crs, described); !ok)
    return failure(ok.error().code, ok.error().message, map.culprit_);
  map.crsWkt_ = described.crsWkt;
  map.name_ = crsName(described.crsWkt);
  auto transform = CrsTransform::between(source.crsWkt, described.crsWkt, CrsTransform::Ballpark::refused);
  if (!transform) return failure(transform.error().code, transform.error().message, map.culprit_);
  map.transform_ = std::move(*transform);
  map.isLinear_ = map.transform_.isIdentity();
  constexpr double kDegreeMetres = 111'000;
  map.unitMetres_ = described.isGeographic ? described.angularUnitRadians * 57.29577951308232 * kDegreeMetres
                                           : described.linearUnitMetres;
  map.keepInOnePiece(source, described, positions);
  double farthest = kEarthRadius / map.unitMetres_;
  if (!described.isGeographic) farthest = std::max(farthest, 2e7 / map.unitMetres_);
  map.rounding_ = kRoundingOfPlaces * farthest;
  return map;
} catch (...) {
  return caughtFailure();
}

void PlaceMap::keepInOnePiece(const Georeference& source, const Georeference& target,
                              std::span<const Vec3> positions) {
  const double turn = turnOf(target);
  if (!(turn > 0) || positions.empty() || transform_.isIdentity()) return;
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-low.x, -low.y};
  for (const Vec3& p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const std::optional<Vec2> middle = transform_(0.5 * (low + high));
  if (!middle) return;
  turn_ = turn;
  xMiddle_ = middle->x;
  sourceMiddle_ = (low.x + high.x) / 2;
  const double sourceTurn = turnOf(source);
  perSource_ = sourceTurn > 0 ? turn / sourceTurn : 0;
}

void PlaceMap::apply(std::span<Vec3> positions) const {
  if (frame_) {
    for (Vec3& p : positions) p = frame_->toLocal(p);
    return;
  }
  std::vector<Vec2> plan;
  plan.reserve(positions.size());
  for (const Vec3& p : positions) plan.push_back({p.x, p.y});
  transform_.apply(plan);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    Vec2 p = plan[i];
    if (turn_ > 0) {
      const double expected = xMiddle_ + (positions[i].x - sourceMiddle_) * perSource_;
      p.x += turn_ * std::round((expected - p.x) / turn_);
    }
    positions[i] = {p.x, p.y, positions[i].z};
  }
}

Vec3 PlaceMap::operator()(Vec3 source) const {
  apply({&source, 1});
  return source;
}

Vec3 PlaceMap::upAt(const Vec3& source) const {
  if (!frame_ || isLinear_) return {0, 0, 1};
  constexpr double kStep = 1000;  // metres: far enough for rounding not to matter
  return unit(frame_->toLocal({source.x, source.y, source.z + kStep / verticalUnitMetres_}) -
              frame_->toLocal(source));
}

Result<Georeference> georeferenceOf(const std::string& crsWkt, const std::string& verticalUnit,
                                    double verticalUnitMetres) {
  Georeference georeference;
  if (!crsWkt.empty()) {
    registerGdal();
    ARETE_TRY(const auto crs, crsFromText(crsWkt));
    ARETE_CHECK(describeCrs(crs, georeference));
  }
  if (!verticalUnit.empty()) {
    georeference.verticalUnit = verticalUnit;
    georeference.verticalUnitMetres = metresPerUnit(verticalUnit).value_or(georeference.verticalUnitMetres);
  }
  if (verticalUnitMetres > 0) georeference.verticalUnitMetres = verticalUnitMetres;
  return georeference;
}

}  // namespace arete
