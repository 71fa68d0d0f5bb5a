// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/map_scale.h"

#include <GeographicLib/Geodesic.hpp>
#include <cmath>

#include "io/geo/crs/lonlat.h"

namespace arete {

std::optional<std::array<double, 2>> mapScaleAt(const Georeference& georeference, Vec2 xy) {
  if (georeference.isGeographic || georeference.crsWkt.empty()) return std::nullopt;
  const auto lonLat = CrsLonLat::of(georeference);
  if (!lonLat) return std::nullopt;
  constexpr double kMetres = 100;
  const double reach = kMetres / georeference.linearUnitMetres;
  std::array<Vec2, 4> at = {
      Vec2{xy.x - reach, xy.y}, {xy.x + reach, xy.y}, {xy.x, xy.y - reach}, {xy.x, xy.y + reach}};
  lonLat->toLonLat(at);
  for (const Vec2& p : at)
    if (!std::isfinite(p.x) || !(std::abs(p.y) <= 90)) return std::nullopt;
  const GeographicLib::Geodesic geodesic(
      georeference.semiMajorAxisMetres,
      georeference.inverseFlattening == 0 ? 0 : 1 / georeference.inverseFlattening);
  double alongX = 0, alongY = 0;
  geodesic.Inverse(at[0].y, at[0].x, at[1].y, at[1].x, alongX);
  geodesic.Inverse(at[2].y, at[2].x, at[3].y, at[3].x, alongY);
  const std::array<double, 2> scale = {2 * kMetres / alongX, 2 * kMetres / alongY};
  if (!(std::isfinite(scale[0]) && std::isfinite(scale[1]) && scale[0] > 0 && scale[1] > 0))
    return std::nullopt;
  return scale;
}

void stateMapScale(Georeference& georeference, Vec2 middle) {
  constexpr double kTrue = 0.01;
  georeference.mapScale = mapScaleAt(georeference, middle);
  if (!georeference.mapScale) return;
  const auto [x, y] = *georeference.mapScale;
  if (std::abs(x - 1) <= kTrue && std::abs(y - 1) <= kTrue) georeference.mapScale.reset();
}

}  // namespace arete
