// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace arete {

/// How the hole that a removed vertex leaves is triangulated.
enum class HoleShape {
  delaunay,       ///< well-shaped triangles; every front is (constrained) Delaunay
  dataDependent,  ///< the least vertical error; far fewer triangles at the same bound
};

/// How a large build divides the ground (simplify.h). What comes out depends on it, but little, and keeps
/// every promise either way; a model does not remember it.
struct PieceOptions {
  std::uint32_t most = 1 << 13;   ///< vertices of a piece; what belongs to them takes about 1 MB
  std::uint32_t least = 1 << 12;  ///< the same, where larger pieces would be too few. 1 .. most
  std::uint32_t fewest = 8;       ///< fewer pieces are not made: all threads work together then. > 0
  /// The growth of the threshold in the levels that a piece goes through by itself; less for the fidelity
  /// shape. > 1
  double span = 1.5;
};

/// Options of a build. The defaults are what the figures in docs/performance.md are measured with.
struct BuildOptions {
  HoleShape shape = HoleShape::delaunay;

  /// A vertex with more neighbours waits until some of them are gone. 6 .. 32.
  std::uint32_t maxDegree = 14;

  /// A level admits removals whose error is under a threshold that grows by this ratio from the first level
  /// to the second, and by less from level to level the fewer vertices are left; by more where next to none
  /// would go (simplify.h). What it grows by is a fifth less for the fidelity shape. > 1.
  double thresholdRatio = 1.17;

  /// Fidelity only: triangles whose least altitude is below this part of their longest edge are rejected.
  double minimumAspect = 0.02;

  /// Rasters with NODATA: a reflex vertex of a rim may go when the domain then reaches at most this far, in
  /// samples, over NODATA, measured from the original rim. 0 keeps the rims exactly.
  double rimTolerance = 0;

  PieceOptions pieces{};

  /// Vertices (sample or point indices) that stay in the root, beside the domain's corners.
  std::vector<std::uint32_t> fixedVertices{};
};

std::string_view toString(HoleShape shape);

}  // namespace arete
