// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/mt/recorder.h"
#include "engine/simplify/live_mesh.h"

namespace arete {

/// What the levels leave over: the root of the MT.
struct SimplifiedRoot {
  std::vector<VertexId> vertices;
  std::vector<SurvivingTriangle> triangles;
  std::uint32_t levels = 0;
};

/// The vertices that are in a triangle, by their ids, and the live triangles, by their slots.
/// O(slots + vertices).
SimplifiedRoot rootOf(const LiveMesh& mesh, std::uint32_t levels);

}  // namespace arete
