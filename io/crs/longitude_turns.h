// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "engine/base/vec.h"
#include "engine/criteria/region.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A longitude less or more whole turns is the same place: of positions in a geographic CRS that lie beside a
/// DEM, the one of the same place that is nearest to its middle. All others stay as they are.
class LongitudeTurns {
 public:
  /// Leaves every position where it is.
  LongitudeTurns() = default;
  /// O(1) of a raster, O(root vertices) of points.
  explicit LongitudeTurns(const TerrainModel& model);
  /// Those of a raster's pixels, all of which belongs to it. O(1).
  LongitudeTurns(const Georeference& georeference, std::uint32_t columns, std::uint32_t rows);
  explicit LongitudeTurns(const RasterHeightfield& heightfield);
  /// O(points).
  explicit LongitudeTurns(const PointHeightfield& heightfield);

  Vec2 operator()(Vec2 p) const;
  /// All of them in place. O(positions).
  void apply(std::span<Vec2> positions) const;
  /// All of a shape by the same turns, where it lies beside the DEM as a whole. O(positions).
  void apply(RegionShape& shape) const;

 private:
  void add(double x);
  double turnsOf(double x) const;

  double turn_ = 0;  ///< in the unit of the CRS; 0: nothing is turned
  double west_ = std::numeric_limits<double>::infinity(), east_ = -west_;
};

}  // namespace arete
