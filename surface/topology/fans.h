// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "surface/topology/edges.h"

namespace arete {

/// A fan of a vertex. Fans are numbered from 0 in the order of their first corners.
using FanId = Id<struct FanTag>;

/// The fans of a mesh: the corners at a vertex whose triangles follow each other across edges with two sides.
/// A vertex with one fan is manifold.
struct MeshFans {
  UninitializedVector<FanId> fanOf;     ///< by corner
  std::vector<VertexId> vertexOf;       ///< by fan
  std::vector<std::uint32_t> fanCount;  ///< by vertex; 0 where no triangle uses it

  /// O(corners), nearly.
  explicit MeshFans(const MeshEdges& edges);
};

}  // namespace arete
