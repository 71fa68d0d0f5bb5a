// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/quadric.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace arete {
namespace {

Quadric cornerAt(const Vec3& p) {
  Quadric q = Quadric::ofPlane(p, {1, 0, 0}, 1);
  q += Quadric::ofPlane(p, {0, 1, 0}, 2);
  q += Quadric::ofPlane(p, {0, 0, 1}, 3);
  return q;
}

TEST(Quadric, IsTheSumOfWeightedSquaredDistances) {
  std::mt19937_64 random(1);
  const auto number = [&] { return double(random() % 2001) / 1000 - 1; };
  for (int i = 0; i < 200; ++i) {
    Quadric sum;
    double expected = 0;
    const Vec3 p{number(), number(), number()};
    for (int k = 0; k < 4; ++k) {
      const Vec3 at{number(), number(), number()}, n = unit({number(), number(), 1.5});
      const double weight = 1 + number() / 2, distance = dot(p - at, n);
      sum += Quadric::ofPlane(at, n, weight);
      expected += weight * distance * distance;
    }
    EXPECT_NEAR(sum.at(p), expected, 1e-12);
  }
}

TEST(Quadric, HasItsLeastWherePlanesMeet) {
  const Vec3 corner{3, -2, 7};
  const auto least = cornerAt(corner).least();
  ASSERT_TRUE(least);
  EXPECT_LT(norm(*least - corner), 1e-12);
}

TEST(Quadric, HasNoLeastWherePlanesAreNearlyParallel) {
  Quadric q = Quadric::ofPlane({0, 0, 0}, {0, 0, 1}, 1);
  EXPECT_FALSE(q.least());
  q += Quadric::ofPlane({1, 0, 0}, unit({1e-6, 0, 1}), 1);
  q += Quadric::ofPlane({0, 1, 0}, unit({0, 1e-6, 1}), 1);
  EXPECT_FALSE(q.least());
}

TEST(Quadric, HasItsLeastBetweenTwoPlacesAtTheRootOfItsSlope) {
  const Quadric q = cornerAt({0.25, 0, 0});
  const auto least = q.leastBetween({0, 0, 0}, {1, 0, 0});
  ASSERT_TRUE(least);
  EXPECT_NEAR(least->x, 0.25, 1e-12);
  EXPECT_EQ(q.leastBetween({-5, 0, 0}, {-1, 0, 0})->x, -1);  // beyond its end
  EXPECT_FALSE(Quadric::ofPlane({0, 0, 0}, {0, 0, 1}, 1).leastBetween({0, 0, 2}, {1, 0, 2}));
}

TEST(PlaceFor, FallsBackFromTheLeastToTheSegmentToTheBestOfThem) {
  const std::vector<Vec3> ends = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_LT(norm(placeFor(cornerAt({0.5, 0.25, 0}), ends) - Vec3{0.5, 0.25, 0}), 1e-12);
  // The planes meet far away: the least is not taken.
  const Vec3 near = placeFor(cornerAt({0.5, 100, 0}), ends);
  EXPECT_NEAR(near.x, 0.5, 1e-12);
  EXPECT_EQ(near.y, 0);
  // One plane through both: every place is as good; the middle is taken.
  EXPECT_EQ(placeFor(Quadric::ofPlane({0, 0, 0}, {0, 0, 1}, 1), ends), (Vec3{0.5, 0, 0}));
}

}  // namespace
}  // namespace arete
