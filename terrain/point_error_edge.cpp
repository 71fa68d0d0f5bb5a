// SPDX-License-Identifier: GPL-3.0-or-later
//
// The walk along a segment a-b through the finest triangulation: at a vertex on the segment, turn through its
// star to the triangle that the segment enters (or to a neighbour that lies on it); inside a triangle, the
// corner opposite the edge just crossed lies left of, right of or on the segment, which names the next edge
// or vertex. Edges that are crossed one after the other share an end, whose ring names the next corner. Every
// decision is an exact orientation; only the differences at the crossings are computed in doubles.
//
// Over the plane that rises along the segment and is level across it, the difference of a vertex is one
// number, and that of a crossing lies between those of the crossed edge's ends. Where these are far larger
// than what lies between them digits are lost, which the bound allows for.
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "terrain/point_error.h"

namespace arete {

SignedBound PointError::alongEdge(std::uint32_t a, std::uint32_t b) const {
  SignedBound bound;
  const Vec3 pa = points_[a], pb = points_[b];
  const double dx = pb.x - pa.x, dy = pb.y - pa.y, rise = (pb.z - pa.z) / (dx * dx + dy * dy);
  struct End {
    std::uint32_t vertex = kNone;
    int sign = 0;           ///< exact: > 0 left of the segment, < 0 right of it
    double side = 0;        ///< twice the area of the segment and the vertex left of it
    double difference = 0;  ///< of the plane from the vertex
  };
  const auto endAt = [&](std::uint32_t v) -> End {
    const Vec3& p = points_[v];
    const double x = p.x - pa.x, y = p.y - pa.y, forth = dx * y, back = dy * x, side = forth - back;
    const double difference = pa.z + (x * dx + y * dy) * rise - p.z;
    // Each term has three roundings, and so small ones may have lost their digits (Shewchuk 1997, section 4).
    const double margin = 0x1p-51 * (std::abs(forth) + std::abs(back)) + 0x1p-960;
    const int sign = int(side > margin) - int(side < -margin);
    const bool isCertain = sign != 0 || v == a || v == b;
    return {v, isCertain ? sign : plan_.orientation(a, b, v), side, difference};
  };
  const auto isAhead = [&](std::uint32_t from, std::uint32_t v) {
    const Vec3 &p = points_[v], &o = points_[from];
    return (p.x - o.x) * dx + (p.y - o.y) * dy > 0;
  };
  // A point on the segment travels with one of the two triangles at the edge; the bound of the other needs
  // it.
  const auto pass = [&](const End& end) {
    if (end.vertex != b) bound.include(end.difference);
  };
  const auto cross = [&](const End& u, const End& w) {
    const double su = std::abs(u.side), sw = std::abs(w.side);
    if (su + sw == 0) return;
    const double difference = u.difference + su / (su + sw) * (w.difference - u.difference);
    const double lost = 0x1p-48 * (std::abs(u.difference) + std::abs(w.difference));
    bound.include({lost - difference, lost + difference});
  };

  for (std::uint32_t at = a; at != b;) {
    // Out of the vertex `at`: a neighbour on the segment, or the triangle whose far edge the segment crosses.
    const std::span<const std::uint32_t> ring = finest_.of(at);
    std::uint32_t onward = kNone;
    bool isEntered = false;
    std::array<End, 2> ends;  // of the crossed edge: right and left
    ends[0] = ring.back() == kNone ? End{} : endAt(ring.back());
    for (const std::uint32_t neighbour : ring) {
      if (neighbour == kNone) break;
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
    if (onward != kNone) {
      at = onward;
      continue;
    }
    if (!isEntered) return bound;  // along the hull, within rounding of it: nothing is crossed

    // From edge to edge around the end that stays, which is the right one or the left.
    std::size_t pivot = 0;
    RingPlace place(finest_, ends[0].vertex, ends[1].vertex);
    for (;;) {
      cross(ends[0], ends[1]);
      const std::uint32_t beyond = pivot == 0 ? place.previous() : place.next();
      if (beyond == kNone) return bound;
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
  return bound;
}

}  // namespace arete
