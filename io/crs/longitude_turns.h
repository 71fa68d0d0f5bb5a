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

/// Shifts longitudes by whole turns onto a DEM: a position in a geographic CRS that lies east or west of the
/// DEM becomes the equivalent position nearest to the middle of the DEM. Other positions do not change.
class LongitudeTurns {
 public:
  /// The identity.
  LongitudeTurns() = default;
  /// O(1) for a raster, O(root vertices) for points.
  explicit LongitudeTurns(const TerrainModel& model);
  /// For a raster, with the whole areas of its pixels. O(1).
  LongitudeTurns(const Georeference& georeference, std::uint32_t columns, std::uint32_t rows);
  explicit LongitudeTurns(const RasterHeightfield& heightfield);
  /// O(points).
  explicit LongitudeTurns(const PointHeightfield& heightfield);

  Vec2 operator()(Vec2 p) const;
  /// In place. O(positions).
  void apply(std::span<Vec2> positions) const;
  /// Shifts a shape as a whole, if all of it lies beside the DEM. O(positions).
  void apply(RegionShape& shape) const;

 private:
  void add(double x);
  double turnsOf(double x) const;

  double turn_ = 0;  ///< in the unit of the CRS; 0: the identity
  double west_ = std::numeric_limits<double>::infinity(), east_ = -west_;
};

}  // namespace arete
