// SPDX-License-Identifier: GPL-3.0-or-later
//
// Positions within the range of longitudes of the DEM are not shifted, so that those on its borders stay
// exact.
#include "io/crs/longitude_turns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "terrain/model/plan_box.h"

namespace arete {
namespace {

double turnOf(const Georeference& georeference) {
  const double turn = 2 * std::numbers::pi / georeference.angularUnitRadians;
  return std::abs(turn - 360) < 1e-9 ? 360 : turn;  // degrees to the last bit
}

}  // namespace

LongitudeTurns::LongitudeTurns(const TerrainModel& model) {
  if (!model.georeference.isGeographic) return;
  const Box2 box = planBox(model);
  for (const double x : {box.xMin, box.xMax})
    for (const double y : {box.yMin, box.yMax}) add(model.toSource({x, y}).x);
  turn_ = turnOf(model.georeference);
}

LongitudeTurns::LongitudeTurns(const Georeference& georeference, std::uint32_t columns, std::uint32_t rows) {
  if (!georeference.isGeographic) return;
  for (const double column : {-0.5, columns - 0.5})
    for (const double row : {-0.5, rows - 0.5}) add(georeference.toSource(column, row).x);
  turn_ = turnOf(georeference);
}

LongitudeTurns::LongitudeTurns(const RasterHeightfield& field)
    : LongitudeTurns(field.georeference, field.columns, field.rows) {}

LongitudeTurns::LongitudeTurns(const PointHeightfield& field) {
  if (!field.georeference.isGeographic) return;
  const Box2 box = planBox(field.positions);
  add(box.xMin);
  add(box.xMax);
  turn_ = turnOf(field.georeference);
}

void LongitudeTurns::add(double x) {
  west_ = std::min(west_, x);
  east_ = std::max(east_, x);
}

/// The shift that brings a longitude nearest to the middle of the DEM.
double LongitudeTurns::turnsOf(double x) const {
  return turn_ * std::round(((west_ + east_) / 2 - x) / turn_);
}

Vec2 LongitudeTurns::operator()(Vec2 p) const {
  if (turn_ > 0 && (p.x < west_ || p.x > east_)) p.x += turnsOf(p.x);
  return p;
}

void LongitudeTurns::apply(std::span<Vec2> positions) const {
  if (turn_ > 0)
    for (Vec2& p : positions) p = (*this)(p);
}

void LongitudeTurns::apply(RegionShape& shape) const {
  if (!(turn_ > 0)) return;
  double west = std::numeric_limits<double>::infinity(), east = -west;
  for (const auto* chains : {&shape.rings, &shape.lines})
    for (const auto& chain : *chains)
      for (const Vec2& p : chain) {
        west = std::min(west, p.x);
        east = std::max(east, p.x);
      }
  if (!(west <= east) || (west <= east_ && east >= west_)) return;
  const double turns = turnsOf((west + east) / 2);
  for (auto* chains : {&shape.rings, &shape.lines})
    for (auto& chain : *chains)
      for (Vec2& p : chain) p.x += turns;
}

}  // namespace arete
