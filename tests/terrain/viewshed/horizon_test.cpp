// SPDX-License-Identifier: GPL-3.0-or-later
//
// The skyline against the maximum over all segments, direction by direction.
#include "terrain/viewshed/horizon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "datasets/random.h"

namespace arete::test {
namespace {

struct Segment {
  double u0, v0, u1, v1, slack;
  long double at(double u) const {
    return v0 + ((long double)v1 - v0) * (((long double)u - u0) / ((long double)u1 - u0));
  }
};

TEST(ViewshedHorizon, IsTheUpperEnvelopeOfItsSegments) {
  constexpr std::uint64_t kSeed = 101;
  Random random(kSeed);
  for (int round = 0; round < 150; ++round) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", round " << round);
    const double first = random.between(-1, 0), last = random.between(0.1, 1);
    ViewshedHorizon horizon(first, last, 1 + random.below(20));
    std::vector<Segment> segments;
    const std::uint32_t count = 1 + random.below(60);
    for (std::uint32_t i = 0; i < count; ++i) {
      const double u = random.between(first - 0.2, last + 0.2), width = random.between(1e-4, 0.5);
      Segment s{u, random.between(-1, 1), u + width, random.between(-1, 1), 1e-6 * random.unit()};
      horizon.add(s.u0, s.v0, s.u1, s.v1, s.slack);
      segments.push_back(s);
      if (i % 3 == 0)
        horizon.add(s.u1, s.v1, s.u0, s.v0, s.slack);  // either way round; twice changes nothing
    }
    for (int k = 0; k < 300; ++k) {
      const double u = random.between(first, last);
      long double most = -HUGE_VALL, sure = -HUGE_VALL;
      for (const Segment& s : segments) {
        if (u < s.u0 || u > s.u1) continue;
        most = std::max(most, s.at(u));
        sure = std::max(sure, s.at(u) - s.slack);
      }
      const ViewshedHorizon::Bounds bounds = horizon.at(u);
      if (most == -HUGE_VALL) {
        EXPECT_EQ(bounds.upper, -HUGE_VAL);
        continue;
      }
      // A segment may be left out where it is a hundredth of its slack above the others.
      EXPECT_NEAR(bounds.upper, double(most), 1e-8 + 1e-11);
      EXPECT_LE(bounds.lower, bounds.upper);
      EXPECT_LE(bounds.lower, double(most) + 1e-12);
      EXPECT_GE(bounds.lower, double(sure) - 1.02e-6);
      const int bin = horizon.bin(u);
      EXPECT_LE(horizon.low(bin), bounds.lower + 1e-12);
      EXPECT_GE(horizon.high(bin), bounds.upper - 1e-12);
      EXPECT_LE(horizon.low(0, horizon.binCount() - 1), horizon.low(bin));
    }
  }
}

TEST(ViewshedHorizon, IsEmptyAtFirstAndIgnoresWhatHasNoWidthOrIsOutside) {
  ViewshedHorizon horizon(0, 1, 8);
  horizon.add(0.5, 3, 0.5, 9, 0);
  horizon.add(1.5, 3, 2, 3, 0);
  horizon.add(-2, 3, -1, 3, 0);
  for (const double u : {0.01, 0.5, 0.99}) EXPECT_EQ(horizon.at(u).upper, -HUGE_VAL);
  EXPECT_EQ(horizon.bin(-5), 0);
  EXPECT_EQ(horizon.bin(5), horizon.binCount() - 1);
}

TEST(ViewshedHorizon, ASegmentOfInfiniteSlackRaisesOnlyTheUpperBound) {
  ViewshedHorizon horizon(0, 1, 4);
  horizon.add(0, 1, 1, 1, 0);
  horizon.add(0.2, 2, 0.8, 2, HUGE_VAL);
  EXPECT_EQ(horizon.at(0.1).upper, 1);
  EXPECT_EQ(horizon.at(0.5).lower, -HUGE_VAL);
}

}  // namespace
}  // namespace arete::test
