// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/locate/triangle_locator.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The height of the terrain at a position. The height of the finest triangulation is within
/// [height - above, height + below]; both are 0 where `height` is that height.
struct GroundHeight {
  double height = 0;               ///< in the DEM's vertical unit
  double below = 0, above = 0;     ///< the bound of the triangle: z_triangle - z_finest is in [-below, above]
  TriangleId triangle{};           ///< the triangle of the multitriangulation that gave the height
  std::uint32_t nodesVisited = 0;  ///< steps down from the root
};

/// Point queries of the terrain's height, without a cut: descends from the root triangle over the position
/// through the triangles over it, until one has an error bound within the tolerance or is one of the finest
/// [DeFlorianiMagilloPuppo1998]. The tolerance holds over the continuous surface, not only at samples.
///
/// Positions on NODATA, outside the DEM or on an isolated sample (which is in no triangle) have no height. A
/// position beyond a border by less than margin() is moved onto it, since coordinates are rounded. With a rim
/// tolerance coarse triangles may cover NODATA; then the descent always goes on to the finest triangulation,
/// which decides whether there is terrain.
///
/// Keeps a reference to the model. Thread-safe: all queries are const.
class GroundHeights {
 public:
  /// O(root triangles). Precondition: the model outlives this.
  explicit GroundHeights(const TerrainModel& model);

  /// O(depth * degree).
  /// @param xy  source coordinates
  /// @param maxError  in the DEM's vertical unit, >= 0; 0 = full resolution
  /// @return nothing where there is no terrain
  std::optional<GroundHeight> at(Vec2 xy, double maxError = 0) const;

  /// The same at many positions; parallel. The result does not depend on the number of threads. Positions are
  /// visited in Morton order [Morton1966], so that neighbours share cache lines. O(n log n + n depth degree).
  /// Errors: unsupported: 2^32 positions or more; interrupted.
  /// @return one answer per position, in the order given
  Result<std::vector<std::optional<GroundHeight>>> at(std::span<const Vec2> positions, double maxError = 0,
                                                      const RunContext& context = {}) const;

  const TerrainModel& model() const { return model_; }
  const TriangleLocator& locator() const { return locator_; }
  /// How far beyond a border a position still counts as on it, in plan units: 1e-9 of the spacing of samples
  /// (points: of their mean spacing), plus the rounding of a coordinate.
  static double margin(const TerrainModel& model);

 private:
  std::optional<GroundHeight> inPlan(Vec2 p, OutwardScale::Code allowed) const;

  const TerrainModel& model_;
  TriangleLocator locator_;
};

}  // namespace arete
