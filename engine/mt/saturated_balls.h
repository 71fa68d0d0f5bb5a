// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/mt/enclosing_ball.h"

namespace arete {

/// The saturated balls of all nodes for moved vertices, as a build makes them: around each node's star and
/// its children's balls (law 6). O(slots).
/// @param place place(vertex index) returns the new position of a vertex, in metric space.
template <class Place>
std::vector<Sphere> saturatedBalls(const MultiTriangulation& mt, const Place& place) {
  std::vector<Sphere> balls(mt.nodeCount());
  std::vector<Vec3> star;
  for (std::uint32_t n = mt.nodeCount(); n-- > 0;) {
    const NodeId node(n);
    star.clear();
    star.push_back(place(mt.apex(node).index()));
    for (const std::uint32_t v : mt.link(node)) star.push_back(place(v));
    EnclosingBall ball = EnclosingBall::around(star);
    for (std::uint32_t i = 0; i < mt.ceilingSize(node); ++i)
      if (const NodeId child = mt.remover(mt.slotTriangle(node, i)); child.isValid())
        ball.encloseChild(balls[child.index()]);
    balls[n] = ball.rounded();
  }
  return balls;
}

}  // namespace arete
