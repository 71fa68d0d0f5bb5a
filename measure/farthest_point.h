// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "engine/base/triangle_mesh.h"
#include "measure/nearest_on_mesh.h"

namespace arete {

/// The largest distance found from the points of some triangles to a mesh, and an upper bound of it.
struct FarthestPoint {
  Vec3 from, nearest;
  double distance = -1;  ///< |from - nearest|
  double atMost = 0;     ///< upper bound: no point is farther, but for the rounding of doubles
};

struct FarthestPointOptions {
  double known = 0;           ///< a distance reached elsewhere: smaller ones need not be found
  double accuracy = 0.001;    ///< the search ends when atMost exceeds the largest distance by this fraction
  double slack = 0;           ///< or when atMost is no more than this
  std::uint64_t budget = 64;  ///< or after this many nearest-point queries
  std::function<bool()> shouldStop = {};  ///< or when this returns true; may be empty
};

/// The point of a triangle that is farthest from a mesh (one side of the Hausdorff distance), by branch and
/// bound [GutheBorodinKlein2005], [TangLeeKim2009]: the part of the triangle with the largest upper bound is
/// cut in two, at an edge of the target or in the middle, until the options end the search. O(budget log n)
/// time; at most 200 bytes per query.
/// @param answers  to.nearest() of the three corners
/// @param target  the mesh of `to`
FarthestPoint farthestPoint(const SpaceTriangle& triangle, std::span<const NearestOnMesh::Answer, 3> answers,
                            const TriangleMesh& target, const NearestOnMesh& to,
                            const FarthestPointOptions& options);

}  // namespace arete
