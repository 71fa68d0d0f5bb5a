// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"

namespace arete {

struct ValidateModelOptions {
  /// Fronts of random closed node sets on which laws 5 and 9 are checked, beside the root, the finest front
  /// and a ladder of uniform cuts. Half of them are sets that no threshold produces.
  std::uint32_t randomFronts = 8;
  std::uint64_t seed = 1;
};

/// Every law of ARCHITECTURE.md on a model: those of engine/laws/validate.h, and
///   5  every triangle positively oriented, exactly; the rest of it on the fronts above
///   7  every fixed vertex is in the root
///   8  the finest front has every sample of the domain for a vertex (raster: the layout of finest_raster.h,
///   exactly)
///   9  Delaunay shape without rim tolerance: the fronts above are (constrained) Delaunay in the build's
///   metric
/// Names the first violation. O(triangles * fronts).
Status validateModel(const TerrainModel& model, const ValidateModelOptions& options = {},
                     const RunContext& context = {});

/// Law 9 on one front, by CGAL's exact predicates: every triangle counter-clockwise, every edge with two
/// triangles locally Delaunay in the build's metric (cocircular ties allowed). O(triangles), parallel.
Status validateDelaunayFront(const TerrainModel& model, const Cut& cut);

/// A closed node set grown from random nodes (a fraction of all of them, then their ancestors).
NodeSet randomClosedSet(const MultiTriangulation& mt, std::uint64_t seed, double fraction);

}  // namespace arete
