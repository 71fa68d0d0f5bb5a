// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/batches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <set>
#include <string>

#include "engine/memory/required_memory.h"

namespace arete {
namespace {

/// Far more than a test takes, so that the answers alone decide what is refused.
class Batches : public testing::Test {
 protected:
  void SetUp() override { setMemoryBudget(std::uint64_t{1} << 42); }
  void TearDown() override { setMemoryBudget(0); }

  static std::vector<Vec2> grid(int side) {
    std::vector<Vec2> places;
    for (int i = 0; i < side * side; ++i) places.push_back({double(i * 7 % side), double(i / side)});
    return places;
  }
  static Status refused() { return failure(ErrorCode::outOfMemory, "needs more"); }
};

TEST_F(Batches, AreOneWhereAllFits) {
  int calls = 0;
  ASSERT_TRUE(answerInBatches(grid(8), [&](std::span<const std::uint32_t> batch) -> Status {
    ++calls;
    EXPECT_EQ(batch.size(), 64u);
    EXPECT_TRUE(std::ranges::is_sorted(batch));
    return {};
  }));
  EXPECT_EQ(calls, 1);
}

TEST_F(Batches, HoldEachQuestionOnceAndNeighboursTogether) {
  std::vector<Vec2> places = grid(16);
  places.push_back({std::nan(""), 1});
  places.push_back({std::numeric_limits<double>::infinity(), 1});
  std::multiset<std::uint32_t> answered;
  double widths = 0, batches = 0;
  ASSERT_TRUE(answerInBatches(places, [&](std::span<const std::uint32_t> batch) -> Status {
    if (batch.size() > 20) return refused();
    EXPECT_TRUE(std::ranges::is_sorted(batch));
    double low = 99, high = 0;
    for (const std::uint32_t i : batch) {
      answered.insert(i);
      if (!std::isfinite(places[i].x)) continue;
      low = std::min(low, places[i].x);
      high = std::max(high, places[i].x);
    }
    widths += high - low;
    ++batches;
    return {};
  }));
  EXPECT_EQ(answered.size(), places.size());
  EXPECT_EQ(std::set<std::uint32_t>(answered.begin(), answered.end()).size(), places.size());
  EXPECT_LE(widths / batches, 8) << "of 16 columns";
}

TEST_F(Batches, EndWhereOneQuestionAloneIsTooLarge) {
  int calls = 0;
  const Status status = answerInBatches(grid(8), [&](std::span<const std::uint32_t> batch) -> Status {
    ++calls;
    return std::ranges::count(batch, 5u) > 0 ? refused() : Status();
  });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, "needs more");
  EXPECT_LT(calls, 20);
}

TEST_F(Batches, AreDividedWhereAnAllocationFailsAsWell) {
  std::size_t answered = 0;
  ASSERT_TRUE(answerInBatches(grid(4), [&](std::span<const std::uint32_t> batch) -> Status {
    if (batch.size() > 3) throw std::bad_alloc();
    answered += batch.size();
    return {};
  }));
  EXPECT_EQ(answered, 16u);
}

TEST_F(Batches, EndAtAnyOtherErrorAtOnce) {
  int calls = 0;
  const Status status = answerInBatches(grid(4), [&](std::span<const std::uint32_t>) -> Status {
    ++calls;
    return failure(ErrorCode::corrupt, "is damaged");
  });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::corrupt);
  EXPECT_EQ(calls, 1);
}

TEST_F(Batches, AreNotMadeWithoutABudget) {
  setMemoryBudget(0);
  int calls = 0;
  EXPECT_FALSE(answerInBatches(grid(4), [&](std::span<const std::uint32_t>) -> Status {
    ++calls;
    return refused();
  }));
  EXPECT_EQ(calls, 1);
}

TEST_F(Batches, OfNoQuestionAreOneWithoutAny) {
  int calls = 0;
  EXPECT_TRUE(answerInBatches({}, [&](std::span<const std::uint32_t> batch) -> Status {
    calls += batch.empty() ? 1 : 100;
    return {};
  }));
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace arete
