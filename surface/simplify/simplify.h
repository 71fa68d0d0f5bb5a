// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "engine/simplify/simplified_root.h"
#include "surface/simplify/state.h"

namespace arete {

/// What the levels leave over, with the labels of its triangles.
struct SurfaceRoot : SimplifiedRoot {
  std::vector<TriangleLabels> labels;
  std::vector<float> attributeErrors;  ///< by triangle, as AttributeBound has them
};

/// Removes every vertex that can be removed, or until no more than state.fewEnough triangles are left.
/// Errors: interrupted. Preconditions: the mesh is a manifold; the state has the labels of its triangles.
/// @param isFixed per vertex, not 0 = it is never removed.
Result<SurfaceRoot> simplifySurface(SurfaceState& state, const std::vector<std::uint8_t>& isFixed,
                                    const RunContext& context);

}  // namespace arete
