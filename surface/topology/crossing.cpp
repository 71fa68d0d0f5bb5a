// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/topology/crossing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <utility>

namespace arete {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point point(const Vec3& p) {
  return {p.x, p.y, p.z};
}
Kernel::Triangle_3 triangle(const PlacedTriangle& t) {
  return {point(t.places[0]), point(t.places[1]), point(t.places[2])};
}
/// The side opposite the first corner.
Kernel::Segment_3 side(const PlacedTriangle& t) {
  return {point(t.places[1]), point(t.places[2])};
}
void swapCorners(PlacedTriangle& t, std::size_t i, std::size_t j) {
  std::swap(t.vertices[i], t.vertices[j]);
  std::swap(t.places[i], t.places[j]);
}

/// Permutes both so that the shared vertices come first, in the same order. Returns how many there are.
std::size_t alignShared(PlacedTriangle& s, PlacedTriangle& t) {
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = shared; j < 3; ++j)
      if (s.vertices[i] == t.vertices[j]) {
        swapCorners(t, shared, j);
        swapCorners(s, shared, i);
        ++shared;
        break;
      }
  return shared;
}

}  // namespace

bool cross(PlacedTriangle s, PlacedTriangle t) {
  switch (alignShared(s, t)) {
    case 0:
      return CGAL::do_intersect(triangle(s), triangle(t));
    case 1:
      return CGAL::do_intersect(triangle(s), side(t)) || CGAL::do_intersect(triangle(t), side(s));
    case 2: {
      const Point a = point(s.places[0]), b = point(s.places[1]), c = point(s.places[2]),
                  d = point(t.places[2]);
      return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
    }
    default:
      return true;
  }
}

}  // namespace arete
