// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/heightfield/bounds.h"

#include <gtest/gtest.h>

#include "datasets/random.h"

namespace arete::packed {
namespace {

TEST(PackedBounds, StepsRoundOutwards) {
  for (std::uint32_t code = 0; code <= OutwardScale::kMaxCode; ++code) {
    const std::uint32_t step = boundStep(code);
    ASSERT_LT(step, kBoundSteps);
    ASSERT_GE(boundCode(step), code);
    ASSERT_LT(step << kBoundShift, code + (1u << kBoundShift));
  }
  EXPECT_EQ(boundStep(0), 0u);
  EXPECT_EQ(boundCode(128), OutwardScale::kMaxCode);
}

TEST(PackedBounds, RoundedBoundsHoldTheBoundsAndKeepTheGreaterOne) {
  for (std::uint32_t below = 0; below < kBoundSteps; ++below)
    for (std::uint32_t above = 0; above < kBoundSteps; ++above) {
      const BoundSteps rounded = roundedBounds(below, above);
      ASSERT_GE(rounded.below, below);
      ASSERT_GE(rounded.above, above);
      ASSERT_EQ(std::max(rounded.below, rounded.above), std::max(below, above));
      ASSERT_EQ(rounded.below == 0, below == 0);
      ASSERT_EQ(rounded.above == 0, above == 0);
      const BoundSteps again = roundedBounds(rounded.below, rounded.above);
      ASSERT_TRUE(again.below == rounded.below && again.above == rounded.above);
    }
}

TEST(PackedBounds, ComeBackFromTheirBytesForEveryReference) {
  for (std::uint32_t below = 0; below < kBoundSteps; ++below)
    for (std::uint32_t above = 0; above < kBoundSteps; ++above) {
      const BoundSteps rounded = roundedBounds(below, above);
      for (const std::uint32_t reference : {0u, 1u, 5u, 40u, 120u, 128u}) {
        const BoundSteps back = boundsOf(bytesOf(rounded, reference), reference);
        ASSERT_EQ(back.below, rounded.below) << below << ", " << above << ", " << reference;
        ASSERT_EQ(back.above, rounded.above) << below << ", " << above << ", " << reference;
      }
    }
}

TEST(PackedBounds, TakeOneByteNearTheReference) {
  EXPECT_FALSE(bytesOf({0, 0}, 7).isFar());
  EXPECT_FALSE(bytesOf({7, 3}, 7).isFar());
  EXPECT_FALSE(bytesOf({3, 15}, 7).isFar());
  EXPECT_TRUE(bytesOf({3, 16}, 7).isFar());
  EXPECT_TRUE(bytesOf({6, 6}, 7).isFar());
}

TEST(PackedBounds, OfAnyBytesAreSomeBounds) {
  Random random(1);
  for (int i = 0; i < 100'000; ++i) {
    const BoundBytes bytes{static_cast<std::uint8_t>(random.next()),
                           static_cast<std::uint8_t>(random.next())};
    const BoundSteps bounds = boundsOf(bytes, random.below(kBoundSteps));
    ASSERT_LE(std::max(bounds.below, bounds.above), 1000u);
    ASSERT_LE(boundCode(bounds.below), OutwardScale::kMaxCode);
  }
}

TEST(PackedBounds, ReferToTheErrorOrWithoutOneToTheBand) {
  EXPECT_EQ(boundReference(513, 9), boundStep(513));
  EXPECT_EQ(boundReference(0, 0), 0u);
  EXPECT_EQ(boundReference(0, 5), 17u);
}

}  // namespace
}  // namespace arete::packed
