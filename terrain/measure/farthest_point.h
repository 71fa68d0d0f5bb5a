// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "engine/base/triangle_mesh.h"
#include "terrain/measure/nearest_on_mesh.h"

namespace arete {

/// How far the points of some triangles are from a mesh: the farthest found, and what none can exceed.
struct FarthestPoint {
  Vec3 from, nearest;
  double distance = -1;  ///< |from - nearest|
  double atMost = 0;     ///< no point is farther, but for the rounding of doubles
};

struct FarthestPointOptions {
  double known = 0;           ///< a distance that is reached: nothing below it is of interest
  double accuracy = 0.001;    ///< atMost may be this fraction above the farthest point known or found
  double slack = 0;           ///< and atMost may be this much in any case
  std::uint64_t budget = 64;  ///< points to ask for, at most, within the triangle
  std::function<bool()> shouldStop = {};
};

/// The farthest point of one triangle. `answers` are those of `to` for the corners. Pieces of the triangle
/// are halved, the one that may hold the farthest point first, until none may hold one that is farther than
/// options allow, or the budget is spent. O(budget log n) time; 200 bytes for each point asked for at
/// worst.
FarthestPoint farthestPoint(const SpaceTriangle& triangle, std::span<const NearestOnMesh::Answer, 3> answers,
                            const TriangleMesh& target, const NearestOnMesh& to,
                            const FarthestPointOptions& options);

}  // namespace arete
