// SPDX-License-Identifier: GPL-3.0-or-later
//
// A geographic CRS has one scale along each parallel, so its table is of latitudes alone.
#include "viewer/heights/ground_scale.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "io/geo/crs/map_scale.h"

namespace arete {

GroundScale::GroundScale(const Georeference& georeference, const Box2& box) : box_(box) {
  if (georeference.crsWkt.empty()) {
    nodes_ = {{1, 1}};
    return;
  }
  if (georeference.isGeographic) {
    constexpr int kLatitudes = 1025;
    // At a pole a unit of longitude has no length: it gets the length close to it.
    const double pole = (90 - 1e-6) * std::numbers::pi / 180 / georeference.angularUnitRadians;
    rows_ = kLatitudes;
    for (int j = 0; j < rows_; ++j) {
      const double y = box.yMin + (box.yMax - box.yMin) * j / (rows_ - 1);
      nodes_.push_back(groundUnit(georeference, std::clamp(y, -pole, pole)));
    }
    return;
  }
  const double unit = georeference.linearUnitMetres;
  Vec2 middle{unit, unit};
  if (georeference.mapScale)
    middle = {unit / (*georeference.mapScale)[0], unit / (*georeference.mapScale)[1]};
  constexpr int kPlaces = 9;
  columns_ = rows_ = kPlaces;
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i) {
      const Vec2 xy{box.xMin + (box.xMax - box.xMin) * i / (columns_ - 1),
                    box.yMin + (box.yMax - box.yMin) * j / (rows_ - 1)};
      const auto scale = mapScaleAt(georeference, xy);
      nodes_.push_back(scale ? Vec2{unit / (*scale)[0], unit / (*scale)[1]} : middle);
    }
}

Vec2 GroundScale::at(Vec2 xy) const {
  const auto place = [](double v, double low, double high, int count) {
    const double t = high > low ? (v - low) / (high - low) * (count - 1) : 0;
    return std::clamp(t, 0.0, double(count - 1));
  };
  const double x = place(xy.x, box_.xMin, box_.xMax, columns_), y = place(xy.y, box_.yMin, box_.yMax, rows_);
  const int i = std::min(int(x), std::max(columns_ - 2, 0)), j = std::min(int(y), std::max(rows_ - 2, 0));
  const int iNext = std::min(i + 1, columns_ - 1), jNext = std::min(j + 1, rows_ - 1);
  const double u = x - i, v = y - j;
  const auto mixed = [&](auto part) {
    const double above = part(node(i, j)) * (1 - u) + part(node(iNext, j)) * u,
                 under = part(node(i, jNext)) * (1 - u) + part(node(iNext, jNext)) * u;
    return above * (1 - v) + under * v;
  };
  return {mixed([](const Vec2& n) { return n.x; }), mixed([](const Vec2& n) { return n.y; })};
}

}  // namespace arete
