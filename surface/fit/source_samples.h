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
};

/// @param count  of the area; the samples of the border are beside them
/// @param lines  pairs of vertices: edges that are sampled as borders are
/// The same for the same mesh. Empty without area. O(triangles + samples).
SourceSamples sampleSource(const TriangleMesh& source, std::uint64_t count,
                           const std::vector<std::array<std::uint32_t, 2>>& lines = {});

}  // namespace arete
