// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/triangle_mesh.h"

namespace arete {

/// Points of a surface, each for as much area, and points of its borders, each for as much length as a square
/// of that area is wide.
struct SourceSamples {
  std::vector<Vec3> ofArea, ofBorder;
};

/// @param count  of the area; those of the border are beside them
/// The same for the same mesh. Empty without area. O(triangles + samples).
SourceSamples sampleSource(const TriangleMesh& source, std::uint64_t count);

}  // namespace arete
