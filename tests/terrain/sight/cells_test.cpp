// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cell walk against the oracle's triangles: what is reported covers the leg, in order, and has the
// oracle's heights, NODATA included.
#include "terrain/sight/cells.h"

#include <gtest/gtest.h>

#include <vector>

#include "datasets/random.h"
#include "terrain/sight_oracle.h"

namespace arete::test {
namespace {

struct Stretch {
  double t0, z0, t1, z1;
  bool isTerrain;
};

struct Collector {
  std::vector<Stretch> stretches;
  std::size_t most = SIZE_MAX;
  void terrain(double t0, double z0, double t1, double z1) { stretches.push_back({t0, z0, t1, z1, true}); }
  void gap(double t0, double t1) { stretches.push_back({t0, 0, t1, 0, false}); }
  bool isDone() const { return stretches.size() >= most; }
};

std::vector<double> randomHeights(Random& random, std::uint32_t count, double voids) {
  std::vector<double> heights;
  for (std::uint32_t i = 0; i < count; ++i)
    heights.push_back(random.unit() < voids ? std::nan("") : random.between(-50, 50));
  return heights;
}

TEST(SightCells, CoverALegWithTheSurfaceAndItsGaps) {
  constexpr std::uint64_t kSeed = 31;
  Random random(kSeed);
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", leg " << i);
    const std::uint32_t columns = 2 + random.below(12), rows = 2 + random.below(12);
    const std::vector<double> heights = randomHeights(random, columns * rows, i % 3 == 0 ? 0 : 0.15);
    const SightGrid grid(columns, rows, heights);
    const SightOracle oracle(columns, rows, heights);
    const auto anywhere = [&] { return Vec2{random.between(0, columns - 1), random.between(0, rows - 1)}; };
    Vec2 a = anywhere(), b = anywhere();
    // A third runs along a lattice line, or along a diagonal.
    if (i % 6 == 0) a.y = b.y = random.below(rows);
    if (i % 6 == 3) b = {a.x + std::min(columns - 1 - a.x, rows - 1 - a.y), 0}, b.y = a.y + (b.x - a.x);
    if (a.x == b.x && a.y == b.y) continue;
    const SightLeg leg({a, 0}, {b, 1});
    Collector sink;
    const SightRange range = rangeOver(leg, columns - 1, rows - 1);
    ASSERT_LE(range.first, range.last);
    EXPECT_GT(walkCells(grid, leg, range, sink), 0u);
    double done = range.first;
    for (const Stretch& s : sink.stretches) {
      EXPECT_NEAR(s.t0, done, 1e-8);
      EXPECT_LE(s.t0, s.t1 + 1e-12);
      done = s.t1;
      if (s.t1 - s.t0 < 1e-6) continue;
      const double t = s.t0 + 0.37 * (s.t1 - s.t0);
      const auto z = oracle.heightAt({leg.x + t * leg.dx, leg.y + t * leg.dy});
      ASSERT_EQ(z.has_value(), s.isTerrain) << t;
      if (z) {
        EXPECT_NEAR(double(*z), s.z0 + 0.37 * (s.z1 - s.z0), 1e-7) << t;
      }
    }
    EXPECT_NEAR(done, range.last, 1e-8);
  }
}

TEST(SightCells, StopWhenTheSinkIsDone) {
  Random random(32);
  const SightGrid grid(20, 20, randomHeights(random, 400, 0));
  const SightLeg leg({{0.5, 0.25}, 0}, {{18.5, 17.75}, 1});
  Collector sink;
  sink.most = 5;
  EXPECT_LE(walkCells(grid, leg, {0, 1}, sink), 5u);
  EXPECT_LE(sink.stretches.size(), 6u);
}

}  // namespace
}  // namespace arete::test
