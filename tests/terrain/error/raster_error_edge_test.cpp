// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bound along an edge against a test of every edge of the finest triangulation.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "terrain/error/raster_error.h"

namespace arete {
namespace {

/// The bound along an edge by trying every edge of the finest triangulation in its box; where it crosses them
/// at one of their samples as well, or not.
SignedBound byTryingAllEdges(bool hasSamples, const std::vector<double>& heights, std::uint32_t columns,
                             const RasterError::Corner& a, const RasterError::Corner& b) {
  SignedBound bound;
  const int dx = b.x - a.x, dy = b.y - a.y;
  for (int y = std::min(a.y, b.y); y <= std::max(a.y, b.y); ++y)
    for (int x = std::min(a.x, b.x); x <= std::max(a.x, b.x); ++x)
      for (const auto& [ex, ey] : {std::array{1, 0}, {0, 1}, {1, 1}}) {
        // a + (dx, dy) t = (x, y) + (ex, ey) s
        const int cross = dx * ey - dy * ex, sign = cross > 0 ? 1 : -1, whole = cross * sign;
        const int t = ((x - a.x) * ey - (y - a.y) * ex) * sign, s = ((x - a.x) * dy - (y - a.y) * dx) * sign;
        if (cross == 0 || t <= 0 || t >= whole || s < 0 || s > whole) continue;
        if (!hasSamples && (s == 0 || s == whole)) continue;
        if (x + ex >= int(columns) || std::size_t(y + ey) >= heights.size() / columns) continue;
        const double from = heights[std::size_t(y) * columns + std::size_t(x)],
                     to = heights[std::size_t(y + ey) * columns + std::size_t(x + ex)];
        const double difference = a.z + (b.z - a.z) * t / whole - (from + (to - from) * s / whole);
        if (!std::isnan(difference)) bound.include(difference);
      }
  return bound;
}

TEST(RasterError, BoundsAlongEdgesAreThoseOfEveryCrossingWithTheFinestTriangulation) {
  std::mt19937 random(20261122);
  constexpr std::uint32_t kColumns = 40, kRows = 33;
  int shortOnes = 0, longOnes = 0;
  for (int run = 0; run < 4000; ++run) {
    std::vector<double> heights(std::size_t(kColumns) * kRows);
    for (double& z : heights) z = random() % 40 == 0 ? std::nan("") : double(random() % 4096) / 16;
    const LatticePlan plan(kColumns, 1 + random() % 3, 1 + random() % 2);
    const RasterError errors(plan, heights, false);
    // Short ones and long ones, those along the raster's border among them.
    const int reach = run % 2 == 0 ? 6 : 39;
    const auto near = [&](int from, int end) {
      const int low = std::max(0, from - reach), high = std::min(end - 1, from + reach);
      return low + int(random() % unsigned(high - low + 1));
    };
    const int ax = int(random() % kColumns), ay = int(random() % kRows);
    const RasterError::Corner a{ax, ay, double(random() % 256)},
        b{near(ax, int(kColumns)), near(ay, int(kRows)), double(random() % 256)};
    if (a.x == b.x && a.y == b.y) continue;
    ++(EdgeCrossingTable::isShort(b.x - a.x, b.y - a.y) ? shortOnes : longOnes);
    // A sample on the edge need not count, as a scan of the triangle has it, and may.
    const SignedBound least = byTryingAllEdges(false, heights, kColumns, a, b),
                      most = byTryingAllEdges(true, heights, kColumns, a, b), found = errors.alongEdge(a, b);
    EXPECT_GE(found.above, least.above - 1e-11) << "run " << run;
    EXPECT_GE(found.below, least.below - 1e-11) << "run " << run;
    EXPECT_LE(found.above, most.above + 1e-11) << "run " << run;
    EXPECT_LE(found.below, most.below + 1e-11) << "run " << run;
  }
  EXPECT_GT(shortOnes, 500);
  EXPECT_GT(longOnes, 500);
}

}  // namespace
}  // namespace arete
