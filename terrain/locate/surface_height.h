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

/// The height of the terrain at a place. Full resolution, the finest triangulation, is within
/// [height - above, height + below]; both are 0 where the height is that of full resolution.
struct SurfaceHeight {
  double height = 0;               ///< in the DEM's vertical unit
  double below = 0, above = 0;     ///< the bound of the triangle: z_triangle - z_finest is in [-below, above]
  TriangleId triangle{};           ///< the triangle of the multitriangulation that decided
  std::uint32_t nodesVisited = 0;  ///< steps down from the root
};

/// Answers how high the terrain is, without a cut: from the root triangle over the place down through the
/// triangles over it, until one has a bound within the tolerance (De Floriani, Magillo, Puppo 1998), or is
/// one of the finest. A tolerance is kept over the continuous surface, not only at samples.
///
/// A place on NODATA or outside the DEM has no height, nor has an isolated sample, which is in no triangle.
/// One beyond a border by less than margin() is put on it, since coordinates are rounded. With a rim
/// tolerance coarse triangles reach over NODATA; whether there is terrain is then decided by the finest,
/// which give the height as well.
///
/// Keeps a reference to the model. Thread-safe: it is only read.
class SurfaceHeights {
 public:
  /// O(root triangles). Precondition: the model outlives this.
  explicit SurfaceHeights(const TerrainModel& model);

  /// At a place in source coordinates; nothing where there is no terrain. maxError: in the DEM's vertical
  /// unit, 0 = full resolution. Precondition: maxError >= 0. O(depth * degree).
  std::optional<SurfaceHeight> at(Vec2 xy, double maxError = 0) const;

  /// At many places, in their order; parallel, the same for any number of threads. Places near each other are
  /// visited one after the other. Errors: interrupted. O(n log n + n * depth * degree).
  Result<std::vector<std::optional<SurfaceHeight>>> at(std::span<const Vec2> places, double maxError = 0,
                                                       const RunContext& context = {}) const;

  const TerrainModel& model() const { return model_; }
  const TriangleLocator& locator() const { return locator_; }
  /// How far beyond a border a place still counts as on it, in plan units: 1e-9 of a sample's spacing
  /// (points: of the mean spacing), and the last bits of a coordinate.
  static double margin(const TerrainModel& model);

 private:
  std::optional<SurfaceHeight> inPlan(Vec2 p, OutwardScale::Code allowed) const;

  const TerrainModel& model_;
  TriangleLocator locator_;
};

}  // namespace arete
