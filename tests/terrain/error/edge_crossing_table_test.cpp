// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/error/edge_crossing_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace arete {
namespace {

constexpr int kColumns = 100;

/// A crossing with the edge between two samples, by their numbers.
struct Found {
  std::array<int, 2> samples;
  double along, between;
};

/// Every edge of the finest triangulation around is tried, by the intersection of two segments.
std::vector<Found> byTryingAllEdges(int dx, int dy) {
  std::vector<Found> found;
  const int far = EdgeCrossingTable::kReach + 1;
  for (int y = -far; y <= far; ++y)
    for (int x = -far; x <= far; ++x)
      for (const auto& [ex, ey] : {std::array{1, 0}, {0, 1}, {1, 1}}) {
        // (dx, dy) t = (x, y) + (ex, ey) s
        const int cross = dx * ey - dy * ex;
        if (cross == 0) continue;
        const int t = x * ey - y * ex, s = x * dy - y * dx;  // times cross
        const int sign = cross > 0 ? 1 : -1, whole = cross * sign;
        if (t * sign <= 0 || t * sign >= whole || s * sign <= 0 || s * sign >= whole) continue;
        found.push_back(
            {{y * kColumns + x, (y + ey) * kColumns + x + ex}, double(t) / cross, double(s) / cross});
      }
  return found;
}

TEST(EdgeCrossingTable, CrossWhatATryOfAllEdgesSays) {
  const EdgeCrossingTable edges(kColumns);
  std::size_t crossings = 0;
  for (int dy = -EdgeCrossingTable::kReach; dy <= EdgeCrossingTable::kReach; ++dy)
    for (int dx = -EdgeCrossingTable::kReach; dx <= EdgeCrossingTable::kReach; ++dx) {
      ASSERT_TRUE(EdgeCrossingTable::isShort(dx, dy));
      std::vector<Found> expected = byTryingAllEdges(dx, dy), actual;
      for (const EdgeCrossingTable::Crossing& c : edges.of(dx, dy))
        actual.push_back({{c.from, c.to}, c.along, c.between});
      const auto bySamples = [](const Found& a, const Found& b) { return a.samples < b.samples; };
      std::sort(expected.begin(), expected.end(), bySamples);
      std::sort(actual.begin(), actual.end(), bySamples);
      ASSERT_EQ(actual.size(), expected.size()) << dx << " " << dy;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(actual[i].samples, expected[i].samples) << dx << " " << dy;
        EXPECT_NEAR(actual[i].along, expected[i].along, 1e-15) << dx << " " << dy;
        EXPECT_NEAR(actual[i].between, expected[i].between, 1e-15) << dx << " " << dy;
      }
      crossings += expected.size();
    }
  EXPECT_GT(crossings, 500u);
  EXPECT_FALSE(EdgeCrossingTable::isShort(0, EdgeCrossingTable::kReach + 1));
  EXPECT_FALSE(EdgeCrossingTable::isShort(-EdgeCrossingTable::kReach - 1, 0));
}

}  // namespace
}  // namespace arete
