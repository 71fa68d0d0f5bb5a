// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/ranges/range_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace arete {
namespace {

using Ranges = std::vector<ByteRange>;

TEST(RangePlan, JoinsRangesThatMeetAndLeavesOutEmptyOnes) {
  EXPECT_EQ(joinedRanges({{30, 40}, {10, 20}, {20, 25}, {12, 15}, {50, 50}}), (Ranges{{10, 25}, {30, 40}}));
  EXPECT_TRUE(joinedRanges({}).empty());
}

TEST(RangePlan, FetchesNearRangesTogetherAndFarOnesAlone) {
  constexpr std::uint64_t kNear = (1 << 17) - 1, kFar = 1 << 17;
  EXPECT_EQ(planRequests({{0, 100}, {100 + kNear, 200 + kNear}}), (Ranges{{0, 200 + kNear}}));
  EXPECT_EQ(planRequests({{0, 100}, {100 + kFar, 200 + kFar}}), (Ranges{{0, 100}, {100 + kFar, 200 + kFar}}));
  EXPECT_TRUE(planRequests({}).empty());
}

TEST(RangePlan, JoinsManyFarRangesForAsManyBytesMoreAsAreWanted) {
  Ranges many;
  for (std::uint64_t i = 0; i < 40; ++i) many.push_back({i * 500'000, i * 500'000 + 200'000});
  const Ranges planned = planRequests(many);
  std::uint64_t fetched = 0;
  for (const ByteRange& range : planned) fetched += range.size();
  EXPECT_EQ(planned.size(), 14u)
      << "27 gaps of 300 000 bytes are closed, and the longest request is cut in two";
  EXPECT_LE(fetched, 40u * 200'000 * 2 + (1 << 17));
  EXPECT_EQ(planRequests({many.begin(), many.begin() + 5}).size(), 5u) << "five are few";
}

// Segments of pages that a moving camera needs lie scattered: what lies between is not fetched over and over.
TEST(RangePlan, FetchesBetweenScatteredRangesALimitedShareOfTheirBytes) {
  Ranges scattered;
  for (std::uint64_t i = 0; i < 100; ++i) scattered.push_back({i * 60'000, i * 60'000 + 5000});
  const RangeRules rules;
  std::uint64_t fetched = 0;
  for (const ByteRange& range : planRequests(scattered, rules)) fetched += range.size();
  EXPECT_LE(static_cast<double>(fetched),
            static_cast<double>(rules.gapsBytes) + (1 + rules.gapsShare) * 500'000);
  EXPECT_GT(fetched, 500'000u + 4 * 55'000) << "as far as the share goes, requests are saved";
  EXPECT_EQ(planRequests({scattered.begin(), scattered.begin() + 3}).size(), 1u) << "few are joined";
}

TEST(RangePlan, CutsLongRangesIntoRequestsOfEightMebibytes) {
  const std::uint64_t end = (std::uint64_t{3} << 23) + 5;
  const Ranges planned = planRequests({{7, end}});
  ASSERT_EQ(planned.size(), 3u);
  EXPECT_EQ(planned[0], (ByteRange{7, 7 + (1 << 23)}));
  EXPECT_EQ(planned[2].end, end);
}

// The oracle marks bytes one by one.
TEST(RangePlan, HasEveryWantedByteOnceInOrder) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    constexpr std::uint64_t kBytes = 3000;
    RangeRules rules;
    rules.gap = random() % 40;
    rules.fewRequests = 1 + random() % 5;
    rules.longest = 20 + random() % 600;
    std::vector<bool> isWanted(kBytes);
    Ranges ranges;
    for (unsigned i = random() % 30; i-- > 0;) {
      const std::uint64_t begin = random() % kBytes, end = std::min(kBytes, begin + random() % 60);
      ranges.push_back({begin, end});
      for (std::uint64_t b = begin; b < end; ++b) isWanted[b] = true;
    }
    std::vector<int> fetched(kBytes);
    std::uint64_t last = 0;
    for (const ByteRange& request : planRequests(joinedRanges(ranges), rules)) {
      ASSERT_LT(request.begin, request.end) << "seed " << seed;
      ASSERT_LE(last, request.begin) << "seed " << seed;
      ASSERT_LE(request.size(), rules.longest) << "seed " << seed;
      last = request.end;
      for (std::uint64_t b = request.begin; b < request.end; ++b) ++fetched[b];
    }
    for (std::uint64_t b = 0; b < kBytes; ++b) {
      ASSERT_LE(fetched[b], 1) << "seed " << seed;
      ASSERT_TRUE(!isWanted[b] || fetched[b] == 1) << "seed " << seed << ", byte " << b;
    }
  }
}

}  // namespace
}  // namespace arete
