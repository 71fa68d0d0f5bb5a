// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/slot_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "engine/base/id_array.h"
#include "engine/ids_of.h"

namespace arete {
namespace {

using test::idsBelow;

template <class T>
using BySlot = IdArray<SlotId, std::vector<T>>;

TEST(SlotMap, MovesLiveSlotsUpInTheirOrder) {
  for (const std::size_t size : {0u, 1u, 31u, 32u, 33u, 64u, 1000u, 100000u})
    for (const unsigned share : {0u, 1u, 7u, 8u}) {
      SCOPED_TRACE(testing::Message() << size << " slots, " << share << " of 8 live, seed " << size + share);
      std::mt19937_64 random(size + share);
      BySlot<char> isLive(size);
      for (char& live : isLive) live = random() % 8 < share;
      const SlotMap map(size, [&](SlotId slot) { return isLive[slot] != 0; });
      BySlot<SlotId> expected(size);  // invalid: dead
      std::uint32_t next = 0;
      for (const SlotId slot : idsBelow<SlotId>(size))
        if (isLive[slot]) expected[slot] = SlotId(next++);
      EXPECT_EQ(map.liveCount(), next);
      for (const SlotId slot : idsBelow<SlotId>(size))
        if (isLive[slot]) {
          ASSERT_EQ(map.ofLive(slot), expected[slot]) << "slot " << slot.index();
        }

      BySlot<SlotId> visited(size);
      map.forLiveInPlace([&](SlotId slot, SlotId to) { visited[slot] = to; });
      ASSERT_EQ(visited, expected);
    }
}

TEST(SlotMap, WhatIsMovedInPlaceIsVisitedBeforeItIsOverwritten) {
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u})
    for (const std::uint32_t size : {0, 1, 31, 32, 33, 5000, 100'000, 300'001}) {
      // Stretches that are all live, all dead, or mixed in some share.
      std::mt19937 random(seed);
      BySlot<std::uint8_t> isLive(size);
      for (std::uint32_t begin = 0; begin < size;) {
        const std::uint32_t end = std::min(size, begin + 1 + static_cast<std::uint32_t>(random() % 40'000));
        const auto share = random() % 5;
        for (; begin < end; ++begin) isLive[SlotId(begin)] = random() % 4 < share ? 1 : 0;
      }
      const SlotMap map(size, [&](SlotId slot) { return isLive[slot] != 0; });
      BySlot<SlotId> kept, moved;  // of elements that hold the slot they were in
      for (const SlotId slot : idsBelow<SlotId>(size)) {
        moved.push_back(slot);
        if (isLive[slot] != 0) kept.push_back(slot);
      }
      map.forLiveInPlace([&](SlotId from, SlotId to) { moved[to] = moved[from]; });
      moved.resize(map.liveCount());
      ASSERT_EQ(moved, kept) << "seed " << seed << ", size " << size;
    }
}

}  // namespace
}  // namespace arete
