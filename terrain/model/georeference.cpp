// SPDX-License-Identifier: GPL-3.0-or-later
//
// On a geographic CRS a step of one column or one row is the length of the geodesic on the CRS's own
// ellipsoid [Karney2013], centred at the given position. Any ellipsoid works, also that of the Moon.
#include "terrain/model/georeference.h"

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace arete {

Vec2 groundStep(const Georeference& georeference, double column, double row) {
  const auto& g = georeference.geoTransform;
  const double planarX = std::hypot(g[1], g[4]), planarY = std::hypot(g[2], g[5]);
  if (georeference.crsWkt.empty()) return {planarX, planarY};
  if (!georeference.isGeographic) {
    const double unit = georeference.linearUnitMetres;
    if (!georeference.mapScale) return {planarX * unit, planarY * unit};
    const auto [x, y] = *georeference.mapScale;
    return {std::hypot(g[1] / x, g[4] / y) * unit, std::hypot(g[2] / x, g[5] / y) * unit};
  }

  const double flattening = georeference.inverseFlattening == 0 ? 0 : 1 / georeference.inverseFlattening;
  const GeographicLib::Geodesic geodesic(georeference.semiMajorAxisMetres, flattening);
  const double degrees = georeference.angularUnitRadians * 180 / std::numbers::pi;
  const Vec2 here = georeference.toSource(column, row);
  const auto distance = [&](double dx, double dy) {
    const auto latitude = [&](double y) { return std::clamp(y * degrees, -90.0, 90.0); };
    double metres = 0;
    geodesic.Inverse(latitude(here.y - dy / 2), (here.x - dx / 2) * degrees, latitude(here.y + dy / 2),
                     (here.x + dx / 2) * degrees, metres);
    return metres;
  };
  const Vec2 step{distance(g[1], g[4]), distance(g[2], g[5])};
  // At a pole, and beyond it, a step has no length; a metric with zero extent would give no distances.
  const double perRadian = georeference.semiMajorAxisMetres * georeference.angularUnitRadians;
  const Vec2 equatorial{planarX * perRadian, planarY * perRadian};
  constexpr double kNowhere = 1e-9;
  if (step.x > kNowhere * equatorial.x && step.y > kNowhere * equatorial.y) return step;
  return equatorial;
}

Vec2 groundUnit(const Georeference& georeference, double y) {
  constexpr double kStep = 1e-3;
  Georeference axes = georeference;
  axes.geoTransform = {-kStep / 2, kStep, 0, y - kStep / 2, 0, kStep};  // its first sample is at 0, y
  const Vec2 step = groundStep(axes, 0, 0);
  return {step.x / kStep, step.y / kStep};
}

}  // namespace arete
