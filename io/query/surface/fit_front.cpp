// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/fit_front.h"

#include <algorithm>
#include <utility>

#include "surface/fit/fit.h"
#include "surface/fit/held_vertices.h"

namespace arete {

Result<FitOutcome> fitFront(SurfaceFront& front, const SurfaceMesh& source, const ChartsOfCut& charts,
                            bool keepsBorders, double cutError, std::optional<double> maxError,
                            const RunContext& context, double positionError) {
  ARETE_TRY(const FittedSurface fitted, fitSurface(front.mesh.shape(), heldVertices(front.mesh, keepsBorders),
                                                   source.shape(), {}, context));
  FitOutcome outcome{fitted.rmsBefore + positionError, fitted.rmsAfter + positionError, cutError, 1};
  // What is not moved has the error of the cut.
  if (fitted.steps == 0) return outcome;
  const SurfaceMesh asCut = front.mesh;
  const std::vector<Vec3>& before = asCut.positions;
  const FitCharts fitCharts{charts.ofSource, charts.ofCut};
  for (const double part : {1.0, 0.5, 0.25, 0.125}) {
    outcome.part = part;
    for (std::size_t v = 0; v < before.size(); ++v)
      front.mesh.positions[v] =
          part == 1 ? fitted.positions[v] : before[v] + part * (fitted.positions[v] - before[v]);
    ARETE_TRY(const double distance, distanceByChart(source.shape(), front.mesh.shape(), charts, context));
    outcome.distance = distance + positionError;
    if (maxError && outcome.distance > *maxError) continue;
    ARETE_TRY(auto attributes, fitAttributes(front.mesh, before, source, fitCharts, 0, context));
    if (std::ranges::none_of(attributes, &AttributeRms::hasGrown)) {
      outcome.attributes = std::move(attributes);
      return outcome;
    }
    const std::vector<Vec3> moved = std::move(front.mesh.positions);
    front.mesh = asCut;
    front.mesh.positions = moved;
  }
  front.mesh = asCut;
  outcome.part = 0;
  outcome.rmsAfter = outcome.rmsBefore;
  outcome.distance = cutError;
  return outcome;
}

}  // namespace arete
