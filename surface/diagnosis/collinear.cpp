// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "surface/diagnosis/parts.h"

namespace arete::diagnosis {

bool areCollinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  return CGAL::collinear(Point(a.x, a.y, a.z), Point(b.x, b.y, b.z), Point(c.x, c.y, c.z));
}

}  // namespace arete::diagnosis
