// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// A function of the position: by component the value at a place, and how it changes along x, y and z.
struct AffineFunction {
  Vec3 origin{0, 0, 0};
  std::vector<double> value;
  std::vector<Vec3> gradient;

  double operator()(std::size_t component, const Vec3& p) const {
    return value[component] + dot(gradient[component], p - origin);
  }
};

/// The parts of a mesh that hang together by the elements of an attribute, and the affine function of the
/// position that each is, if it is one.
struct AffineCharts {
  std::vector<std::uint32_t> chartOf;                   ///< by element
  std::vector<std::optional<AffineFunction>> function;  ///< by chart

  /// @param elements   by triangle, below vertexOf.size()
  /// @param vertexOf   by element
  /// @param numbers    by element and component
  /// @param tolerance  how far rounding may have moved a number
  /// O(elements).
  AffineCharts(std::span<const std::array<std::uint32_t, 3>> elements,
               const std::vector<std::uint32_t>& vertexOf, const std::vector<Vec3>& positions,
               const std::vector<double>& numbers, std::size_t components, double tolerance);
};

}  // namespace arete
