// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/base/result.h"
#include "engine/criteria/region.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// Fitted cuts: the vertices of a cut keep their positions in the plan, and their heights are changed so that
/// fewer triangles keep the bound, or the same triangles keep a smaller one or have no mean error.
/// docs/topics/fit.md.

struct FitOptions {
  /// How many rings of vertices around a removed vertex may be moved, at most; 1 or more.
  std::uint32_t rings = 3;
  /// Whether vertices that were fixed in the build (features, given positions) keep their heights.
  bool keepsFixedHeights = true;
};

/// A tolerance for every sample, in the DEM's vertical unit.
struct FitTolerance {
  double maxError = 0;             ///< everywhere, or in the region; >= 0
  const Region* region = nullptr;  ///< in plan coordinates; null = everywhere
  /// Outside the region; >= maxError. The fit uses the achieved error of the least cut where that is less.
  double outsideError = std::numeric_limits<double>::infinity();
};

/// A cut with its own heights.
struct FittedCut {
  /// A cut of the model; achievedError is that of the fitted surface.
  Cut cut;
  std::vector<double> heights = {};  ///< of each vertex of the cut
  /// Of each triangle: max |z - plane| over the samples that it covers, with the new heights.
  std::vector<double> errors = {};
  std::uint64_t trianglesBefore = 0;  ///< of the cut before the fit
  double errorBefore = 0;             ///< the achieved error of that cut
  double meanBefore = 0;              ///< its mean z_TIN - z_sample over all samples
};

/// Reduces the triangles of the least cut within a tolerance: at every sample |z_TIN - z_sample| stays within
/// it. Removes every node whose samples the vertices nearby can still approximate after their heights are
/// changed; 17 to 41 % fewer triangles on real terrain. A local optimum: the global one is NP-hard
/// [AgarwalSuri1998]. The result is the same for any number of threads. O(cut) removals are tried, each
/// O(samples of its patch); 8 bytes per sample of the model and about 100 per vertex of the least cut.
/// Errors: usage, culprit "maxError" or "outsideError": a tolerance below 0, or a smaller one outside the
/// region; invalidData: the triangles of the model leave samples uncovered; interrupted.
Result<FittedCut> fitFewestTriangles(const TerrainModel& model, const FitTolerance& tolerance,
                                     const FitOptions& options = {}, const RunContext& context = {});

/// Reduces the largest error of a cut, keeping its triangles (a Chebyshev fit), patch by patch around the
/// worst samples. Within 2 % of the optimum on small grids; on large ones it may stop at a larger error.
/// Precondition: the cut is one of the model. O(samples) for each of some ten bounds. Errors: invalidData, as
/// above; interrupted.
Result<FittedCut> fitLeastError(const TerrainModel& model, const Cut& cut, const FitOptions& options = {},
                                const RunContext& context = {});

/// Removes the mean error of a cut, keeping its triangles: the mean of z_TIN - z_sample becomes 0, for all
/// samples together and in the neighbourhood of every vertex, as far as the tolerance and fixed heights
/// permit. At every sample |z_TIN - z_sample| stays within the tolerance. The result is the same for any
/// number of threads. Precondition: the cut is one of the model, and within the tolerance. O(samples) for
/// each of some thirty sweeps; 40 bytes per sample of the model and about 120 per vertex of the cut. Errors:
/// as fitFewestTriangles().
Result<FittedCut> fitUnbiased(const TerrainModel& model, const Cut& cut, const FitTolerance& tolerance,
                              const FitOptions& options = {}, const RunContext& context = {});

}  // namespace arete
