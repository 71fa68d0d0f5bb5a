// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace arete {
namespace {

TEST(Region, ContainsItsInsideItsEdgesAndItsCorners) {
  const Region box = Region::box({1, 2, 5, 7});
  EXPECT_TRUE(box.contains({3, 4}));
  EXPECT_TRUE(box.contains({1, 4}));
  EXPECT_TRUE(box.contains({5, 7}));
  EXPECT_FALSE(box.contains({5.0001, 4}));
  EXPECT_FALSE(box.contains({3, 1.999}));
}

TEST(Region, LeavesHolesOutByTheEvenOddRule) {
  const Region ring({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{3, 3}, {7, 3}, {7, 7}, {3, 7}}});
  EXPECT_TRUE(ring.contains({1, 5}));
  EXPECT_FALSE(ring.contains({5, 5}));
  EXPECT_FALSE(ring.meetsDisc({5, 5}, 1.9));
  EXPECT_TRUE(ring.meetsDisc({5, 5}, 2.0));
  EXPECT_FALSE(ring.meetsTriangle({4, 4}, {6, 4}, {5, 6}));
  EXPECT_TRUE(ring.meetsTriangle({4, 4}, {6, 4}, {5, 8}));
}

TEST(Region, MeetsATriangleThatSwallowsIt) {
  EXPECT_TRUE(Region::box({4, 4, 5, 5}).meetsTriangle({0, 0}, {20, 0}, {0, 20}));
  EXPECT_TRUE(Region::box({4, 4, 5, 5}).meetsTriangle({0, 0}, {0, 20}, {20, 0})) << "either orientation";
  EXPECT_TRUE(Region::box({0, 0, 9, 9}).meetsTriangle({4, 4}, {5, 4}, {4, 5}));
}

TEST(Region, OfNothingMeetsNothing) {
  const Region empty({{{0, 0}, {1, 1}}});
  EXPECT_TRUE(empty.isEmpty());
  EXPECT_FALSE(empty.contains({0, 0}));
  EXPECT_FALSE(empty.meetsDisc({0, 0}, 100));
}

TEST(Region, AgreesWithPlainScansOverAllEdgesOnRandomStars) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 40; ++round) {
    std::vector<Vec2> ring;
    const int corners = 3 + int(unit(random) * 60);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * M_PI * i / corners, r = 2 + 8 * unit(random);
      ring.push_back({20 + r * std::cos(angle), 20 + r * std::sin(angle)});
    }
    const Region region({ring});
    for (int k = 0; k < 200; ++k) {
      const Vec2 p{8 + 24 * unit(random), 8 + 24 * unit(random)};
      bool inside = false;
      double nearest = 1e300;
      for (int i = 0; i < corners; ++i) {
        const Vec2 a = ring[i], b = ring[(i + 1) % corners];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
          inside = !inside;
        const double l = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
        const double t = std::clamp(((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / l, 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(a.x + t * (b.x - a.x) - p.x, a.y + t * (b.y - a.y) - p.y));
      }
      EXPECT_EQ(region.contains(p), inside) << round;
      EXPECT_TRUE(inside || region.meetsDisc(p, nearest * 1.000001)) << round;
      EXPECT_EQ(region.meetsDisc(p, nearest * 0.999999), inside) << round;
    }
  }
}

}  // namespace
}  // namespace arete
