// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/layers/label_placement.h"

#include <gtest/gtest.h>

#include <vector>

#include "datasets/random.h"

namespace arete {
namespace {

TEST(LabelPlacement, PutsTheFirstLabelAboveItsPlace) {
  LabelPlacement placement(200, 100);
  const auto area = placement.place({100, 50}, 40, 10, 5);
  ASSERT_TRUE(area);
  EXPECT_EQ(area->left, 80);
  EXPECT_EQ(area->bottom(), 45);
  const auto second = placement.place({100, 50}, 40, 10, 5);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->top, 55) << "below it: beside it would be too near the first";
  EXPECT_EQ(placement.refused(), 0u);
  EXPECT_FALSE(placement.place({100, 50}, 190, 95, 5));
  EXPECT_FALSE(placement.hasRoom({100, 50}, 190, 95, 5));
  EXPECT_EQ(placement.refused(), 2u);
}

TEST(LabelPlacement, NeverLetsTwoOverlapOrLeaveThePicture) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Random random(seed);
    LabelPlacement placement(640, 360, 2);
    const Rect legend{500, 260, 140, 100};
    placement.take(legend);
    std::vector<Rect> placed = {legend};
    for (int i = 0; i < 2000; ++i) {
      const auto area = placement.place({random.between(-50, 700), random.between(-50, 400)},
                                        random.between(5, 200), random.between(5, 40), 4);
      if (!area) continue;
      EXPECT_GE(area->left, 0);
      EXPECT_GE(area->top, 0);
      EXPECT_LE(area->right(), 640);
      EXPECT_LE(area->bottom(), 360);
      for (const Rect& other : placed)
        EXPECT_TRUE(area->left >= other.right() + 2 || other.left >= area->right() + 2 ||
                    area->top >= other.bottom() + 2 || other.top >= area->bottom() + 2)
            << "seed " << seed;
      placed.push_back(*area);
    }
    EXPECT_GT(placed.size(), 20u) << "seed " << seed;
  }
}

}  // namespace
}  // namespace arete
