// SPDX-License-Identifier: GPL-3.0-or-later
//
// Differences are multiplied by their denominators, which are areas: what is left are sums of products of
// doubles, in a ring of dyadic numbers.
#include "terrain/laws/error_law.h"

#include <CGAL/Mpzf.h>

namespace arete::laws {
namespace {

using Number = CGAL::Mpzf;

struct Point {
  Number x, y, z;
  explicit Point(const Vec3& p) : x(p.x), y(p.y), z(p.z) {}
};

Number doubledArea(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool isAtMost(const Number& numerator, const Number& denominator, double bound) {
  return numerator <= Number(bound) * denominator;
}

}  // namespace

bool holdAtSample(const StoredErrors& stored, const std::array<Vec3, 3>& corner, const Vec3& sample) {
  const Point a(corner[0]), b(corner[1]), c(corner[2]), p(sample);
  const Number area = doubledArea(a, b, c);
  const Number difference = doubledArea(p, b, c) * (a.z - p.z) + doubledArea(a, p, c) * (b.z - p.z) +
                            doubledArea(a, b, p) * (c.z - p.z);
  return isAtMost(difference, area, stored.above) && isAtMost(-difference, area, stored.below) &&
         isAtMost(CGAL::abs(difference), area, stored.error);
}

bool holdAtCrossing(const StoredErrors& stored, const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  const Point from(a), to(b), first(p), second(q);
  // The crossing is the part ofA / whole of a-b and the part ofP / across of p-q.
  const Number ofA = doubledArea(first, second, from), whole = ofA - doubledArea(first, second, to);
  const Number ofP = doubledArea(from, to, first), across = ofP - doubledArea(from, to, second);
  Number difference = (from.z * whole + ofA * (to.z - from.z)) * across -
                      (first.z * across + ofP * (second.z - first.z)) * whole;
  Number denominator = whole * across;
  if (CGAL::sign(denominator) == CGAL::NEGATIVE) {
    denominator = -denominator;
    difference = -difference;
  }
  return isAtMost(difference, denominator, stored.above) && isAtMost(-difference, denominator, stored.below);
}

}  // namespace arete::laws
