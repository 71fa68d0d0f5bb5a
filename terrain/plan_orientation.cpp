// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/plan_orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace arete {

int exactPlanOrientation(Vec2 a, Vec2 b, Vec2 c) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
  return static_cast<int>(CGAL::orientation(Point(a.x, a.y), Point(b.x, b.y), Point(c.x, c.y)));
}

}  // namespace arete
