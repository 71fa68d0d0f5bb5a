// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/vec.h"

namespace arete {

/// The surface that is simplified: faces are the triangles of its finest level. Refers to arrays of others.
struct OriginalSurface {
  std::span<const Vec3> positions;
  std::span<const std::array<std::uint32_t, 3>> faces;
  double largestCoordinate = 0;  ///< without sign

  SpaceTriangle face(std::uint32_t f) const {
    const auto& [a, b, c] = faces[f];
    return {positions[a], positions[b], positions[c]};
  }
};

}  // namespace arete
