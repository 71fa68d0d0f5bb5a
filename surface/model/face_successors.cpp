// SPDX-License-Identifier: GPL-3.0-or-later
//
// A remover is younger than the creator, so the ids of its star are higher: one pass from the last triangle
// to the first finds every face known that it reads.
#include "surface/model/face_successors.h"

#include <algorithm>

namespace arete {

std::uint32_t successorSlotOf(const MultiTriangulation& mt, TriangleId t, NodeId creator, NodeId node) {
  const auto corners = mt.corners(t, creator);
  const auto link = mt.link(node);
  const auto isCorner = [&](std::uint32_t v) { return std::ranges::find(corners, v) != corners.end(); };
  std::uint32_t heir = 0;
  int best = 0;
  for (std::uint32_t i = 0; i < mt.ceilingSize(node) && best < 2; ++i) {
    const int common = int(isCorner(link[i])) + int(isCorner(link[(i + 1) % link.size()]));
    if (common <= best) continue;
    best = common;
    heir = i;
  }
  return heir;
}

void inheritFaces(const MultiTriangulation& mt, std::span<std::uint32_t> faceOf) {
  for (std::uint32_t t = mt.triangleIdCount(); t-- > 0;) {
    const NodeId node = mt.remover(TriangleId(t));
    if (!node.isValid()) continue;
    const NodeId creator = mt.creator(TriangleId(t));
    if (creator == node) continue;  // a slot that is no triangle
    faceOf[t] = faceOf[mt.slotTriangle(node, successorSlotOf(mt, TriangleId(t), creator, node)).index()];
  }
}

}  // namespace arete
