// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// The most neighbours that a vertex may have when it is removed.
inline constexpr std::uint32_t kMostDegree = 32;

/// The shape of the triangles that fill the hole of a removed vertex.
enum class HoleShape {
  delaunay,       ///< (constrained) Delaunay triangulation of every front: well-shaped triangles
  dataDependent,  ///< least vertical error [DynLevinRippa1990]: far fewer triangles at the same bound
};

/// The threshold ratio of a build that states none: the data-dependent shape takes smaller steps, for some
/// thousandths fewer triangles at about the same time (docs/decisions/0018).
constexpr double defaultThresholdRatio(HoleShape shape) {
  return shape == HoleShape::dataDependent ? 1.13328 : 1.17;
}

/// Options of a build. The defaults are what the figures in docs/performance.md are measured with.
struct BuildOptions {
  HoleShape shape = HoleShape::delaunay;

  /// A vertex with more neighbours is not removed until some of them are. 6 .. kMostDegree.
  std::uint32_t maxDegree = 14;

  /// A level admits removals whose error is below a threshold. The threshold grows by this ratio from the
  /// first level to the second, by less in later levels as fewer vertices are left, and by more where almost
  /// none would be removed (simplify.h). > 1. Without a value: defaultThresholdRatio(shape). A model that was
  /// built always has the value.
  std::optional<double> thresholdRatio{};
  double thresholdRatioOrDefault() const { return thresholdRatio.value_or(defaultThresholdRatio(shape)); }

  /// Data-dependent shape only: triangles whose least altitude is below this part of their longest edge are
  /// rejected.
  double minimumAspect = 0.02;

  /// Rasters with NODATA: a reflex vertex of a rim may be removed if the domain then extends at most this
  /// far, in samples, over NODATA, measured from the original rim. 0 keeps the rims exactly.
  double rimTolerance = 0;

  /// Vertices (sample or point indices) that stay in the root, beside the corners of the domain.
  std::vector<std::uint32_t> fixedVertices{};
};

/// @return the name that users type and that files contain: "delaunay" or "fidelity"
std::string_view toString(HoleShape shape);

/// Whether options are in range and fixed vertices among the samples. Errors: usage, naming the field.
Status checkOptions(const BuildOptions& options, std::size_t sampleCount);

}  // namespace arete
