// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"
#include "terrain/laws/model_rows.h"
#include "terrain/laws/validate_errors.h"
#include "terrain/model/terrain_model.h"

namespace arete {

struct ValidateModelOptions {
  /// On how many fronts of random closed node sets laws 5 and 9 are checked, beside the root, the finest
  /// front and a series of uniform cuts. No threshold produces these sets.
  std::uint32_t randomFronts = 8;
  std::uint64_t seed = 1;
  /// Whether law 10 is checked on every triangle, or on a sample where there are many.
  bool everyTriangle = false;
  /// Of a part of a raster's model: rows of which it has every sample. Laws 8 and 10 are checked there, and
  /// the checksum of the heights is not. Nothing: the model is whole.
  std::optional<ModelRows> rows = {};
};

/// Checks the laws of a model: those of engine/laws/validate.h, and
///   5  every triangle is positively oriented, exactly; the rest of law 5 on the fronts above
///   7  every fixed vertex is in the root
///   8  every sample of the domain is a vertex of the finest front (raster: it is finestTriangulation(), and
///   the heights have the source's checksum)
///   9  Delaunay shape without rim tolerance: the fronts above are (constrained) Delaunay in the build's
///   metric
///   10  validateErrors(): stored errors and bounds are at least the true ones
/// O(triangles * fronts). Errors: brokenPromise: the first violation; interrupted.
/// @param checked  receives of how many triangles law 10 was checked; may be null
Status validateModel(const TerrainModel& model, const ValidateModelOptions& options = {},
                     const RunContext& context = {}, ErrorsChecked* checked = nullptr);

/// Checks law 9 on one front by CGAL's exact predicates: every triangle is counter-clockwise, every edge with
/// two triangles is locally Delaunay in the build's metric (cocircular ties allowed), which makes the whole
/// front Delaunay [Delaunay1934]. O(triangles), parallel. Errors: brokenPromise: the first violation.
Status validateDelaunayFront(const TerrainModel& model, const Cut& cut);

/// A random closed node set: random nodes and all of their ancestors.
/// @param fraction  of all nodes, drawn before the ancestors are added
NodeSet randomClosedSet(const MultiTriangulation& mt, std::uint64_t seed, double fraction);

}  // namespace arete
