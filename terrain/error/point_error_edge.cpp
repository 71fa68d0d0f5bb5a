// SPDX-License-Identifier: GPL-3.0-or-later
//
// A straight walk along the segment a-b through the finest triangulation [DevillersPionTeillaud2002]. At a
// vertex on the segment, the walk turns through the vertex's star to the triangle that the segment enters, or
// to a neighbour that lies on the segment. Inside a triangle, the corner opposite the edge just crossed lies
// left of, right of or on the segment, which determines the next edge or vertex. Successive crossed edges
// share an end, whose ring gives the next corner. Every decision is an exact orientation; only the
// differences at the crossings are computed in doubles.
//
// Take the plane that rises along the segment and is level across it. Its difference from a vertex is one
// number, and its difference at a crossing lies between those of the two ends of the crossed edge. The bound
// includes the rounding errors: digits are lost where an end lies far from the segment; and where both ends
// are so near to the segment that their sides are all rounding, the crossing may be anywhere between them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "terrain/error/exact_error.h"
#include "terrain/error/point_error.h"

namespace arete {

template <class Visit>
EdgeDifference PointError::alongEdge(VertexId a, VertexId b, const Visit& visit) const {
  EdgeDifference found;
  SignedBound& bound = found.bound;
  const Vec3 pa = position(a), pb = position(b);
  const double dx = pb.x - pa.x, dy = pb.y - pa.y, climb = pb.z - pa.z, squared = dx * dx + dy * dy;
  // Where the squared length underflows, any height between those of the ends is possible at every point.
  const bool isShort = squared < 0x1p-900;
  const double rise = isShort ? 0 : climb / squared, unsure = isShort ? std::abs(climb) : 0;
  // The heights are rounded too; on level ground they are not.
  const double heightLost = climb == 0 ? 0 : 0x1p-50 * (std::abs(pa.z) + std::abs(climb));
  struct End {
    VertexId vertex;
    int sign = 0;           ///< exact: > 0 left of the segment, < 0 right of it
    double side = 0;        ///< twice the area of the segment and the vertex left of it
    double sideLost = 0;    ///< bounds the rounding error of `side`
    double difference = 0;  ///< z_plane - z_vertex
    double lost = 0;        ///< bounds the rounding error of `difference`
  };
  const auto endAt = [&](VertexId v) -> End {
    const Vec3& p = position(v);
    const double x = p.x - pa.x, y = p.y - pa.y, leftTerm = dx * y, rightTerm = dy * x,
                 side = leftTerm - rightTerm;
    const double alongX = x * dx, alongY = y * dy;
    const double difference = pa.z + (alongX + alongY) * rise - p.z;
    // The difference has a dozen roundings of each term, a side three; tiny products may have underflowed
    // [Shewchuk1997].
    const double lost =
        0x1p-49 * (std::abs(alongX) + std::abs(alongY)) * std::abs(rise) + heightLost + unsure;
    const double sideLost = 0x1p-51 * (std::abs(leftTerm) + std::abs(rightTerm)) + 0x1p-960;
    const int sign = int(side > sideLost) - int(side < -sideLost);
    const bool isCertain = sign != 0 || v == a || v == b;
    return {v, isCertain ? sign : plan_.orientation(a, b, v), side, sideLost, difference, lost};
  };
  // Precondition: both vertices lie on the segment's line.
  const auto isAhead = [&](VertexId from, VertexId v) {
    const Vec3 &p = position(v), &o = position(from);
    return dx != 0 ? (p.x > o.x) == (dx > 0) : (p.y > o.y) == (dy > 0);
  };
  const auto include = [&](double difference, double lost) {
    bound.include({lost - difference, lost + difference});
  };
  // A point on the segment is in the conflict list of one of the two triangles at the edge only; the other
  // one gets it here.
  const auto pass = [&](const End& end) {
    if (end.vertex == b) return;
    include(end.difference, end.lost);
    found.error = std::max(found.error, std::abs(end.difference));
    found.rounding = std::max(found.rounding, end.lost + 0x1p-52 * std::abs(end.difference));
    visit(end.vertex);
  };
  const auto cross = [&](const End& u, const End& w) {
    const double su = std::abs(u.side), sw = std::abs(w.side), sides = su + sw,
                 sidesLost = 2 * (u.sideLost + w.sideLost);
    const double apart = w.difference - u.difference, part = sides > 0 ? su / sides : 0;
    const double partLost = sidesLost < sides ? sidesLost / sides : 1;
    include(u.difference + part * apart, u.lost + w.lost + partLost * std::abs(apart));
  };

  for (VertexId at = a; at != b;) {
    // Leave the vertex `at`: to a neighbour on the segment, or into the triangle whose far edge it crosses.
    const std::span<const VertexId> ring = finest_.of(at);
    VertexId onward;
    bool isEntered = false;
    std::array<End, 2> ends;  // of the crossed edge: right and left
    ends[0] = ring.back().isValid() ? endAt(ring.back()) : End{};
    for (const VertexId neighbour : ring) {
      if (!neighbour.isValid()) break;
      ends[1] = endAt(neighbour);
      if (ends[1].sign == 0 && isAhead(at, neighbour)) {
        onward = neighbour;
        pass(ends[1]);
        break;
      }
      // Counter-clockwise: the segment leaves between a neighbour right of it and the next one left of it.
      isEntered = ends[0].sign < 0 && ends[1].sign > 0;
      if (isEntered) break;
      ends[0] = ends[1];
    }
    if (onward.isValid()) {
      at = onward;
      continue;
    }
    if (!isEntered) return found;  // along the hull, within rounding: no edge is crossed

    // From edge to edge around the end that both share, the pivot: the right end or the left.
    std::size_t pivot = 0;
    RingPlace place(finest_, ends[0].vertex, ends[1].vertex);
    for (;;) {
      cross(ends[0], ends[1]);
      const VertexId beyond = pivot == 0 ? place.previous() : place.next();
      if (!beyond.isValid()) return found;
      const End apex = endAt(beyond);
      if (apex.sign == 0) {
        at = beyond;
        pass(apex);
        break;
      }
      const auto side = static_cast<std::size_t>(apex.sign > 0);
      ends[side] = apex;
      if (side != pivot) continue;
      pivot = 1 - side;
      place = RingPlace(finest_, ends[pivot].vertex, beyond);
    }
  }
  return found;
}

bool PointError::isAboveOnEdge(VertexId a, VertexId b, double bound) const {
  bool isAbove = false;
  alongEdge(a, b, [&](VertexId p) {
    isAbove = isAbove || isErrorAboveOnLine(position(a), position(b), position(p), bound);
  });
  return isAbove;
}

EdgeDifference PointError::alongEdge(VertexId a, VertexId b) const {
  return alongEdge(a, b, [](VertexId) {});
}

}  // namespace arete
