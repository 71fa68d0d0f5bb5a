// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/entropy/numbers.h"

#include <gtest/gtest.h>

#include <limits>

#include "datasets/random.h"

namespace arete {
namespace {

TEST(EntropyNumbers, AreASymbolAndRawBits) {
  Random random(1);
  unsigned last = 0;
  const auto check = [&](std::uint64_t value) {
    const Bucket bucket = bucketOf(value);
    ASSERT_LT(bucket.symbol, 256u) << value;
    EXPECT_EQ(bucket.rawBits, rawBitsOf(bucket.symbol)) << value;
    const std::uint64_t mask = bucket.rawBits == 0 ? 0 : (std::uint64_t{1} << bucket.rawBits) - 1;
    EXPECT_EQ(bucketValue(bucket.symbol, value & mask), value);
    EXPECT_GE(bucket.symbol, last) << value;
  };
  for (std::uint64_t value = 0; value < 3000; ++value) {
    check(value);
    last = bucketOf(value).symbol;
  }
  last = 0;
  for (int i = 0; i < 2000; ++i) check(random.next() >> random.below(64));
  check(std::numeric_limits<std::uint64_t>::max());
}

TEST(EntropyNumbers, WithASignAreSmallWhereTheyAreSmallInMagnitude) {
  EXPECT_EQ(zigzag(0), 0u);
  EXPECT_EQ(zigzag(-1), 1u);
  EXPECT_EQ(zigzag(1), 2u);
  EXPECT_EQ(zigzag(-2), 3u);
  for (const std::int64_t value : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-7},
                                   std::int64_t{12}, std::numeric_limits<std::int64_t>::max()})
    EXPECT_EQ(unzigzag(zigzag(value)), value);
}

}  // namespace
}  // namespace arete
