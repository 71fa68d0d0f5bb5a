// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/morph/geomorph.h"

namespace arete {

/// The largest vertical distance between the floor and the ceiling of a node, with vertices moved by
/// offset(vertex): the height by which the surface pops when the node is applied or undone. Both are linear
/// between the vertex, the link and the points where spokes of the star cross inner edges of the floor, so
/// the maximum is at one of these. O(k^2), k the vertex's degree.
/// @param node morphNode() of n.
/// @param offset offset(vertex index) returns a height.
template <class Offset>
double heightPopping(const MultiTriangulation& mt, NodeId n, const MorphNode& node, const Offset& offset) {
  struct Corner {
    std::uint32_t id;
    double x, y, z;  // from the vertex, moved
  };
  const VertexId apex = mt.apex(n);
  const Vec3 v = mt.position(apex);
  const double own = offset(apex.index());
  thread_local std::vector<Corner> link;
  link.clear();
  for (const std::uint32_t id : mt.link(n)) {
    const Vec3 p = mt.position(VertexId(id));
    const double moved = offset(id);
    link.push_back({id, p.x - v.x, p.y - v.y, p.z - v.z + moved - own});
  }
  double jump =
      std::abs(node.detail + own -
               node.interpolate(offset(node.corner[0]), offset(node.corner[1]), offset(node.corner[2])));
  const auto corner = [&](std::uint32_t id) -> const Corner& {
    return *std::ranges::find(link, id, &Corner::id);
  };
  for (const std::uint32_t t : mt.floor(n)) {
    const auto ids = mt.corners(TriangleId(t));
    for (int i = 0; i < 3; ++i) {
      // An inner edge belongs to two triangles, in opposite directions: one of them suffices.
      if (ids[i] > ids[(i + 1) % 3]) continue;
      const Corner &a = corner(ids[i]), &b = corner(ids[(i + 1) % 3]);
      const double dx = b.x - a.x, dy = b.y - a.y, side = a.x * dy - a.y * dx;  // of the vertex
      for (const Corner& spoke : link) {
        if (spoke.id == a.id || spoke.id == b.id) continue;
        const double across = spoke.x * dy - spoke.y * dx;  // the spoke's end is at side - across
        // Crossed at share s of the spoke, strictly inside.
        if (!(side > 0 ? across > side : across < side) || side == 0) continue;
        const double s = side / across, x = s * spoke.x - a.x, y = s * spoke.y - a.y;
        const double along = (x * dx + y * dy) / (dx * dx + dy * dy);
        if (!(along > 0 && along < 1)) continue;
        jump = std::max(jump, std::abs(s * spoke.z - (a.z + along * (b.z - a.z))));
      }
    }
  }
  return jump;
}

}  // namespace arete
