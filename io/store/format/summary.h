// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace arete {

/// What a file in pages says of its model in its metadata, so that it is known without reading pages.
struct AmtSummary {
  std::uint64_t triangles = 0;        ///< of the whole MT; 0: the file has no summary
  std::uint64_t finestTriangles = 0;  ///< of the finest front
  double relief = 0;                  ///< reliefOf()
  double rootError = 0;               ///< the largest error of a root triangle
  /// The error curve at the steps of its ladder (terrain/model/error_curve.h), rising: the tolerance, the
  /// triangles of the minimal and of the saturated cut.
  std::vector<std::array<double, 3>> curve;

  bool isThere() const { return triangles > 0; }
};

/// Steps of the curve that a summary holds at most.
inline constexpr std::size_t kSummarySteps = 40;

}  // namespace arete
