// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_model.h"

namespace arete {

/// The charts of a source and of a cut of it (surface/model/charts.h), by triangle. Empty without lines.
struct ChartsOfCut {
  std::vector<std::uint32_t> ofSource, ofCut;
};
/// @param source the finest front, or a part of it; @param cut its triangles are those of the cut's mesh
ChartsOfCut chartsOfCut(const SurfaceModel& model, const Cut& source, const Cut& cut);

/// No point of the source is farther than this from a triangle of the same chart; without charts, from the
/// mesh (farthestDistance()). Infinite if a chart has no triangle with area. Errors: those of
/// farthestDistance().
Result<double> distanceByChart(const TriangleMesh& source, const TriangleMesh& mesh,
                               const ChartsOfCut& charts, const RunContext& context);

}  // namespace arete
