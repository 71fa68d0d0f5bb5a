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

/// Cuts whose vertices leave the samples: their places in the plan stay, their heights move within the bound.
/// docs/topics/fit.md.

struct FitOptions {
  /// A patch that cannot be fitted by the vertices around it may move as many rings of vertices, 1 or more.
  std::uint32_t rings = 3;
  /// The features and places that were fixed in the build keep their heights.
  bool keepsFixedHeights = true;
};

/// A tolerance for every sample, in the DEM's vertical unit.
struct FitTolerance {
  double maxError = 0;             ///< everywhere, or in the region; >= 0
  const Region* region = nullptr;  ///< in plan coordinates; null = everywhere
  /// Outside the region; >= maxError. Where it allows more than the least cut needs, the fit does not.
  double outsideError = std::numeric_limits<double>::infinity();
};

/// A cut with heights of its own.
struct FittedCut {
  /// A cut of the model like any other; achievedError is that of the fitted surface.
  Cut cut;
  std::vector<double> heights = {};  ///< of each vertex of the cut
  std::vector<double> errors =
      {};  ///< of each triangle: max |z - plane| over the samples it covers, as fitted
  std::uint64_t trianglesBefore = 0;  ///< of the cut that the fit began with
  double errorBefore = 0;             ///< its achieved error, as stored
};

/// The fewest triangles that a fit finds within the tolerance: at every sample |z_TIN - z_sample| is within
/// it. Begins with the least cut, and takes out every node that the vertices nearby can do without when they
/// move; 17 to 41 % fewer triangles on real terrain. The same for any number of threads. Not the fewest that
/// there are: that is a hard problem.
///
/// Errors: usage, a tolerance below 0 or one outside that is finer; interrupted. O(cut) removals are tried,
/// each O(samples of its patch); 8 bytes per sample of the model and some 100 per vertex of the least cut.
Result<FittedCut> fitFewestTriangles(const TerrainModel& model, const FitTolerance& tolerance,
                                     const FitOptions& options = {}, const RunContext& context = {});

/// The triangles of a cut with the smallest largest error that a fit finds, patch by patch around the worst
/// samples. Within 2 % of the least there is on small grids; on large ones it can stop earlier. Errors:
/// interrupted. Precondition: the cut is one of the model's. O(samples) for each of some ten bounds.
Result<FittedCut> fitLeastError(const TerrainModel& model, const Cut& cut, const FitOptions& options = {},
                                const RunContext& context = {});

}  // namespace arete
