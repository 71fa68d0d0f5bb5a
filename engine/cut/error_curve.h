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

/// The numbers of triangles of the minimal and the saturated cut at one uniform tolerance.
struct CurvePoint {
  double maxError = 0;  ///< in the unit of the errors
  std::uint32_t minimalTriangles = 0;
  std::uint32_t saturatedTriangles = 0;
};

/// The tolerances of the series 1, 2, 5, 10, ... (times any power of ten) between the least positive error of
/// the model and the error of its root. O(log nodes).
/// @param most  how many at most; the largest are kept
/// @return rising
std::vector<double> toleranceLadder(const MultiTriangulation& mt, std::size_t most);

/// The numbers of triangles at each of the tolerances. O(nodes of the cut) for each. Errors: interrupted.
Result<std::vector<CurvePoint>> errorCurve(const MultiTriangulation& mt, std::span<const double> tolerances,
                                           const RunContext& context = {});

}  // namespace arete
