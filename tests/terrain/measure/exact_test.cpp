// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/measure/exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace arete {
namespace {

using measuring::contactWhereHeld;

/// Twice the area of three places of whole numbers, which is exact.
std::int64_t area(const std::array<std::int64_t, 2>& a, const std::array<std::int64_t, 2>& b,
                  const std::array<std::int64_t, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

TEST(MeasureExact, AgreesWithWholeNumbersOnSliversFarFromTheOrigin) {
  std::mt19937 random(5);
  int held = 0, onEdge = 0, flat = 0;
  for (int trial = 0; trial < 200'000; ++trial) {
    const auto upTo = [&](std::int64_t n) {
      return std::uniform_int_distribution<std::int64_t>(0, n)(random);
    };
    // Along a line, a few units to its sides: triangles of area 1 between corners 2^28 apart are common.
    const std::int64_t reach = std::int64_t{1} << (4 + trial % 25);
    std::array<std::array<std::int64_t, 2>, 4> at;
    for (auto& p : at) {
      const std::int64_t along = upTo(reach);
      p = {3 * along + upTo(2), 2 * along + upTo(2)};
    }
    const std::int64_t turn = area(at[0], at[1], at[2]), sign = turn < 0 ? -1 : 1;
    const std::int64_t w0 = sign * area(at[1], at[2], at[3]), w1 = sign * area(at[2], at[0], at[3]),
                       w2 = sign * area(at[0], at[1], at[3]);
    const bool isHeld = turn != 0 && w0 >= 0 && w1 >= 0 && w2 >= 0;
    // The same places on a grid of 2^-4 units, 2^40 units away: still exact in doubles.
    std::array<Vec3, 3> corner;
    const auto place = [&](int i) {
      return Vec2{0x1p40 + 0x1p-4 * double(at[i][0]), 0x1p-4 * double(at[i][1]) - 0x1p40};
    };
    for (int i = 0; i < 3; ++i) corner[i] = {place(i).x, place(i).y, double(upTo(9000))};
    const auto contact = contactWhereHeld(corner, place(3));
    ASSERT_EQ(contact.has_value(), isHeld) << trial;
    held += isHeld;
    onEdge += isHeld && (w0 == 0 || w1 == 0 || w2 == 0);
    flat += turn == 0;
    if (!isHeld) continue;
    const long double expected =
        ((long double)(w0)*corner[0].z + (long double)(w1)*corner[1].z + (long double)(w2)*corner[2].z) /
        (long double)(sign * turn);
    ASSERT_NEAR(contact->z, double(expected), 1e-8) << trial;
    const int sides = (w0 == 0) + (w1 == 0) + (w2 == 0);
    ASSERT_EQ(contact->strict, sides == 0) << trial;
    if (sides < 2) {
      ASSERT_EQ(contact->turn, sides == 0 ? measuring::kFullTurn : measuring::kHalfTurn) << trial;
    } else {
      ASSERT_TRUE(contact->turn >= 0 && contact->turn <= measuring::kHalfTurn) << trial;
    }
  }
  EXPECT_GT(held, 5000);
  EXPECT_GT(onEdge, 500);
  EXPECT_GT(flat, 500);
}

TEST(MeasureExact, TurnsAroundACornerOfSliversAddUpToOne) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    // A fan around a place, on a plan that is squeezed to a line.
    const double thin = std::pow(10, -trial % 14);
    const Vec2 middle{1e6 * unit(random), 1e6 * unit(random)};
    std::vector<Vec3> rim;
    for (int i = 0; i < 9; ++i) {
      const double angle = (i + 0.4 * unit(random)) * 2 * 3.14159265 / 9;
      const double along = std::cos(angle), beside = thin * std::sin(angle);
      rim.push_back({middle.x + 3 * along - 2 * beside, middle.y + 2 * along + 3 * beside, 0});
    }
    float turn = 0;
    int held = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const auto contact =
          contactWhereHeld({Vec3{middle.x, middle.y, 1}, rim[i], rim[(i + 1) % rim.size()]}, middle);
      if (!contact) continue;
      ++held;
      turn += contact->turn;
    }
    // Squeezed to rounding the fan folds over.
    if (thin >= 1e-8) {
      EXPECT_EQ(held, 9) << trial;
      EXPECT_NEAR(turn, measuring::kFullTurn, 1e-4) << trial;
    }
  }
}

}  // namespace
}  // namespace arete
