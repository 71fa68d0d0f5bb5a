// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/surface/distance_by_chart.h"
#include "surface/fit/attribute_fit.h"
#include "surface/front/front.h"

namespace arete {

/// What a fit did to the mesh of a cut.
struct FitOutcome {
  double rmsBefore = 0, rmsAfter = 0;  ///< of the distances from samples of the source
  /// No point of the source is farther than this from the fitted mesh, nor from what it has of the same
  /// chart: found by a search that shares nothing with the fit but boxes and distances of engine/base, or the
  /// error of the cut where nothing was moved.
  double distance = 0;
  double part = 1;                            ///< of the moves that was made, so that maxError is kept
  std::vector<AttributeRms> attributes = {};  ///< that were fitted; empty where nothing was moved
};

/// Moves the vertices of a front by `--fit rms` (surface/fit/fit.h), where they are on lines along these.
/// Where the result is farther from the source than maxError, vertices of lines stay nearer to them or where
/// they are, and then a part of every move is made: a half, a quarter, an eighth, or nothing, which is the
/// cut. Attributes follow (surface/fit/attribute_fit.h); where the root mean square of one would grow, or
/// moves along lines bring the surface across itself more often, the same is done.
/// @param charts    of the source and the cut: chartsOfCut()
/// @param cutError  of the cut: at most maxError
/// @param positionError  how far vertices of `source` may be from those that they stand for
///                       (SurfaceModel::positionError): all that is measured is stated with it
Result<FitOutcome> fitFront(SurfaceFront& front, const SurfaceMesh& source, const ChartsOfCut& charts,
                            bool keepsBorders, double cutError, std::optional<double> maxError,
                            const RunContext& context, double positionError = 0);

}  // namespace arete
