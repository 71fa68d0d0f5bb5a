// SPDX-License-Identifier: GPL-3.0-or-later
//
// Multiplied by the triangle's doubled area, the difference is a polynomial in the coordinates: no division,
// so the ring of dyadic numbers is enough, and doubles are dyadic.
#include "terrain/error/exact_error.h"

#include <CGAL/Mpzf.h>

#include <cmath>

namespace arete {

bool isErrorAbove(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, double bound) {
  using Exact = CGAL::Mpzf;
  const Exact ax(a.x), ay(a.y), az(a.z);
  const Exact bx = Exact(b.x) - ax, by = Exact(b.y) - ay, cx = Exact(c.x) - ax, cy = Exact(c.y) - ay,
              x = Exact(p.x) - ax, y = Exact(p.y) - ay;
  const Exact area = bx * cy - by * cx;
  const Exact difference = (Exact(b.z) - az) * (x * cy - y * cx) + (Exact(c.z) - az) * (bx * y - by * x) -
                           (Exact(p.z) - az) * area;
  return CGAL::abs(difference) > Exact(bound) * area;
}

}  // namespace arete
