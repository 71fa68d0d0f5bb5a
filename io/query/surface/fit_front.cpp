// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/fit_front.h"

#include <cmath>
#include <utility>

#include "surface/fit/fit.h"
#include "surface/fit/held_vertices.h"

namespace arete {

Result<FitOutcome> fitFront(SurfaceFront& front, const TriangleMesh& source, const ChartsOfCut& charts,
                            bool keepsBorders, double cutError, std::optional<double> maxError,
                            const RunContext& context, double positionError) {
  ARETE_TRY(const FittedSurface fitted,
            fitSurface(front.mesh.shape(), heldVertices(front.mesh, keepsBorders), source, {}, context));
  FitOutcome outcome{fitted.rmsBefore + positionError, fitted.rmsAfter + positionError, cutError, 1};
  // What is not moved has the error of the cut.
  if (fitted.steps == 0) return outcome;
  const std::vector<Vec3> before = front.mesh.positions;
  for (const double part : {1.0, 0.5, 0.25, 0.125}) {
    outcome.part = part;
    for (std::size_t v = 0; v < before.size(); ++v)
      front.mesh.positions[v] =
          part == 1 ? fitted.positions[v] : before[v] + part * (fitted.positions[v] - before[v]);
    ARETE_TRY(const double distance, distanceByChart(source, front.mesh.shape(), charts, context));
    outcome.distance = distance + positionError;
    if (!maxError || outcome.distance <= *maxError) return outcome;
  }
  front.mesh.positions = before;
  outcome.part = 0;
  outcome.rmsAfter = outcome.rmsBefore;
  outcome.distance = cutError;
  return outcome;
}

}  // namespace arete
