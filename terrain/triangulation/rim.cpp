// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distance: the measure of [DouglasPeucker1973]. Let the new border edge replace the original rim vertices u
// between its ends. Every point of the edge, and of the fill behind it, is within max dist(u, line) of the
// original rim: the perpendicular through the point meets the original chain between the line and the chain's
// farthest vertex. The distance is always to the original rim, so that the steps do not add up.
//
// Overlap: if no vertex of the triangulation lies in a fill, no edge crosses it either. Such an edge would
// have to enter and leave through the fill's one free side, and a straight segment cannot.
#include "terrain/triangulation/rim.h"

#include <algorithm>
#include <cmath>

namespace arete {

Rim::Rim(const LiveMesh& mesh, const LatticePlan& plan, double tolerance)
    : mesh_(mesh),
      plan_(plan),
      tolerance_(tolerance),
      originalNext_(mesh.vertexCount(), VertexId()),
      originalPrevious_(mesh.vertexCount(), VertexId()),
      claimedAt_(mesh.vertexCount(), 0u) {
  for (const LiveMesh::Triangle& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (!triangle.twin[i].isValid()) {
        const VertexId from = triangle.corners[i], to = triangle.corners[(i + 1) % 3];
        originalNext_[from] = to;
        originalPrevious_[to] = from;
      }
}

bool Rim::mayFill(VertexId before, VertexId v, VertexId after) const {
  const Vec2 a = plan_.planPosition(before), b = plan_.planPosition(after), o = plan_.planPosition(v);
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  const auto isNear = [&](VertexId u) {
    const Vec2 p = plan_.planPosition(u);
    return std::abs(dx * (p.y - a.y) - dy * (p.x - a.x)) <= tolerance_ * length * (1 + 1e-12);
  };
  // At a pinched vertex the chain of next and previous vertices can be wrong: a walk that does not arrive
  // within the limit means no.
  constexpr int kLongestChain = 4096;
  int steps = 0;
  for (VertexId u = v; u != after; u = originalNext_[u])
    if (!u.isValid() || ++steps > kLongestChain || !isNear(u)) return false;
  for (VertexId u = v; u != before; u = originalPrevious_[u])
    if (!u.isValid() || ++steps > kLongestChain || !isNear(u)) return false;

  const auto columnLow = static_cast<std::int64_t>(std::min({a.x, b.x, o.x}));
  const auto columnHigh = static_cast<std::int64_t>(std::max({a.x, b.x, o.x}));
  const auto rowLow = static_cast<std::int64_t>(std::min({a.y, b.y, o.y}));
  const auto rowHigh = static_cast<std::int64_t>(std::max({a.y, b.y, o.y}));
  for (std::int64_t row = rowLow; row <= rowHigh; ++row)
    for (std::int64_t column = columnLow; column <= columnHigh; ++column) {
      const VertexId u(static_cast<std::uint32_t>(row * plan_.columns() + column));
      if (u == before || u == v || u == after || !mesh_.isInTriangle(u)) continue;
      // The fill is the triangle before, after, v seen from outside: clockwise in the domain's sense.
      if (plan_.orientation(before, v, u) <= 0 && plan_.orientation(v, after, u) <= 0 &&
          plan_.orientation(after, before, u) <= 0)
        return false;
    }
  return true;
}

bool Rim::claim(VertexId before, VertexId after, std::uint32_t level) {
  if (claimedAt_[before] == level || claimedAt_[after] == level) return false;
  claimedAt_[before] = claimedAt_[after] = level;
  return true;
}

void Rim::closeVoid(LiveMesh& mesh, HalfedgeId newBorderHalfedge) {
  const VertexId from = mesh.origin(newBorderHalfedge),
                 to = mesh.origin(LiveMesh::nextInTriangle(newBorderHalfedge));
  const auto runsBack = [&](HalfedgeId h) {
    return !mesh.twinOf(h).isValid() && mesh.origin(h) == to &&
           mesh.origin(LiveMesh::nextInTriangle(h)) == from;
  };
  // The edge back is the first of the fan of `to` and the last of the fan of `from`. A pinched vertex has
  // several fans: then the other end is tried.
  HalfedgeId back = mesh.vertexHalfedge[to];
  if (!runsBack(back)) {
    back = LiveMesh::previousInTriangle(newBorderHalfedge);
    while (mesh.twinOf(back).isValid()) back = LiveMesh::previousInTriangle(mesh.twinOf(back));
    if (!runsBack(back)) return;
  }
  mesh.setTwin(newBorderHalfedge, back);
  mesh.setTwin(back, newBorderHalfedge);
}

}  // namespace arete
