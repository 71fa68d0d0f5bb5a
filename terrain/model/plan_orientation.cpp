// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's exact predicate, and rational numbers for the weights.
#include "terrain/model/plan_orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

namespace arete {

int exactPlanOrientation(Vec2 a, Vec2 b, Vec2 c) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
  return static_cast<int>(CGAL::orientation(Point(a.x, a.y), Point(b.x, b.y), Point(c.x, c.y)));
}

std::array<double, 3> exactPlanWeights(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  using Exact = CGAL::Exact_rational;
  const auto twiceArea = [](Vec2 u, Vec2 v, Vec2 w) {
    const Exact x(w.x), y(w.y);
    return Exact((Exact(u.x) - x) * (Exact(v.y) - y) - (Exact(u.y) - y) * (Exact(v.x) - x));
  };
  const Exact area = twiceArea(a, b, c);
  const auto weight = [&](Vec2 u, Vec2 v) { return CGAL::to_double(Exact(twiceArea(u, v, p) / area)); };
  return {weight(b, c), weight(c, a), weight(a, b)};
}

}  // namespace arete
