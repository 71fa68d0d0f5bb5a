// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/nodes/zeroed_arena.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

namespace arete::packed {
namespace {

struct alignas(32) Wide {
  double x, y, z, w;
};

struct Some {
  ZeroedArray<std::uint8_t> bytes;
  ZeroedArray<Wide> wide;
  ZeroedArray<std::uint32_t> none, numbers;

  bool layIn(ZeroedArena& block, std::size_t size) {
    return block.lay([&](const auto& array) {
      array(bytes, size);
      array(wide, size);
      array(none, 0);
      array(numbers, size);
    });
  }
};

class ZeroedArenaTest : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ZeroedArenaTest, LaysArraysOfZerosThatDoNotTouchEachOther) {
  const std::size_t size = GetParam();
  ZeroedArena block;
  Some some;
  ASSERT_TRUE(some.layIn(block, size));
  EXPECT_EQ(some.bytes.size(), size);
  EXPECT_EQ(some.wide.view().size(), size);
  EXPECT_EQ(some.none.size(), 0u);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(some.wide.get()) % alignof(Wide), 0u);

  EXPECT_TRUE(std::ranges::all_of(some.bytes.view(), [](std::uint8_t b) { return b == 0; }));
  std::ranges::fill(std::span(some.bytes.get(), size), 255);
  EXPECT_TRUE(std::ranges::all_of(some.wide.view(), [](const Wide& w) { return w.x == 0 && w.w == 0; }));
  std::ranges::fill(std::span(some.wide.get(), size), Wide{1, 1, 1, 1});
  EXPECT_TRUE(std::ranges::all_of(some.numbers.view(), [](std::uint32_t n) { return n == 0; }));
  std::ranges::fill(std::span(some.numbers.get(), size), 7u);
  EXPECT_TRUE(std::ranges::all_of(some.bytes.view(), [](std::uint8_t b) { return b == 255; }));
  EXPECT_TRUE(std::ranges::all_of(some.wide.view(), [](const Wide& w) { return w.x == 1 && w.w == 1; }));
}

TEST_P(ZeroedArenaTest, LeavesSomeZerosBehindEachArray) {
  const std::size_t size = GetParam();
  ZeroedArena block;
  Some some;
  ASSERT_TRUE(some.layIn(block, size));
  std::ranges::fill(std::span(some.bytes.get(), size), 255);
  for (std::size_t i = size; i < size + 8; ++i) {
    EXPECT_EQ(some.bytes[i], 0);
    EXPECT_EQ(some.numbers[i], 0u);
  }
}

// From a few bytes to several pieces of pages, whose kind is chosen.
INSTANTIATE_TEST_SUITE_P(Sizes, ZeroedArenaTest, ::testing::Values(0, 1, 1000, 70'000, 1'000'000));

TEST(ZeroedArena, TakesItsMemoryAlongWhenItMoves) {
  ZeroedArena block;
  Some some;
  ASSERT_TRUE(some.layIn(block, 1000));
  some.numbers[999] = 5;
  const ZeroedArena other = std::move(block);
  EXPECT_EQ(some.numbers[999], 5u);
}

TEST(ZeroedArena, SaysThatThereIsNotEnoughMemory) {
  ZeroedArena block;
  Some some;
  ASSERT_TRUE(some.layIn(block, 1000));
  EXPECT_FALSE(some.layIn(block, std::size_t{1} << 56));
  EXPECT_TRUE(some.layIn(block, 10));
}

}  // namespace
}  // namespace arete::packed
