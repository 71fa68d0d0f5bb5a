// SPDX-License-Identifier: GPL-3.0-or-later
//
// Positions within the range of longitudes of the DEM are not shifted, so that those on its borders stay
// exact.
#include "io/geo/crs/longitude_turns.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>

#include "io/geo/crs/lonlat.h"
#include "io/geo/crs/reader.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

/// Of a projected CRS: x at two longitudes a quarter of a turn apart, if its projection is cylindrical.
double turnOfMap(const Georeference& georeference) {
  const auto crs = crsFromText(georeference.crsWkt);
  if (!crs) return 0;
  const char* name = crs->GetAttrValue("PROJECTION");
  const std::string_view projection = name ? name : "";
  constexpr std::string_view kCylindrical[] = {SRS_PT_MERCATOR_1SP,
                                               SRS_PT_MERCATOR_2SP,
                                               SRS_PT_EQUIRECTANGULAR,
                                               SRS_PT_CYLINDRICAL_EQUAL_AREA,
                                               SRS_PT_MILLER_CYLINDRICAL,
                                               SRS_PT_GALL_STEREOGRAPHIC,
                                               SRS_PT_MERCATOR_AUXILIARY_SPHERE};
  if (std::ranges::find(kCylindrical, projection) == std::end(kCylindrical)) return 0;
  const auto lonLat = CrsLonLat::of(georeference);
  if (!lonLat) return 0;
  std::array<Vec2, 4> at = {Vec2{0, 0}, {120, 0}, {-120, 0}, {0, 0}};
  lonLat->toCrs(at);
  // One of the three lies across the seam of the map; the longest way is the one that crosses it not.
  double third = 0;
  for (const auto& [a, b] : {std::pair{0, 1}, {2, 0}, {1, 2}}) {
    const double step = at[std::size_t(b)].x - at[std::size_t(a)].x;
    if (std::isfinite(step) && step > 0) third = std::max(third, step);
  }
  return 3 * third;
}

}  // namespace

double turnOf(const Georeference& georeference) {
  if (!georeference.isGeographic) return georeference.crsWkt.empty() ? 0 : turnOfMap(georeference);
  const double turn = 2 * std::numbers::pi / georeference.angularUnitRadians;
  if (!std::isfinite(turn)) return 0;
  return std::abs(turn - 360) < 1e-9 ? 360 : turn;  // degrees to the last bit
}

LongitudeTurns::LongitudeTurns(const TerrainModel& model) {
  turn_ = turnOf(model.georeference);
  if (!(turn_ > 0)) return;
  const Box2 box = planBox(model);
  for (const double x : {box.xMin, box.xMax})
    for (const double y : {box.yMin, box.yMax}) add(model.toSource({x, y}).x);
  isClosed_ = model.isRaster && model.georeference.repeatsFirstColumn;
}

LongitudeTurns::LongitudeTurns(const Georeference& georeference, std::uint32_t columns, std::uint32_t rows) {
  turn_ = turnOf(georeference);
  if (!(turn_ > 0)) return;
  for (const double column : {-0.5, columns - 0.5})
    for (const double row : {-0.5, rows - 0.5}) add(georeference.toSource(column, row).x);
}

LongitudeTurns::LongitudeTurns(const RasterHeightfield& field)
    : LongitudeTurns(field.georeference, field.columns, field.rows) {}

LongitudeTurns::LongitudeTurns(const PointHeightfield& field) {
  turn_ = turnOf(field.georeference);
  if (!(turn_ > 0)) return;
  const Box2 box = planBox(field.positions);
  add(box.xMin);
  add(box.xMax);
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
  if (!(turn_ > 0) || !(p.x < west_ || p.x > east_)) return p;
  p.x += turnsOf(p.x);
  if (isClosed_) p.x = std::clamp(p.x, west_, east_);
  return p;
}

void LongitudeTurns::apply(std::span<Vec2> positions) const {
  if (turn_ > 0)
    for (Vec2& p : positions) p = (*this)(p);
}

std::vector<double> LongitudeTurns::shiftsOnto(double west, double east) const {
  if (!(turn_ > 0) || !(west <= east) || !std::isfinite(west) || !std::isfinite(east)) return {0};
  std::vector<double> shifts;
  constexpr double kMostTurns = 16;  // what goes round more often is not a shape on the Earth
  const double first = std::max(std::ceil((west_ - east) / turn_), -kMostTurns),
               last = std::min(std::floor((east_ - west) / turn_), kMostTurns);
  for (double k = first; k <= last; ++k) shifts.push_back(k * turn_);
  return shifts;
}

}  // namespace arete
