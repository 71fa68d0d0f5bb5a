// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/slot_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace arete {
namespace {

TEST(SlotMap, MovesLiveSlotsUpInTheirOrder) {
  for (const std::size_t size : {0u, 1u, 31u, 32u, 33u, 64u, 1000u, 100000u})
    for (const unsigned share : {0u, 1u, 7u, 8u}) {
      SCOPED_TRACE(testing::Message() << size << " slots, " << share << " of 8 live, seed " << size + share);
      std::mt19937_64 random(size + share);
      std::vector<char> isLive(size);
      for (char& live : isLive) live = random() % 8 < share;
      const SlotMap map(size, [&](std::size_t slot) { return isLive[slot] != 0; });
      constexpr std::uint32_t kNone = 0xFFFFFFFF;
      std::vector<std::uint32_t> expected(size, kNone);
      std::uint32_t next = 0;
      for (std::size_t slot = 0; slot < size; ++slot)
        if (isLive[slot]) expected[slot] = next++;
      EXPECT_EQ(map.liveCount(), next);
      for (std::size_t slot = 0; slot < size; ++slot)
        if (isLive[slot]) {
          ASSERT_EQ(map.ofLive(slot), expected[slot]) << "slot " << slot;
        }

      std::vector<std::uint32_t> visited(size, kNone);
      map.forLiveInPlace([&](std::size_t slot, std::uint32_t to) { visited[slot] = to; });
      ASSERT_EQ(visited, expected);
    }
}

TEST(SlotMap, WhatIsMovedInPlaceIsVisitedBeforeItIsOverwritten) {
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u})
    for (const std::size_t size : {0, 1, 31, 32, 33, 5000, 100'000, 300'001}) {
      // Stretches that are all live, all dead, or mixed in some share.
      std::mt19937 random(seed);
      std::vector<std::uint8_t> isLive(size);
      for (std::size_t begin = 0; begin < size;) {
        const std::size_t end = std::min<std::size_t>(size, begin + 1 + random() % 40'000);
        const std::uint32_t share = random() % 5;
        for (; begin < end; ++begin) isLive[begin] = random() % 4 < share ? 1 : 0;
      }
      const SlotMap map(size, [&](std::size_t slot) { return isLive[slot] != 0; });
      std::vector<std::uint32_t> kept, moved(size);
      std::iota(moved.begin(), moved.end(), 0u);
      for (std::uint32_t slot = 0; slot < size; ++slot)
        if (isLive[slot] != 0) kept.push_back(slot);
      map.forLiveInPlace([&](std::size_t from, std::uint32_t to) { moved[to] = moved[from]; });
      moved.resize(map.liveCount());
      ASSERT_EQ(moved, kept) << "seed " << seed << ", size " << size;
    }
}

}  // namespace
}  // namespace arete
