// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/amt/block_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace arete {
namespace {

using Bytes = std::span<const std::byte>;

bool isWithin(Bytes part, const std::vector<Bytes>& wholes) {
  return std::ranges::any_of(wholes, [&](Bytes whole) {
    return whole.data() <= part.data() && part.data() + part.size() <= whole.data() + whole.size();
  });
}

TEST(BlockParts, OfManyBlocksOfASmallDirectoryAreAllOfItAndTheFirstPages) {
  const std::vector<std::byte> file(3'000'000);
  const Bytes blocks = Bytes(file).subspan(100'000, 60'000), nodes = Bytes(file).subspan(160'000);
  std::vector<Bytes> wanted = {nodes.subspan(2'000'000, 10)};
  for (std::size_t i = 0; i < 8; ++i) wanted.push_back(blocks.subspan(500 + 7000 * i, 700));
  const std::vector<Bytes> fetched = withBlocksJoined(wanted, blocks, nodes);
  for (const Bytes part : wanted) EXPECT_TRUE(isWithin(part, fetched));
  EXPECT_TRUE(isWithin(blocks, fetched));
  EXPECT_TRUE(isWithin(nodes.first(10'000), fetched));
  EXPECT_FALSE(isWithin(nodes.first(100'000), fetched));
}

TEST(BlockParts, OfFewBlocksOfASmallDirectoryAreThoseAlone) {
  const std::vector<std::byte> file(3'000'000);
  const Bytes blocks = Bytes(file).subspan(100'000, 900'000), nodes = Bytes(file).subspan(1'000'000);
  const std::vector<Bytes> fetched = withBlocksJoined(
      std::vector<Bytes>{blocks.subspan(500, 700), blocks.subspan(800'000, 700)}, blocks, nodes);
  ASSERT_EQ(fetched.size(), 2u);
  EXPECT_EQ(fetched[0].size() + fetched[1].size(), 1400u);
}

TEST(BlockParts, OfPagesAloneStayAsTheyAre) {
  const std::vector<std::byte> file(300'000);
  const Bytes blocks = Bytes(file).first(1000), nodes = Bytes(file).subspan(1000);
  const std::vector<Bytes> wanted = {nodes.subspan(5, 7), nodes.subspan(100'000, 10)};
  const std::vector<Bytes> fetched = withBlocksJoined(wanted, blocks, nodes);
  ASSERT_EQ(fetched.size(), 2u);
  EXPECT_EQ(fetched[0].data(), wanted[0].data());
}

TEST(BlockParts, OfALargeDirectoryAreJoinedWhereTheyAreNear) {
  const std::vector<std::byte> file(20'000'000);
  const Bytes blocks = Bytes(file).first(8'000'000), nodes = Bytes(file).subspan(8'000'000);
  const std::vector<Bytes> wanted = {blocks.subspan(7'000'000, 900), blocks.subspan(10, 900),
                                     blocks.subspan(100'000, 900), nodes.subspan(1'000'000, 10),
                                     blocks.subspan(6'900'000, 900)};
  const std::vector<Bytes> fetched = withBlocksJoined(wanted, blocks, nodes);
  EXPECT_EQ(fetched.size(), 3u);
  std::size_t bytes = 0;
  for (const Bytes part : fetched) bytes += part.size();
  EXPECT_LT(bytes, 300'000u);
  for (const Bytes part : wanted) EXPECT_TRUE(isWithin(part, fetched));
}

}  // namespace
}  // namespace arete
