// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/base/vec.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// How far a whole turn about the Earth leads along x, in the unit of the CRS: of a geographic CRS, and of a
/// projected one whose x is proportional to the longitude (Mercator, also EPSG:3857, and other cylindrical
/// projections). 0 for all others, and without a CRS.
double turnOf(const Georeference& georeference);

/// Shifts positions by whole turns (turnOf()) onto a DEM: a position that lies east or west of the DEM
/// becomes the equivalent position nearest to the middle of the DEM. Other positions do not change. On a
/// raster that goes round the Earth each longitude is: between its last column and the whole turn, where
/// rounded steps leave a sliver, it is that of the column.
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
  /// The shifts, whole turns, by which something that reaches from `west` to `east` meets the DEM; rising.
  /// {0} where nothing turns, or nothing is finite.
  std::vector<double> shiftsOnto(double west, double east) const;

 private:
  void add(double x);
  double turnsOf(double x) const;

  double turn_ = 0;        ///< in the unit of the CRS; 0: the identity
  bool isClosed_ = false;  ///< the DEM goes round the Earth
  double west_ = std::numeric_limits<double>::infinity(), east_ = -west_;
};

}  // namespace arete
