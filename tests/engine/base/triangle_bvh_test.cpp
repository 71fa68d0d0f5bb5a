// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/base/triangle_bvh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace arete {
namespace {

using Corners = TriangleBvh::Corners;

/// Triangles without order: small and large ones, segments and points among them.
std::vector<Vec3> places(std::mt19937_64& random, std::size_t count) {
  const auto number = [&] { return double(random() % 4001) / 1000 - 2; };
  std::vector<Vec3> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back({number(), number(), number()});
  return all;
}

TEST(TriangleBvh, FindsTheNearestOfAllTrianglesWithAnyGuessAndAfterMoves) {
  for (const std::size_t count : {1u, 7u, 8u, 9u, 63u, 65u, 300u, 513u}) {
    SCOPED_TRACE("seed and triangles " + std::to_string(count));
    std::mt19937_64 random(count);
    std::vector<Vec3> at = places(random, count + 2);
    std::vector<Corners> triangles;
    for (std::uint32_t t = 0; t < count; ++t)
      triangles.push_back(t % 11 == 3   ? Corners{t, t + 1, t + 1}
                          : t % 13 == 5 ? Corners{t, t, t}
                                        : Corners{t, t + 1, t + 2});
    TriangleBvh bvh(at, triangles);
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < 50; ++i) {
        const Vec3 p = places(random, 1)[0];
        double least = 1e300;
        for (const Corners& t : triangles)
          least = std::min(least, distanceToTriangle(p, {at[t[0]], at[t[1]], at[t[2]]}));
        for (const std::uint32_t guess : {TriangleBvh::kNone, static_cast<std::uint32_t>(random() % count)}) {
          const TriangleBvh::Answer found = bvh.nearest(p, guess);
          EXPECT_NEAR(std::sqrt(found.squaredDistance), least, 1e-9);
          const Corners& t = triangles[found.triangle];
          Vec3 place{0, 0, 0};
          for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_GE(found.point.shares[c], 0);
            place = place + found.point.shares[c] * at[t[c]];
          }
          EXPECT_LT(norm(place - found.point.place), 1e-12);
        }
      }
      for (Vec3& p : at) p = p + 0.3 * places(random, 1)[0];
      bvh.refit(at, triangles);
    }
  }
}

TEST(TriangleBvh, LooksAtFewAroundAVertexOfManyTriangles) {
  std::vector<double> looks;
  for (const std::uint32_t n : {500u, 20'000u}) {
    std::vector<Vec3> at;
    std::vector<Corners> triangles;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * i / n;
      at.push_back({std::cos(angle), std::sin(angle), 0});
      triangles.push_back({n, i, (i + 1) % n});
      if (i > 0 && i + 1 < n) triangles.push_back({0, i + 1, i});
    }
    at.push_back({0, 0, 1.5});
    const TriangleBvh bvh(at, triangles);
    std::mt19937_64 random(n);
    double sum = 0;
    for (int i = 0; i < 1000; ++i) {
      const auto on = static_cast<std::uint32_t>(random() % triangles.size());
      const Corners& t = triangles[on];
      const double u = double(random() % 1000) / 2000, v = double(random() % 1000) / 2000;
      const Vec3 p = (1 - u - v) * at[t[0]] + u * at[t[1]] + v * at[t[2]];
      const std::uint32_t beside = on > 0 ? on - 1 : on + 1;
      const TriangleBvh::Answer answer = bvh.nearest(p, beside);
      EXPECT_LT(std::sqrt(answer.squaredDistance), 1e-7);  // shares of slivers are rounded
      sum += answer.looks;
    }
    looks.push_back(sum / 1000);
  }
  EXPECT_LT(looks[0], 30);
  EXPECT_LT(looks[1], 3 * looks[0]) << "40 times as many triangles";
}

TEST(TriangleBvh, OfASegmentIsOnTheSegmentAndOfNothingIsEmpty) {
  const TrianglePoint point = nearestWithShares({0.5, -1, 7}, {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{2, 0, 0}});
  EXPECT_DOUBLE_EQ(point.shares[1], 0.25);
  EXPECT_EQ(point.shares[2], 0);
  EXPECT_TRUE(TriangleBvh({}, {}).isEmpty());
}

}  // namespace
}  // namespace arete
