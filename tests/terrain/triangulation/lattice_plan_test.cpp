// SPDX-License-Identifier: GPL-3.0-or-later
//
// The integer predicates against the same determinants in long double, which hold them exactly at this size.
#include "terrain/triangulation/lattice_plan.h"

#include <gtest/gtest.h>

#include "datasets/random.h"

namespace arete {
namespace {

struct Corner {
  std::int32_t x, y;
};

int signOf(long double x) {
  return (x > 0) - (x < 0);
}

TEST(LatticePlan, DividesEverySampleExactly) {
  Random random(1);
  for (const std::uint32_t columns :
       {2u, 3u, 7u, 1201u, 3601u, 65'535u, 65'536u, 1'000'003u, 4'294'967'295u}) {
    const LatticePlan plan(columns, 1, 1);
    const auto check = [&](std::uint32_t sample) {
      const LatticePlan::Cell cell = plan.cell(VertexId(sample));
      ASSERT_EQ(cell.row, sample / columns) << sample << " of " << columns;
      ASSERT_EQ(cell.column, sample % columns) << sample << " of " << columns;
    };
    for (int i = 0; i < 2000; ++i) check(static_cast<std::uint32_t>(random.next()));
    for (const std::uint64_t row : {1ull, 2ull, 4'294'967'295ull / columns})  // around the ends of rows
      for (const std::int64_t beside : {-1, 0, 1}) {
        const std::int64_t sample = std::int64_t(row * columns) + beside;
        if (sample <= 4'294'967'295) check(static_cast<std::uint32_t>(sample));
      }
    check(0);
    check(4'294'967'295u);
  }
}

TEST(LatticePlan, TurnsCounterclockwiseInColumnAndRow) {
  const LatticePlan plan(10, 3, 2);
  const VertexId a(0), right(1), above(10);
  EXPECT_GT(plan.orientation(a, right, above), 0);
  EXPECT_LT(plan.orientation(a, above, right), 0);
  EXPECT_EQ(plan.orientation(a, VertexId(11), VertexId(22)), 0);
  EXPECT_EQ(plan.planPosition(VertexId(37)), (Vec2{7, 3})) << "columns and rows: the metric is not in it";
}

TEST(LatticePlan, JudgesCirclesInTheMetric) {
  // A square of samples is cocircular; with rows of double length the four are a rectangle, cocircular too.
  for (const std::uint32_t q : {1u, 2u, 16u}) {
    const LatticePlan plan(100, 1, q);
    const std::vector<Corner> corners = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {5, -1}, {5, 1}};
    const LatticePlan::Polygon polygon(plan, Corner{5, 5}, std::span<const Corner>(corners));
    EXPECT_EQ(polygon.inCircle(0, 1, 2, 3), 0);
    EXPECT_GT(polygon.inCircle(0, 1, 2, 5), 0) << "within the square";
    // Just outside the edge: within the circle unless the rectangle is much higher than wide.
    EXPECT_EQ(polygon.inCircle(0, 1, 2, 4) > 0, 25 - double(q) * q * 11 > 0) << q;
  }
}

TEST(LatticePlan, HasExactSignsForSmallAndForLargePolygons) {
  Random random(7);
  for (const std::int32_t spread : {3, 100, 5000, 60'000}) {
    const LatticePlan plan(70'000, 5, 3);
    for (int trial = 0; trial < 300; ++trial) {
      std::vector<Corner> corners(6);
      const Corner apex{200 + std::int32_t(random.below(100)), 300};
      for (Corner& c : corners)
        c = {std::int32_t(random.below(std::uint32_t(spread))),
             std::int32_t(random.below(std::uint32_t(spread)))};
      const LatticePlan::Polygon polygon(plan, apex, std::span<const Corner>(corners));
      const auto x = [&](int i) { return 5.0L * (corners[std::size_t(i)].x - apex.x); };
      const auto y = [&](int i) { return 3.0L * (corners[std::size_t(i)].y - apex.y); };
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
          ASSERT_EQ(polygon.orientationToApex(i, j), signOf(x(i) * y(j) - y(i) * x(j)));
          const int m = (i + j + 1) % 6;
          ASSERT_EQ(polygon.orientation(i, j, m),
                    signOf((x(j) - x(i)) * (y(m) - y(i)) - (y(j) - y(i)) * (x(m) - x(i))));
          if (spread > 5000) continue;  // more digits than a long double has
          const int n = (m + 1) % 6;
          const long double ax = x(i) - x(n), ay = y(i) - y(n), bx = x(j) - x(n), by = y(j) - y(n),
                            cx = x(m) - x(n), cy = y(m) - y(n);
          ASSERT_EQ(polygon.inCircle(i, j, m, n), signOf((ax * ax + ay * ay) * (bx * cy - by * cx) +
                                                         (bx * bx + by * by) * (cx * ay - cy * ax) +
                                                         (cx * cx + cy * cy) * (ax * by - ay * bx)));
        }
    }
  }
}

}  // namespace
}  // namespace arete
