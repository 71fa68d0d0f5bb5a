// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first triangle along rays, against the plane of each triangle and the side of its edges that the hit is
// on, in another order of the sums.
#include "viewer/fronts/met_triangle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "datasets/random.h"

namespace arete {
namespace {

std::optional<double> alongByPlane(const std::array<Vec3, 3>& t, const Vec3& from, const Vec3& way) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double slope = dot(n, way);
  if (slope == 0) return std::nullopt;
  const double along = dot(n, t[0] - from) / slope;
  const Vec3 hit = from + along * way;
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(n, cross(t[(i + 1) % 3] - t[i], hit - t[i])) < 0) return std::nullopt;
  return along >= 0 ? std::optional(along) : std::nullopt;
}

TEST(MetTriangle, IsTheNearestOfAllThatTheRayMeets) {
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const auto any = [&] {
      return Vec3{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    };
    std::vector<Vec3> places(60);
    for (Vec3& p : places) p = any();
    std::vector<FrontChanges::Corners> corners;
    for (std::uint32_t i = 0; i < 20; ++i) corners.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    const Vec3 from = any() * 2.0, way = any() - from;
    std::optional<MetTriangle> wanted;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto along = alongByPlane({places[3 * i], places[3 * i + 1], places[3 * i + 2]}, from, way);
      if (along && (!wanted || *along < wanted->along)) wanted = MetTriangle{*along, i};
    }
    const auto got = firstMet({corners, [&](std::uint32_t v) { return places[v]; }}, from, way);
    ASSERT_EQ(got.has_value(), wanted.has_value());
    if (!got) continue;
    ++met;
    EXPECT_EQ(got->index, wanted->index);
    EXPECT_NEAR(got->along, wanted->along, 1e-9);
  }
  EXPECT_GT(met, 50);
}

TEST(MetTriangle, IsNotTurnedAwayWhereTheFrontAloneIsDrawn) {
  const std::vector<Vec3> places = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  const std::vector<FrontChanges::Corners> corners = {{0, 1, 2}};
  const auto meet = [&](double z, bool isFrontAlone) {
    return firstMet({corners, [&](std::uint32_t v) { return places[v]; }, isFrontAlone}, {0, 0, z},
                    {0, 0, -z})
        .has_value();
  };
  EXPECT_TRUE(meet(1, true));
  EXPECT_FALSE(meet(-1, true));
  EXPECT_TRUE(meet(-1, false));
}

TEST(MetTriangle, IsNothingBehindTheRayAndOfNoTriangles) {
  const std::vector<Vec3> places = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  const std::vector<FrontChanges::Corners> corners = {{0, 1, 2}};
  const auto place = [&](std::uint32_t v) { return places[v]; };
  EXPECT_FALSE(firstMet({corners, place}, {0, 0, 1}, {0, 0, 1}));
  EXPECT_FALSE(firstMet({{}, place}, {0, 0, 1}, {0, 0, -1}));
}

}  // namespace
}  // namespace arete
