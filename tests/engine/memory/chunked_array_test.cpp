// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/memory/chunked_array.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>
#include <vector>

namespace arete {
namespace {

TEST(ChunkedArray, KeepsItsElementsWhereTheyAreWhileItGrows) {
  ChunkedArray<std::uint32_t> array;
  array.resize(1000);
  for (std::uint32_t i = 0; i < 1000; ++i) array[i] = i;
  const std::uint32_t* const first = &array[0];
  array.resize(3'000'000);
  EXPECT_EQ(array.size(), 3'000'000u);
  EXPECT_EQ(&array[0], first);
  for (std::uint32_t i = 0; i < 1000; ++i) ASSERT_EQ(array[i], i);
}

TEST(ChunkedArray, HasElementsOfSizesThatDivideNoPage) {
  struct Odd {
    std::uint32_t a, b, c;
  };
  ChunkedArray<Odd> array;
  array.resize(1'000'003);
  for (std::uint32_t i = 0; i < array.size(); ++i) array[i] = {i, i + 1, i + 2};
  for (std::uint32_t i = 0; i < array.size(); ++i) ASSERT_EQ(array[i].c, i + 2);
}

TEST(ChunkedArray, MayBeWrittenByOtherThreadsWhileItGrowsWithinWhatIsReserved) {
  constexpr std::size_t kMost = 4'000'000;
  ChunkedArray<std::uint32_t> array;
  array.reserve(kMost);
  array.resize(1'000'000);
  std::thread writer([&] {
    for (std::uint32_t i = 0; i < 1'000'000; ++i) array[i] = i;
  });
  for (std::size_t size = 1'000'000; size <= kMost; size += 100'000) array.resize(size);
  writer.join();
  for (std::uint32_t i = 0; i < 1'000'000; ++i) ASSERT_EQ(array[i], i);
}

TEST(ChunkedArray, IsEmptyAndUsableAgainAfterClear) {
  ChunkedArray<std::uint8_t> array;
  array.resize(10'000'000);
  array.clear();
  EXPECT_EQ(array.size(), 0u);
  array.resize(5);
  array[4] = 9;
  EXPECT_EQ(array[4], 9);
}

}  // namespace
}  // namespace arete
