// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/memory/pages.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <random>
#include <span>
#include <thread>
#include <vector>

#include "engine/memory/paged_array.h"
#include "engine/memory/uninitialized_vector.h"

namespace arete {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

std::span<std::uint8_t> bytesOf(void* pages, std::size_t size) {
  return {static_cast<std::uint8_t*>(pages), size};
}

bool isAll(std::span<const std::uint8_t> bytes, std::uint8_t value) {
  return std::ranges::all_of(bytes, [&](std::uint8_t byte) { return byte == value; });
}

std::size_t mappedPages() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages;
}

TEST(Pages, AreZerosAlsoWhereSomebodyElseHasWritten) {
  for (const bool isHuge : {true, false}) {
    setHugePages(isHuge);
    for (const std::size_t size : {std::size_t{5}, 3 * kMiB, 4 * kMiB, 37 * kMiB + 123}) {
      for (int round = 0; round < 2; ++round) {
        void* const pages = takePages(size);
        ASSERT_NE(pages, nullptr);
        EXPECT_TRUE(isAll(bytesOf(pages, size), 0)) << size;
        std::ranges::fill(bytesOf(pages, size), std::uint8_t{7});
        givePagesBack(pages, size);
      }
    }
  }
  setHugePages(true);
}

TEST(Pages, OfLargeArraysStartWhereAHugePageCan) {
  for (const std::size_t size : {kHugePage, 3 * kMiB, 64 * kMiB}) {
    void* const pages = takePages(size);
    EXPECT_EQ(bytesToHugePage(pages), 0u);
    givePagesBack(pages, size);
  }
}

TEST(Pages, GoBackToTheSystem) {
  const std::size_t before = mappedPages();
  if (before == 0) GTEST_SKIP() << "this system does not say what is mapped";
  for (int i = 0; i < 100; ++i) {
    void* const pages = takePages(64 * kMiB + 5);
    bytesOf(pages, 1)[0] = 1;
    givePagesBack(pages, 64 * kMiB + 5);
  }
  EXPECT_LT(mappedPages(), before + 64 * kMiB / static_cast<std::size_t>(sysconf(_SC_PAGESIZE)));
}

TEST(Pages, AreNullWhereThereAreNoMore) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  if (before.rlim_cur != RLIM_INFINITY) GTEST_SKIP() << "addresses are limited already";
  rlimit limit = before;
  limit.rlim_cur = mappedPages() * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + 64 * kMiB;
  if (mappedPages() == 0 || setrlimit(RLIMIT_AS, &limit) != 0)
    GTEST_SKIP() << "addresses cannot be limited here";
  void* const pages = takePages(512 * kMiB);
  EXPECT_THROW(UninitializedVector<std::uint8_t>(512 * kMiB), std::bad_alloc);
  EXPECT_THROW(PagedArray<std::uint8_t>(512 * kMiB), std::bad_alloc);
  setrlimit(RLIMIT_AS, &before);
  EXPECT_EQ(pages, nullptr);
}

TEST(Pages, AnArrayThatShrinksKeepsItsFirstElements) {
  PagedArray<std::uint32_t> numbers(3'000'000);
  for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i + 1;
  for (const std::size_t size :
       {std::size_t{1'000'000}, std::size_t{999'999}, std::size_t{10}, std::size_t{10}}) {
    numbers.shrink(size);
    ASSERT_EQ(numbers.size(), size);
    for (std::uint32_t i = 0; i < size; ++i) ASSERT_EQ(numbers[i], i + 1);
  }
  numbers.shrink(0);
  EXPECT_TRUE(numbers.empty());
  PagedArray<std::uint32_t> rest = PagedArray<std::uint32_t>(1'500'000);
  EXPECT_EQ(rest.size(), 1'500'000u);
  rest = PagedArray<std::uint32_t>(5);
  EXPECT_EQ(rest.size(), 5u);
}

TEST(Pages, OfAShrunkArrayGoBackAndNoOthers) {
  void* const pages = takePages(10 * kMiB);
  std::ranges::fill(bytesOf(pages, 10 * kMiB), std::uint8_t{3});
  std::size_t mapped = giveTailBack(pages, 10 * kMiB, 5 * kMiB);
  EXPECT_EQ(mapped, 6 * kMiB);
  EXPECT_TRUE(isAll(bytesOf(pages, mapped), 3));
  mapped = giveTailBack(pages, mapped, 0);
  EXPECT_EQ(mapped, kHugePage) << "an array keeps its first page";
  givePagesBack(pages, mapped);
  void* const small = takePages(100);
  EXPECT_EQ(giveTailBack(small, 100, 1), 100u) << "small arrays stay as they are";
  givePagesBack(small, 100);
}

TEST(Pages, TakenByDifferentThreadsDoNotOverlap) {
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

TEST(Pages, AdviceOnHeapBlocksChangesNothingInThem) {
  std::vector<std::uint32_t> numbers;
  reserveInPages(numbers, 8'000'000);
  for (std::uint32_t i = 0; i < 8'000'000; ++i) numbers.push_back(i);
  adviseHugePages(numbers.data(), numbers.size() * sizeof(std::uint32_t));
  for (std::uint32_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], i);
  adviseHugePages(nullptr, 0);
  giveFreeHeapBack();
}

}  // namespace
}  // namespace arete
