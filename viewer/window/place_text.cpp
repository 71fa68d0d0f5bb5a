// SPDX-License-Identifier: GPL-3.0-or-later
//
// Typed text is parsed by io/geo/crs/position_argument.h, as on the command line.
#include "viewer/window/place_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/position_argument.h"

namespace arete {

PlaceText::PlaceText(const GroundHeights& heights) : heights_(heights) {
  const Georeference& dem = heights.model().georeference;
  if (dem.crsWkt.empty()) return;
  if (auto made = CrsLonLat::of(dem)) lonLat_ = std::move(*made);
}

std::string PlaceText::xy(Vec2 xy) const {
  return heights_.model().georeference.isGeographic ? fmt::format("{:.6f}, {:.6f}", xy.x, xy.y)
                                                    : fmt::format("{:.1f}, {:.1f}", xy.x, xy.y);
}

std::string PlaceText::lonLat(Vec2 xy) const {
  if (!lonLat_) return {};
  std::array<Vec2, 1> at{xy};
  lonLat_->toLonLat(at);
  const double lon = std::remainder(at[0].x, 360), lat = at[0].y;
  if (!std::isfinite(lon + lat)) return {};
  return fmt::format("{:.6f}° {}, {:.6f}° {}", std::abs(lon), lon < 0 ? "W" : "E", std::abs(lat),
                     lat < 0 ? "S" : "N");
}

bool PlaceText::isLonLat() const {
  constexpr double kDegree = 0.017453292519943295;
  return lonLat_ && lonLat_->isPlain() &&
         std::abs(heights_.model().georeference.angularUnitRadians - kDegree) < 1e-12;
}

std::string PlaceText::height(double height) const {
  const std::string& unit = heights_.model().georeference.verticalUnit;
  return unit.empty() ? fmt::format("{:.2f}", height) : fmt::format("{:.2f} {}", height, unit);
}

Result<PlaceText::Goal> PlaceText::read(const std::string& text, bool isLonLat) const {
  const Georeference& dem = heights_.model().georeference;
  ARETE_TRY(CrsTransform toDem, isLonLat ? CrsTransform::fromLonLat(dem) : CrsTransform());
  toDem.setTurns(LongitudeTurns(heights_.model()));
  Goal goal;
  if (std::count(text.begin(), text.end(), ',') < 2) {
    ARETE_TRY(const auto place, readPlaceArgument("go to", text, toDem));
    const auto ground = heights_.at(place);
    if (!ground)
      return failure(ErrorCode::invalidData, "there is no terrain; X,Y,Hmsl goes there all the same",
                     "go to " + text);
    goal.xy = place;
    goal.ground = ground->height;
    return goal;
  }
  const DataUnit unit = heightUnitOf(dem);
  ARETE_TRY(const auto position, readPositionArgument("go to", text, toDem, &unit));
  ARETE_TRY(const auto height, demHeight(position, heights_));
  const auto ground = heights_.at(position.xy);
  goal.xy = position.xy;
  goal.ground = ground ? ground->height : height;
  goal.height = height;
  return goal;
}

}  // namespace arete
