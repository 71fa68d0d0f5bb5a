// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/format/layout.h"

#include <gtest/gtest.h>

#include <cstring>

namespace arete {
namespace {

TEST(Layout, AlignsChunksTo64Bytes) {
  EXPECT_EQ(amtAligned(0), 0u);
  EXPECT_EQ(amtAligned(1), 64u);
  EXPECT_EQ(amtAligned(64), 64u);
  EXPECT_EQ(amtAligned(65), 128u);
  EXPECT_EQ(amtAligned((std::uint64_t{1} << 63) + 1), (std::uint64_t{1} << 63) + 64);
}

TEST(Layout, CutsEveryChunkButTwoIntoSegments) {
  EXPECT_EQ(amtSegmentCount(amt_tag::kLink, 0), 0u);
  EXPECT_EQ(amtSegmentCount(amt_tag::kLink, 1), 1u);
  EXPECT_EQ(amtSegmentCount(amt_tag::kLink, kAmtSegmentBytes), 1u);
  EXPECT_EQ(amtSegmentCount(amt_tag::kLink, kAmtSegmentBytes + 1), 2u);
  EXPECT_EQ(amtSegmentCount(amt_tag::kMetadata, 1 << 20), 0u);
  EXPECT_EQ(amtSegmentCount(amt_tag::kSegmentChecksums, 1 << 20), 0u);
}

TEST(Layout, PrintsTagsOfAnyBytes) {
  AmtChunk chunk;
  chunk.tag = amt_tag::kLink;
  EXPECT_EQ(chunk.name(), "LINK");
  chunk.tag = {'A', '\n', '\x7f', '\xff'};
  EXPECT_EQ(chunk.name(), "A???");
}

TEST(Layout, HasItsFieldsWhereTheFormatSays) {
  const AmtHeader header;
  unsigned char bytes[sizeof header];
  std::memcpy(bytes, &header, sizeof header);
  const unsigned char begin[] = {0x89, 'A', 'M', 'T', '\r', '\n', 0x1a, '\n', 4, 3, 2, 1, 2, 0, 0, 0, 64};
  EXPECT_EQ(std::memcmp(bytes, begin, sizeof begin), 0);
  EXPECT_EQ(offsetof(AmtHeader, chunkCount), 20u);
  EXPECT_EQ(offsetof(AmtHeader, fileBytes), 24u);
  EXPECT_EQ(offsetof(AmtHeader, directoryOffset), 32u);
  EXPECT_EQ(offsetof(AmtHeader, checksum), 56u);
  EXPECT_EQ(offsetof(AmtChunk, offset), 16u);
  EXPECT_EQ(offsetof(AmtChunk, bytes), 24u);
  EXPECT_EQ(offsetof(AmtChunk, checksum), 32u);
}

}  // namespace
}  // namespace arete
