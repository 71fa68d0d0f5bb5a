// SPDX-License-Identifier: GPL-3.0-or-later
//
// The farthest point of a triangle against a dense grid of its points.
#include "measure/farthest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "terrain/measure_meshes.h"

namespace arete {
namespace {

using namespace measuring_test;

std::array<NearestOnMesh::Answer, 3> cornerAnswers(const SpaceTriangle& triangle, const NearestOnMesh& to) {
  return {to.nearest(triangle[0]), to.nearest(triangle[1]), to.nearest(triangle[2])};
}

double largestOnGrid(const SpaceTriangle& t, const NearestOnMesh& to, int n) {
  double largest = 0;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const double u = double(i) / n, v = double(j) / n;
      largest = std::max(largest, to.nearest(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0])).distance);
    }
  return largest;
}

TEST(FarthestPoint, IsBoundedFromBothSides) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const TriangleMesh target = soup(40, seed), from = soup(6, seed + 100);
    const NearestOnMesh to(target);
    for (const auto& v : from.triangles) {
      const SpaceTriangle t{from.positions[v[0]], from.positions[v[1]], from.positions[v[2]]};
      const auto answers = cornerAnswers(t, to);
      const FarthestPoint found = farthestPoint(t, answers, target, to, {.accuracy = 0.01, .budget = 100000});
      const double sampled = largestOnGrid(t, to, 60);
      EXPECT_LE(sampled, found.atMost * (1 + 1e-12));
      EXPECT_LE(found.atMost, found.distance * 1.01 + 1e-12);
      EXPECT_NEAR(to.nearest(found.from).distance, found.distance, 1e-12);
      EXPECT_NEAR(std::sqrt(squaredDistance(found.from, found.nearest)), found.distance, 1e-12);
      // With little effort the bound is wide, and holds.
      const FarthestPoint hasty = farthestPoint(t, answers, target, to, {.budget = 2});
      EXPECT_LE(sampled, hasty.atMost * (1 + 1e-12));
      EXPECT_LE(hasty.distance, found.atMost * (1 + 1e-12));
    }
  }
}

TEST(FarthestPoint, OfATriangleAboveAPlaneIsItsHighestCorner) {
  const TriangleMesh target = plane(4, 10, 0);
  const NearestOnMesh to(target);
  const SpaceTriangle t{Vec3{2, 2, 1}, {7, 3, 4}, {4, 8, 2}};
  const FarthestPoint found = farthestPoint(t, cornerAnswers(t, to), target, to, {.budget = 10000});
  EXPECT_EQ(found.from, t[1]);
  EXPECT_NEAR(found.distance, 4, 1e-12);
  EXPECT_NEAR(found.atMost, 4, 4.1e-3);
}

TEST(FarthestPoint, EndsAtOnceBelowAKnownDistanceAndWhenToldToStop) {
  const TriangleMesh target = sphere(20, 1);
  const NearestOnMesh to(target);
  const SpaceTriangle t{Vec3{3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
  const auto answers = cornerAnswers(t, to);
  const FarthestPoint below = farthestPoint(t, answers, target, to, {.known = 100, .budget = 1 << 20});
  EXPECT_LE(below.atMost, 100.1);
  int asked = 0;
  FarthestPointOptions stopping{.accuracy = 0, .budget = 1 << 20};
  stopping.shouldStop = [&] { return ++asked >= 2; };
  const FarthestPoint stopped = farthestPoint(t, answers, target, to, stopping);
  EXPECT_LE(asked, 2);
  EXPECT_GE(stopped.atMost, stopped.distance);
}

}  // namespace
}  // namespace arete
