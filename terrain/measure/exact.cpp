// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangle holds the point when it lies to the right of none of the three sides: exact predicates. The
// barycentric weights are the areas of the triangles that the point makes with the sides. In doubles these
// are exact to a few ulp of the products that they are differences of. Where that is not far below the
// triangle's area, as in a sliver, they are recomputed as rational numbers.
#include "terrain/measure/exact.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Mpzf.h>

#include <algorithm>
#include <cmath>

#include "terrain/model/plan_orientation.h"

namespace arete::measuring {

namespace {

using Exact = CGAL::Exact_rational;

Vec2 planOf(const Vec3& p) {
  return {p.x, p.y};
}

/// Twice the area of a triangle, and a bound of its rounding error.
struct Area {
  double value, error;
};

Area roundedArea(Vec2 a, Vec2 b, Vec2 c) {
  constexpr double kRelative = 0x1p-50;
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  return {left - right, kRelative * (std::abs(left) + std::abs(right))};
}

Exact exactArea(Vec2 a, Vec2 b, Vec2 c) {
  const Exact x(c.x), y(c.y);
  return (Exact(a.x) - x) * (Exact(b.y) - y) - (Exact(a.y) - y) * (Exact(b.x) - x);
}

}  // namespace

std::optional<Contact> contactWhereHeld(const std::array<Vec3, 3>& corner, Vec2 point) {
  const auto [xLow, xHigh] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
  const auto [yLow, yHigh] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
  if (!(point.x >= xLow && point.x <= xHigh && point.y >= yLow && point.y <= yHigh)) return std::nullopt;

  const Vec2 a = planOf(corner[0]), b = planOf(corner[1]), c = planOf(corner[2]);
  const int turn = planOrientation(a, b, c);
  if (turn == 0) return std::nullopt;
  const int left[] = {planOrientation(b, c, point) * turn, planOrientation(c, a, point) * turn,
                      planOrientation(a, b, point) * turn};
  if (std::ranges::min(left) < 0) return std::nullopt;
  const auto sides = std::ranges::count(left, 0);
  Contact contact{.covers = true, .strict = sides == 0, .z = 0, .turn = sides == 0 ? kFullTurn : kHalfTurn};
  for (int i = 0; i < 3; ++i) {
    if (point != planOf(corner[i])) continue;
    const Vec2 next = planOf(corner[(i + 1) % 3]), last = planOf(corner[(i + 2) % 3]);
    contact.z = corner[i].z;
    contact.turn = turn > 0 ? turnBetween(point, next, last) : turnBetween(point, last, next);
    return contact;
  }

  // Relative to one corner, so that a flat triangle is flat to the last bit.
  const double riseB = corner[1].z - corner[0].z, riseC = corner[2].z - corner[0].z;
  const Area whole = roundedArea(a, b, c), ofB = roundedArea(c, a, point), ofC = roundedArea(a, b, point);
  constexpr double kNegligible = 0x1p-40;
  if (whole.error + ofB.error + ofC.error < kNegligible * std::abs(whole.value)) {
    contact.z = corner[0].z + (ofB.value * riseB + ofC.value * riseC) / whole.value;
    return contact;
  }
  const Exact area = exactArea(a, b, c);
  contact.z = corner[0].z + CGAL::to_double(Exact(exactArea(c, a, point) / area)) * riseB +
              CGAL::to_double(Exact(exactArea(a, b, point) / area)) * riseC;
  return contact;
}

std::optional<double> errorWhereHeld(const std::array<Vec3, 3>& corner, const Vec3& sample) {
  double sum = sample.x + sample.y + sample.z;
  for (const Vec3& c : corner) sum += c.x + c.y + c.z;
  if (!std::isfinite(sum)) return std::nullopt;
  using Number = CGAL::Mpzf;  // dyadic: products and sums of doubles are exact
  const Number x(sample.x), y(sample.y), z(sample.z);
  std::array<Number, 3> dx, dy;
  for (int i = 0; i < 3; ++i) {
    dx[i] = Number(corner[i].x) - x;
    dy[i] = Number(corner[i].y) - y;
  }
  std::array<Number, 3> weight;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    weight[i] = dx[j] * dy[k] - dy[j] * dx[k];
  }
  const Number area = weight[0] + weight[1] + weight[2];
  const auto turn = CGAL::sign(area);
  if (turn == CGAL::ZERO) return std::nullopt;
  Number error;
  for (int i = 0; i < 3; ++i) {
    if (CGAL::sign(weight[i]) == -turn) return std::nullopt;
    error = error + weight[i] * (Number(corner[i].z) - z);
  }
  return CGAL::to_double(error) / CGAL::to_double(area);
}

}  // namespace arete::measuring
