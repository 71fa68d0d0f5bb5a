// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/memory/pages.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <fstream>
#include <limits>
#include <random>
#include <span>
#include <thread>
#include <vector>

#include "engine/memory/paged_array.h"
#include "engine/memory/uninitialized_vector.h"

/// How often the system still moves pages before it refuses; then it has taken away what was there.
namespace {
std::atomic<int> movesLeft = std::numeric_limits<int>::max();
}

/// In the place of the C library's.
extern "C" void* mremap(void* from, std::size_t size, std::size_t newSize, int flags, ...) noexcept {
  va_list rest;
  va_start(rest, flags);
  void* const to = va_arg(rest, void*);
  va_end(rest);
  if (--movesLeft < 0) {
    munmap(to, newSize);
    errno = ENOMEM;
    return MAP_FAILED;
  }
  return reinterpret_cast<void*>(syscall(SYS_mremap, from, size, newSize, flags, to));
}

namespace arete {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

std::span<std::uint8_t> bytesOf(void* pages, std::size_t size) {
  return {static_cast<std::uint8_t*>(pages), size};
}

bool isAll(std::span<const std::uint8_t> bytes, std::uint8_t value) {
  return std::ranges::all_of(bytes, [&](std::uint8_t byte) { return byte == value; });
}

/// Gives 4 MiB back, full of sevens.
void giveSevensBack() {
  void* const pages = takePages(4 * kMiB);
  ASSERT_NE(pages, nullptr);
  std::ranges::fill(bytesOf(pages, 4 * kMiB), std::uint8_t{7});
  givePagesBack(pages, 4 * kMiB);
}

TEST(Pages, WhatIsGivenBackIsTakenAgainWhileThereIsAKeeper) {
  const PageKeeper keeper;
  giveSevensBack();
  void* const second = takePages(2 * kMiB);
  void* const third = takePages(5 * kMiB);
  EXPECT_TRUE(isAll(bytesOf(second, 2 * kMiB), 7));
  EXPECT_TRUE(isAll(bytesOf(third, 2 * kMiB), 7)) << "what was left";
  EXPECT_TRUE(isAll(bytesOf(third, 5 * kMiB).subspan(2 * kMiB), 0)) << "there was no more";
  givePagesBack(second, 2 * kMiB);
  givePagesBack(third, 5 * kMiB);
}

TEST(Pages, AreFreshWhenTheSystemMovesNoMoreAndNobodyElsesAreTouched) {
  const PageKeeper keeper;
  giveSevensBack();
  movesLeft = 1;
  void* const second = takePages(4 * kMiB);
  movesLeft = std::numeric_limits<int>::max();
  ASSERT_NE(second, nullptr);
  EXPECT_TRUE(isAll(bytesOf(second, 4 * kMiB), 0));
  givePagesBack(second, 4 * kMiB);
  void* const third = takePages(4 * kMiB);
  EXPECT_TRUE(isAll(bytesOf(third, 4 * kMiB), 0)) << "nothing is kept any more";
  givePagesBack(third, 4 * kMiB);
}

TEST(Pages, WithoutAKeeperTheyAreFresh) {
  giveSevensBack();
  void* const second = takePages(4 * kMiB);
  EXPECT_TRUE(isAll(bytesOf(second, 4 * kMiB), 0));
  givePagesBack(second, 4 * kMiB);
}

TEST(Pages, AKeeperLeavesNothingToTheNext) {
  {
    const PageKeeper outer, inner;
    giveSevensBack();
  }
  const PageKeeper keeper;
  void* const pages = takePages(4 * kMiB);
  EXPECT_TRUE(isAll(bytesOf(pages, 4 * kMiB), 0));
  givePagesBack(pages, 4 * kMiB);
}

TEST(Pages, ZerosAreZerosWhateverIsKept) {
  const PageKeeper keeper;
  void* const used = takePages(4 * kMiB);
  std::ranges::fill(bytesOf(used, 4 * kMiB), std::uint8_t{7});
  givePagesBack(used, 4 * kMiB);
  void* const zeros = takeZeroPages(4 * kMiB);
  EXPECT_TRUE(isAll(bytesOf(zeros, 4 * kMiB), 0));
  std::ranges::fill(bytesOf(zeros, 4 * kMiB), std::uint8_t{9});
  giveZeroPagesBack(zeros, 4 * kMiB);
  void* const again = takePages(8 * kMiB);
  EXPECT_TRUE(isAll(bytesOf(again, 4 * kMiB), 7));
  EXPECT_TRUE(isAll(bytesOf(again, 8 * kMiB).subspan(4 * kMiB), 0)) << "who asked for zeros keeps nothing";
  givePagesBack(again, 8 * kMiB);
}

TEST(Pages, AreZerosOfWhicheverKindTheyAre) {
  // Enough for either kind to be tried some times.
  constexpr std::size_t kMany = 160 * kMiB + 123;
  void* const zeros = takeZeroPages(kMany);
  ASSERT_NE(zeros, nullptr);
  EXPECT_TRUE(isAll(bytesOf(zeros, kMany), 0));
  giveZeroPagesBack(zeros, kMany);
}

TEST(Pages, AnArrayThatShrinksLeavesWholePiecesToTheNextAndKeepsTheRest) {
  const PageKeeper keeper;
  PagedArray<std::uint32_t> numbers(3'000'000);
  for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i + 1;
  numbers.shrink(1'000'000);
  PagedArray<std::uint32_t> next(1'500'000);
  EXPECT_TRUE(std::ranges::all_of(next, [](std::uint32_t n) { return n > 1'000'000; }))
      << "pages that were left";
  std::ranges::fill(next, 0u);
  numbers.shrink(10);
  numbers.shrink(10);
  numbers.shrink(0);
  EXPECT_TRUE(numbers.empty());
  PagedArray<std::uint32_t> rest = std::move(next);
  EXPECT_EQ(rest.size(), 1'500'000u);
  rest = PagedArray<std::uint32_t>(5);
  EXPECT_EQ(rest.size(), 5u);
}

TEST(Pages, AreFreshWhenSoManyWereMovedThatMappingsMightRunOut) {
  const PageKeeper keeper;
  std::uint8_t seen = 1;
  for (int i = 0; i < (1 << 15) + 2; ++i) {
    void* const pages = takePages(kPieceOfPages);
    seen = bytesOf(pages, 1)[0];
    bytesOf(pages, 1)[0] = 7;
    givePagesBack(pages, kPieceOfPages);
    if (i == 1) {
      EXPECT_EQ(seen, 7);
    }
  }
  EXPECT_EQ(seen, 0);
}

TEST(Pages, WhatIsKeptGoesWhenTheSystemHasNoMoreAddresses) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  if (before.rlim_cur != RLIM_INFINITY) GTEST_SKIP() << "addresses are limited already";
  const PageKeeper keeper;
  constexpr std::size_t kMost = 512 * kMiB;
  void* const first = takePages(kMost);
  ASSERT_NE(first, nullptr);
  givePagesBack(first, kMost);
  // What the process has now, all of it kept, and a little more: as much again is not to be had.
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit limit = before;
  limit.rlim_cur = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + 64 * kMiB;
  if (pages == 0 || setrlimit(RLIMIT_AS, &limit) != 0) GTEST_SKIP() << "addresses cannot be limited here";
  void* const second = takePages(kMost);
  setrlimit(RLIMIT_AS, &before);
  ASSERT_NE(second, nullptr);
  bytesOf(second, kMost)[kMost - 1] = 1;
  givePagesBack(second, kMost);
}

TEST(Pages, WhatWasPutTogetherFromKeptOnesOutlivesTheKeeper) {
  UninitializedVector<std::uint32_t> numbers;
  {
    const PageKeeper keeper;
    // Of sizes that are no whole number of pieces.
    UninitializedVector<std::uint32_t> a(900'001, 1), b(2'100'003, 2), c(123, 3);
    UninitializedVector<std::uint32_t>().swap(a);
    UninitializedVector<std::uint32_t>().swap(b);
    numbers.resize(3'600'007);
    for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  }
  for (std::uint32_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], i);
}

TEST(Pages, NoTwoHaveTheSameWhoeverTakesThem) {
  const PageKeeper keeper;
  std::vector<std::uint8_t> isWhole(4, 0);
  std::vector<std::thread> threads;
  for (std::uint8_t t = 0; t < isWhole.size(); ++t)
    threads.emplace_back([&, t] {
      std::mt19937 random(t);
      bool isMine = true;
      for (int round = 0; round < 50; ++round) {
        UninitializedVector<std::uint8_t> pages(kMiB / 4 + random() % (12 * kMiB));
        std::ranges::fill(pages, t);
        isMine = isMine && isAll(pages, t);
      }
      isWhole[t] = isMine ? 1 : 0;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(isWhole, std::vector<std::uint8_t>(4, 1));
}

}  // namespace
}  // namespace arete
