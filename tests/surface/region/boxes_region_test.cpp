// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle asks every box.
#include "surface/region/boxes_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace arete {
namespace {

TEST(BoxesRegion, AnswersAsAnyOfItsBoxesDoes) {
  for (const std::size_t count : {1u, 2u, 3u, 17u, 200u})
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      SCOPED_TRACE(testing::Message() << count << " boxes, seed " << seed);
      std::mt19937_64 random(seed);
      const auto number = [&] { return double(random() % 2001) / 1000 - 1; };
      const auto point = [&] { return Vec3{number(), number(), number()}; };
      std::vector<std::array<Vec3, 2>> boxes;
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3 low = point(), side = point();
        boxes.push_back({low, low + 0.2 * Vec3{std::abs(side.x), std::abs(side.y), std::abs(side.z)}});
      }
      const BoxesRegion region(boxes);
      const auto ofAny = [&](const auto& test) {
        return std::ranges::any_of(boxes, [&](const auto& b) { return test(BoxRegion(b[0], b[1])); });
      };
      for (int i = 0; i < 300; ++i) {
        const Vec3 a = point();
        const SpaceTriangle t{a, a + 0.3 * point(), a + 0.3 * point()};
        const double r = std::abs(number()) / 4;
        EXPECT_EQ(region.meetsTriangle(t, 0), ofAny([&](const auto& b) { return b.meetsTriangle(t, 0); }));
        EXPECT_EQ(region.meetsTriangle(t, r), ofAny([&](const auto& b) { return b.meetsTriangle(t, r); }));
        EXPECT_EQ(region.meetsBall(a, r), ofAny([&](const auto& b) { return b.meetsBall(a, r); }));
        EXPECT_EQ(region.holdsBall(a, r), ofAny([&](const auto& b) { return b.holdsBall(a, r); }));
      }
    }
}

TEST(BoxesRegion, OfNoBoxHoldsNothing) {
  const BoxesRegion region({});
  EXPECT_FALSE(region.meetsBall({0, 0, 0}, 1e9));
  EXPECT_FALSE(region.holdsBall({0, 0, 0}, 0));
}

}  // namespace
}  // namespace arete
