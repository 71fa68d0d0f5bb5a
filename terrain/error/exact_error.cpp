// SPDX-License-Identifier: GPL-3.0-or-later
//
// Multiplied by the triangle's doubled area, a difference is a polynomial in the coordinates: no division, so
// the ring of dyadic numbers is enough, and doubles are dyadic.
#include "terrain/error/exact_error.h"

#include <CGAL/Mpzf.h>

namespace arete {
namespace {

using Exact = CGAL::Mpzf;

struct Difference {
  Exact numerator, denominator;  // the denominator is the triangle's doubled area
};

Difference differenceAt(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Exact ax(a.x), ay(a.y), az(a.z);
  const Exact bx = Exact(b.x) - ax, by = Exact(b.y) - ay, cx = Exact(c.x) - ax, cy = Exact(c.y) - ay,
              x = Exact(p.x) - ax, y = Exact(p.y) - ay;
  const Exact area = bx * cy - by * cx;
  return {(Exact(b.z) - az) * (x * cy - y * cx) + (Exact(c.z) - az) * (bx * y - by * x) -
              (Exact(p.z) - az) * area,
          area};
}

}  // namespace

bool isErrorAbove(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, double bound) {
  const Difference difference = differenceAt(a, b, c, p);
  return CGAL::abs(difference.numerator) > Exact(bound) * difference.denominator;
}

bool isErrorAboveOnLine(const Vec3& a, const Vec3& b, const Vec3& p, double bound) {
  // By the coordinate that differs: any does, as p is on the line.
  const bool isAlongX = a.x != b.x;
  const Exact start(isAlongX ? a.x : a.y), whole = Exact(isAlongX ? b.x : b.y) - start,
                                           part = Exact(isAlongX ? p.x : p.y) - start;
  const Exact difference = (Exact(a.z) - Exact(p.z)) * whole + (Exact(b.z) - Exact(a.z)) * part;
  return CGAL::abs(difference) > Exact(bound) * CGAL::abs(whole);
}

int signAt(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  return static_cast<int>(CGAL::sign(differenceAt(a, b, c, p).numerator));
}

int signAtCrossing(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  // With u = b - a and v = q - p: a + s u and p + t v share a plan position; s and t have the denominator u x
  // v.
  const Exact ux = Exact(b.x) - Exact(a.x), uy = Exact(b.y) - Exact(a.y), vx = Exact(q.x) - Exact(p.x),
              vy = Exact(q.y) - Exact(p.y), x = Exact(p.x) - Exact(a.x), y = Exact(p.y) - Exact(a.y);
  const Exact whole = ux * vy - uy * vx;
  const Exact difference = (Exact(a.z) - Exact(p.z)) * whole + (x * vy - y * vx) * (Exact(b.z) - Exact(a.z)) -
                           (x * uy - y * ux) * (Exact(q.z) - Exact(p.z));
  return static_cast<int>(CGAL::sign(difference)) * static_cast<int>(CGAL::sign(whole));
}

}  // namespace arete
