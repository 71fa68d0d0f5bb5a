// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// Where the vertices of a surface are drawn in coarse cuts: a vertex at p is drawn at p + s d, where d is
/// its direction and s, which grows with the errors around it in the cut, its scale (displacedPlaces()).
///
/// What is certain: let E be at least the error of a triangle, m the length of the longest direction of its
/// corners. If the scale of each of its corners is from 0 to reach + (E - error) / m, then no point of the
/// source that the triangle stands for is farther than E from it as drawn (docs/decisions/0045).
struct SurfaceDisplacement {
  /// By vertex of the MT, in kStep. Empty: there is none.
  std::vector<std::array<std::int8_t, 3>> directions;
  /// By triangle of the MT, as a part of its error, in 1 / kWhole.
  std::vector<std::uint8_t> reaches;

  static constexpr double kStep = 1.0 / 32;
  static constexpr double kWhole = 255;

  bool isEmpty() const { return directions.empty(); }
  Vec3 direction(std::uint32_t vertex) const {
    const auto& [x, y, z] = directions[vertex];
    return Vec3{double(x), double(y), double(z)} * kStep;
  }
  /// @param error of the triangle
  double reach(std::uint32_t triangle, double error) const { return error * reaches[triangle] / kWhole; }

  bool operator==(const SurfaceDisplacement&) const = default;
};

}  // namespace arete
