// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines over polygons beside the observer, against points sampled along the lines.
#include "terrain/viewshed/near_gaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "datasets/random.h"

namespace arete::test {
namespace {

/// The length of the line over the polygon, sampled.
double sampledLength(const std::vector<Vec2>& corners, double u) {
  constexpr double kStep = 1e-4;
  const double x = 1 / std::sqrt(1 + u * u);
  int inside = 0;
  for (double s = kStep / 2; s < 4; s += kStep) {
    const double px = s * x, py = s * u * x;
    int left = 0, right = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
      const double side = (b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x);
      (side >= 0 ? left : right)++;
    }
    inside += left == 0 || right == 0;
  }
  return inside * kStep;
}

TEST(ViewshedNearGaps, KnowWhichLinesAreOverThem) {
  constexpr std::uint64_t kSeed = 111;
  Random random(kSeed);
  int certain = 0, missed = 0;
  for (int i = 0; i < 400; ++i) {
    // A cell, or a half of it, around or beside the observer.
    const double x = -random.unit(), y = random.between(-2, 1);
    std::vector<Vec2> corners = {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
    if (i % 2 == 0) corners.erase(corners.begin() + random.below(4));
    if (i % 3 == 0) std::reverse(corners.begin(), corners.end());
    ViewshedNearGaps gaps;
    EXPECT_TRUE(gaps.isEmpty());
    gaps.add(corners);
    EXPECT_FALSE(gaps.isEmpty());
    const double u = random.between(-1, 1);
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", gap " << i << ", u " << u);
    const ViewshedNearGaps::Crossing crossing = gaps.towards(u);
    const double length = sampledLength(corners, u);
    if (length > 1e-3) {
      EXPECT_TRUE(crossing.isCertain);
    }
    if (length == 0) {
      EXPECT_FALSE(crossing.isCertain);
    }
    if (crossing.isCertain) {
      EXPECT_TRUE(crossing.isPossible);
    }
    if (!crossing.isPossible) {
      EXPECT_EQ(length, 0);
    }
    certain += crossing.isCertain;
    missed += !crossing.isPossible;
  }
  EXPECT_GT(certain, 100);
  EXPECT_GT(missed, 50);
}

TEST(ViewshedNearGaps, FromTheBorderOfAGapLinesAwayFromItMissIt) {
  ViewshedNearGaps gaps;
  gaps.add(std::vector<Vec2>{{-1, 0}, {1, 0}, {1, 1}, {-1, 1}});
  EXPECT_FALSE(gaps.towards(-0.5).isPossible);
  EXPECT_TRUE(gaps.towards(0.5).isCertain);
  // Along the border, rounding decides.
  EXPECT_TRUE(gaps.towards(0).isPossible);
  EXPECT_FALSE(gaps.towards(0).isCertain);
}

TEST(ViewshedNearGaps, AnErrorOfTheDirectionMakesCloseLinesUncertain) {
  ViewshedNearGaps gaps;
  gaps.add(std::vector<Vec2>{{1, 0.5}, {2, 0.5}, {2, 1}, {1, 1}});
  EXPECT_FALSE(gaps.towards(0.2499).isPossible);
  EXPECT_TRUE(gaps.towards(0.26).isCertain);
  gaps.setError(0.02);
  EXPECT_TRUE(gaps.towards(0.2499).isPossible);
  EXPECT_FALSE(gaps.towards(0.26).isCertain);
}

}  // namespace
}  // namespace arete::test
