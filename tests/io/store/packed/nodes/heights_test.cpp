// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/nodes/heights.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "datasets/random.h"

namespace arete::packed {
namespace {

using Type = HeightEncoding::Type;

TEST(PackedHeights, OrdinalsAreOrderedAsTheNumbersAre) {
  const double values[] = {-HUGE_VAL,          -1e300,  -1.5, -1e-320, -0.0, 0.0, 1e-320, 1,
                           1.0000000000000002, HUGE_VAL};
  for (std::size_t i = 0; i + 1 < std::size(values); ++i) {
    EXPECT_LT(ordinal(values[i]), ordinal(values[i + 1]));
    EXPECT_LT(ordinal(static_cast<float>(values[0])), ordinal(1.0f));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(fromOrdinal(ordinal(values[i]))),
              std::bit_cast<std::uint64_t>(values[i]));
  }
  EXPECT_EQ(ordinal(1.0000000000000002) - ordinal(1.0), 1u);
  EXPECT_EQ(fromOrdinal(ordinal(-2.5f)), -2.5f);
}

TEST(PackedHeights, ComeBackFromTheirResidualWhateverWasPredicted) {
  Random random(4);
  for (const Type type : {Type::int16, Type::float32, Type::float64}) {
    std::array<std::byte, 64> heights{};
    for (std::size_t i = 0; i < 1000; ++i) {
      const double any = random.between(-1e4, 1e4);
      const double raw = type == Type::int16     ? std::floor(any)
                         : type == Type::float32 ? static_cast<double>(static_cast<float>(any))
                                                 : any;
      const double predicted = random.between(-1e4, 1e4);
      const std::int64_t residual = heightResidual(type, raw, predicted);
      EXPECT_EQ(putHeight(type, heights.data(), 3, predicted, residual), raw);
      EXPECT_EQ(rawHeight(type, heights.data(), 3), raw);
    }
    EXPECT_EQ(heightResidual(type, 5, 5), 0);
  }
}

TEST(PackedHeights, ThatNoInt16HasAreNotFinite) {
  std::array<std::byte, 8> heights{};
  EXPECT_EQ(putHeight(Type::int16, heights.data(), 0, 32767, 0), 32767);
  EXPECT_EQ(putHeight(Type::int16, heights.data(), 0, 32767, 1), HUGE_VAL);
  EXPECT_EQ(putHeight(Type::int16, heights.data(), 0, -32768, -1), HUGE_VAL);
}

TEST(PackedHeights, RoundHalvesUpwards) {
  EXPECT_EQ(nearest(0.5), 1);
  EXPECT_EQ(nearest(-0.5), 0);
  EXPECT_EQ(nearest(-0.51), -1);
  EXPECT_EQ(nearest(-1.5), -1);
  EXPECT_EQ(nearest(2.49), 2);
}

}  // namespace
}  // namespace arete::packed
