// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Triangles of the two cuts at one uniform tolerance.
struct CurvePoint {
  double maxError = 0;  ///< in the unit of the heights
  std::uint32_t minimalTriangles = 0;
  std::uint32_t saturatedTriangles = 0;
};

/// Tolerances 1, 2, 5, 10, ... (times any power of ten) that lie between the finest triangulation and the
/// root, rising: at most `most` of them, the coarsest. Empty where nothing lies between. O(log N).
std::vector<double> toleranceLadder(const MultiTriangulation& mt, std::size_t most);

/// The curve of triangles against error at these tolerances. Errors: interrupted.
/// O(nodes of the cut) for each.
Result<std::vector<CurvePoint>> errorCurve(const MultiTriangulation& mt, std::span<const double> tolerances,
                                           const RunContext& context = {});

}  // namespace arete
