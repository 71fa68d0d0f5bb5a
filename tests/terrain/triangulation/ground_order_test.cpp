// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/triangulation/ground_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "datasets/families.h"

namespace arete {
namespace {

TEST(GroundOrder, HasEveryPointOnce) {
  EXPECT_TRUE(groundOrder({}).empty());
  for (const PointFamily& family : pointFamilies()) {
    const PointHeightfield field = family.make(500, 3);
    std::vector<std::uint32_t> order = groundOrder(field.positions), all(field.size());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_TRUE(std::ranges::is_permutation(order, all)) << family.name;
  }
}

TEST(GroundOrder, FollowsTheCurveOfHilbertFromCellToNeighbouringCell) {
  std::vector<Vec2> grid;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) grid.push_back({100.0 + x, -50.0 + y});
  const std::vector<std::uint32_t> order = groundOrder(grid);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Vec2 &p = grid[order[i - 1]], &q = grid[order[i]];
    EXPECT_EQ(std::abs(p.x - q.x) + std::abs(p.y - q.y), 1) << i;
  }
}

TEST(GroundOrder, FollowsTheCurveAmongPointsThatOthersFarAwayMakeSmall) {
  std::vector<Vec2> points = {{3e15, 1e14}, {-2e15, 5e15}};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) points.push_back({0.5 + x, 0.25 + y});
  const std::vector<std::uint32_t> order = groundOrder(points);
  std::size_t jumps = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Vec2 &p = points[order[i - 1]], &q = points[order[i]];
    jumps += std::abs(p.x - q.x) + std::abs(p.y - q.y) != 1;
  }
  EXPECT_EQ(order.size(), points.size());
  EXPECT_LE(jumps, 3u) << "to and from those far away";
}

TEST(GroundOrder, DependsOnThePlacesAloneAndKeepsPointsAtOnePlaceTogetherByTheirIndices) {
  for (const PointFamily& family : pointFamilies()) {
    const PointHeightfield field = family.make(300, 4);
    std::vector<Vec2> twice = field.positions;
    twice.insert(twice.end(), field.positions.rbegin(), field.positions.rend());
    const std::vector<std::uint32_t> once = groundOrder(field.positions), both = groundOrder(twice);
    std::vector<Vec2> places;
    for (std::size_t i = 0; i < both.size(); ++i) {
      const bool isRepeated = i > 0 && twice[both[i - 1]] == twice[both[i]];
      if (isRepeated) {
        EXPECT_LT(both[i - 1], both[i]) << family.name;
      }
      if (!isRepeated) places.push_back(twice[both[i]]);
    }
    std::vector<Vec2> expected;
    for (const std::uint32_t v : once)
      if (expected.empty() || !(expected.back() == field.positions[v]))
        expected.push_back(field.positions[v]);
    EXPECT_EQ(places, expected) << family.name;
  }
}

TEST(GroundOrder, TakesPlacesWhoseDistanceNoDoubleHolds) {
  const double far = std::numeric_limits<double>::max();
  const std::vector<Vec2> corners = {{-far, -far}, {far, far}, {0, 0}, {-far, far}, {far, -far}};
  EXPECT_EQ(groundOrder(corners).size(), corners.size());
  EXPECT_EQ(groundOrder(std::vector<Vec2>(3, Vec2{5, 5})), (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace arete
