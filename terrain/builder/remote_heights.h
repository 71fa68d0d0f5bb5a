// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/simplify/live_mesh.h"
#include "terrain/model/lone_heights.h"

namespace arete {

/// The range of heights within which the errors of a build lie.
struct ErrorRange {
  double low, high;
};

/// Heights that stand alone and remote (1e20 among hills) would make errors of hills indistinguishable:
/// errors are stored in 32 binades below the range of the heights. So the triangles that join them to other
/// heights stay in every level: their corners are fixed here. Then no triangle that is made has a remote
/// height in a corner or below it, unless all of it is level, and errors lie in the range of the other
/// heights.
///
/// Where that would fix more than a sixteenth of the vertices, nothing is fixed. O(triangles).
/// @param heightOf  of a vertex
/// @param isFixed  by vertex; corners of such triangles are set
/// @param whole  the range of all heights; returned where nothing is remote
template <class HeightOf>
ErrorRange fixRemoteHeights(const LiveMesh& mesh, const LoneHeights& lone, const HeightOf& heightOf,
                            ErrorRange whole, std::vector<std::uint8_t>& isFixed) {
  constexpr std::size_t kMostPart = 16, kFew = 64;
  if (!lone.areRemote()) return whole;
  std::vector<VertexId> corners;
  for (const LiveMesh::Triangle& triangle : mesh.triangles) {
    const LiveMesh::Corners& c = triangle.corners;
    const double z0 = heightOf(c[0]), z1 = heightOf(c[1]), z2 = heightOf(c[2]);
    const bool isLevel = z0 == z1 && z0 == z2;
    if (!isLevel && (lone.isLone(z0) || lone.isLone(z1) || lone.isLone(z2)))
      corners.insert(corners.end(), c.begin(), c.end());
  }
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  if (corners.size() > std::max(kFew, isFixed.size() / kMostPart)) return whole;
  for (const VertexId v : corners) isFixed[v.index()] = 1;
  return {lone.low, lone.high};
}

}  // namespace arete
