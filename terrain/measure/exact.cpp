// SPDX-License-Identifier: GPL-3.0-or-later
//
// The place is held when it is right of none of the three sides: exact predicates. The weights of the corners
// are the areas that the place makes with the sides. Of doubles they are good to a few ulp of the products
// they are differences of; where that is not far below the triangle's area, as in a sliver, they are computed
// anew as rational numbers.
#include "terrain/measure/exact.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>

#include "terrain/model/plan_orientation.h"

namespace arete::measuring {

namespace {

using Exact = CGAL::Exact_rational;

Vec2 planOf(const Vec3& p) {
  return {p.x, p.y};
}

/// Twice the area of a, b, c, and how far from it the rounding of its terms may be.
struct Area {
  double value, doubt;
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

std::optional<Contact> contactWhereHeld(const std::array<Vec3, 3>& corner, Vec2 place) {
  const auto [xLow, xHigh] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
  const auto [yLow, yHigh] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
  if (!(place.x >= xLow && place.x <= xHigh && place.y >= yLow && place.y <= yHigh)) return std::nullopt;

  const Vec2 a = planOf(corner[0]), b = planOf(corner[1]), c = planOf(corner[2]);
  const int turn = planOrientation(a, b, c);
  if (turn == 0) return std::nullopt;
  const int left[] = {planOrientation(b, c, place) * turn, planOrientation(c, a, place) * turn,
                      planOrientation(a, b, place) * turn};
  if (std::ranges::min(left) < 0) return std::nullopt;
  const auto sides = std::ranges::count(left, 0);
  Contact contact{.covers = true, .strict = sides == 0, .z = 0, .turn = sides == 0 ? kFullTurn : kHalfTurn};
  for (int i = 0; i < 3; ++i) {
    if (place != planOf(corner[i])) continue;
    const Vec2 next = planOf(corner[(i + 1) % 3]), last = planOf(corner[(i + 2) % 3]);
    contact.z = corner[i].z;
    contact.turn = turn > 0 ? turnBetween(place, next, last) : turnBetween(place, last, next);
    return contact;
  }

  // Relative to one corner, so that a flat triangle is flat to the last bit.
  const double riseB = corner[1].z - corner[0].z, riseC = corner[2].z - corner[0].z;
  const Area whole = roundedArea(a, b, c), ofB = roundedArea(c, a, place), ofC = roundedArea(a, b, place);
  constexpr double kNegligible = 0x1p-40;
  if (whole.doubt + ofB.doubt + ofC.doubt < kNegligible * std::abs(whole.value)) {
    contact.z = corner[0].z + (ofB.value * riseB + ofC.value * riseC) / whole.value;
    return contact;
  }
  const Exact area = exactArea(a, b, c);
  contact.z = corner[0].z + CGAL::to_double(Exact(exactArea(c, a, place) / area)) * riseB +
              CGAL::to_double(Exact(exactArea(a, b, place) / area)) * riseC;
  return contact;
}

}  // namespace arete::measuring
