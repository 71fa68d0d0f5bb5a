// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/byte_size.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

TEST(ByteSize, HasUnitsOfThousandsAndOfPowersOfTwo) {
  EXPECT_EQ(parseByteSize("512"), 512u);
  EXPECT_EQ(parseByteSize("512B"), 512u);
  EXPECT_EQ(parseByteSize("1.5kB"), 1500u);
  EXPECT_EQ(parseByteSize("2MB"), 2'000'000u);
  EXPECT_EQ(parseByteSize("2GB"), 2'000'000'000u);
  EXPECT_EQ(parseByteSize("3K"), 3072u);
  EXPECT_EQ(parseByteSize("64M"), 64u << 20);
  EXPECT_EQ(parseByteSize("64MiB"), 64u << 20);
  EXPECT_EQ(parseByteSize("1G"), 1u << 30);
  EXPECT_EQ(parseByteSize("0"), 0u);
}

TEST(ByteSize, OfAnotherTextIsNothing) {
  for (const char* text :
       {"", "M", "2 G", "2g", "2X", "-1", "-1G", "nan", "inf", "1e30", "1e999", "2GBs", "0x10M"})
    EXPECT_FALSE(parseByteSize(text)) << text;
}

}  // namespace
}  // namespace arete
