// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle is a copy of the buffer to which only the changed slots are written.
#include "viewer/fronts/material_slots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <vector>

namespace arete {
namespace {

using Triangles = std::vector<std::uint32_t>;

std::map<std::uint32_t, Triangles> sortedByMaterial(const Triangles& front, std::uint32_t materials) {
  std::map<std::uint32_t, Triangles> sorted;
  for (const std::uint32_t t : front) sorted[t % materials].push_back(t);
  for (auto& [material, of] : sorted) std::ranges::sort(of);
  return sorted;
}

TEST(MaterialSlots, ACopyThatGetsOnlyTheChangesHoldsEveryFront) {
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const std::uint32_t materials = std::array{1u, 2u, 7u, 40u}[seed - 1];
    MaterialSlots slots(materials);
    Triangles front, copy;
    std::uint32_t fresh = 0;
    for (int round = 0; round < 200; ++round) {
      // As a cut changes: triangles leave, the last ones move to their indices, others are appended; every
      // tenth front is another one altogether, or empty.
      if (round % 10 == 9) front.clear();
      for (std::size_t leave = front.empty() ? 0 : random() % front.size() / 3; leave > 0; --leave) {
        front[random() % front.size()] = front.back();
        front.pop_back();
      }
      for (std::size_t enter = round % 20 == 19 ? 0 : random() % 100; enter > 0; --enter)
        front.push_back(fresh++);
      slots.update(front, [&](std::uint32_t t) { return t % materials; });

      if (slots.isPacked()) copy.assign(slots.triangles().begin(), slots.triangles().end());
      for (const std::uint32_t slot : slots.changed()) copy[slot] = slots.triangles()[slot];
      std::map<std::uint32_t, Triangles> drawn;
      std::uint32_t end = 0;
      for (std::uint32_t m = 0; m < materials; ++m) {
        const MaterialSlots::Range& range = slots.ranges()[m];
        EXPECT_GE(range.first, end);
        EXPECT_LE(range.count, range.room);
        end = range.first + range.room;
        ASSERT_LE(end, copy.size());
        for (std::uint32_t i = 0; i < range.count; ++i) drawn[m].push_back(copy[range.first + i]);
        if (range.count > 0) std::ranges::sort(drawn[m]);
      }
      EXPECT_EQ(drawn, sortedByMaterial(front, materials)) << "round " << round;
    }
  }
}

TEST(MaterialSlots, OneTriangleThatChangesIsOneSlotAndNothingIsNone) {
  MaterialSlots slots(2);
  const auto byParity = [](std::uint32_t t) { return t % 2; };
  Triangles front;
  for (std::uint32_t t = 0; t < 1000; ++t) front.push_back(t);
  slots.update(front, byParity);
  EXPECT_TRUE(slots.isPacked());
  slots.update(front, byParity);
  EXPECT_FALSE(slots.isPacked());
  EXPECT_TRUE(slots.changed().empty());
  front[10] = 2000;
  slots.update(front, byParity);
  EXPECT_FALSE(slots.isPacked());
  EXPECT_EQ(slots.changed().size(), 1u);
}

}  // namespace
}  // namespace arete
