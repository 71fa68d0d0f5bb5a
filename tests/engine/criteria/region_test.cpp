// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/criteria/region.h"

#include <gtest/gtest.h>

#include <algorithm>
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
      EXPECT_EQ(region.holdsDisc(p, nearest * 0.999999), inside) << round;
      EXPECT_FALSE(region.holdsDisc(p, nearest * 1.000001)) << round;
    }
  }
}

/// By walking along a segment.
double walkedDistance(Vec2 p, Vec2 a, Vec2 b) {
  double least = 1e300;
  for (double t = 0; t <= 1; t += 1.0 / 4096)
    least = std::min(least, std::hypot(a.x + t * (b.x - a.x) - p.x, a.y + t * (b.y - a.y) - p.y));
  return least;
}

TEST(Region, OfALineIsWhatLiesWithinItsDistanceOnTheGround) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> unit(0, 1);
  MetricFrame metric;
  metric.origin = {5, 7, 0};
  metric.scale = {30, 20, 1};  // a step east is longer than one south
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec2> line;
    for (int i = 0; i < 12; ++i) line.push_back({100 * unit(random), 100 * unit(random)});
    const double distance = 40 + 300 * unit(random);
    const Region region({.lines = {line}, .distance = distance}, metric), inMetric = region.scaled(metric);
    for (int k = 0; k < 60; ++k) {
      const Vec2 p{140 * unit(random) - 20, 140 * unit(random) - 20};
      const Vec2 q{(p.x - 5) * 30, (p.y - 7) * 20};
      double nearest = 1e300;
      for (int i = 0; i + 1 < 12; ++i)
        nearest = std::min(nearest, walkedDistance(q, {(line[i].x - 5) * 30, (line[i].y - 7) * 20},
                                                   {(line[i + 1].x - 5) * 30, (line[i + 1].y - 7) * 20}));
      if (std::abs(nearest - distance) < 2) continue;  // the walk has steps
      EXPECT_EQ(region.contains(p), nearest < distance);
      EXPECT_EQ(inMetric.contains(q), nearest < distance);
      const double r = 300 * unit(random);
      if (std::abs(nearest - distance - r) < 2) continue;
      EXPECT_EQ(inMetric.meetsDisc(q, r), nearest < distance + r);
      const Vec2 a{p.x - 0.01, p.y}, b{p.x + 0.01, p.y}, c{p.x, p.y + 0.01};
      EXPECT_EQ(region.meetsTriangle(a, b, c), nearest < distance);
    }
    EXPECT_TRUE(region.meetsTriangle({-500, -500}, {900, -500}, {0, 900})) << "one that holds the line whole";
    EXPECT_FALSE(region.meetsTriangle({900, 900}, {910, 900}, {900, 910}));
  }
}

TEST(Region, OfPolygonsGrowsByItsDistanceAndHolesShrink) {
  const Region ring(RegionShape{
      .rings = {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{3, 3}, {7, 3}, {7, 7}, {3, 7}}}, .distance = 1});
  EXPECT_TRUE(ring.contains({-0.9, 5}));
  EXPECT_FALSE(ring.contains({-1.1, 5}));
  EXPECT_FALSE(ring.contains({-0.8, -0.8})) << "round at the corner";
  EXPECT_TRUE(ring.contains({3.9, 5}));
  EXPECT_FALSE(ring.contains({5, 5}));
  EXPECT_EQ(ring.bounds().xMin, -1);
  EXPECT_EQ(ring.bounds().yMax, 11);
}

TEST(Region, OfALineWithoutADistanceIsTheLine) {
  const Region line(RegionShape{.lines = {{{0, 0}, {10, 0}, {10, 10}}}});
  EXPECT_TRUE(line.contains({4, 0}));
  EXPECT_FALSE(line.contains({5, 5})) << "a line has no inside";
  EXPECT_TRUE(line.meetsTriangle({4, -1}, {6, -1}, {5, 1}));
  EXPECT_FALSE(line.meetsTriangle({4, 1}, {6, 1}, {5, 3}));
}

}  // namespace
}  // namespace arete
