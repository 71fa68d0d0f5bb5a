// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/triangle_mesh.h"

namespace arete {

/// Points of a surface, each for as much area, and points of its borders, each for as much length as a square
/// of that area is wide.
struct SourceSamples {
  /// Where in the source a sample of the area is: a triangle, and the shares of its corners.
  struct Where {
    std::uint32_t triangle = 0;
    std::array<double, 3> shares{};
  };
  std::vector<Vec3> ofArea, ofBorder;
  std::vector<Where> whereOfArea = {};
  double width = 0;  ///< of the square that a sample of the area stands for
};

/// @param count  of the area; the samples of the border are beside them
/// The same for the same mesh. Empty without area. O(triangles + samples).
SourceSamples sampleSource(const TriangleMesh& source, std::uint64_t count);

}  // namespace arete
