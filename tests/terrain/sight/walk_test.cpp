// SPDX-License-Identifier: GPL-3.0-or-later
//
// Squares below random legs, against points sampled along them.
#include "terrain/sight/walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "datasets/random.h"

namespace arete::test {
namespace {

struct Visited {
  int column, row;
  double t0, t1;
};

TEST(SightWalk, VisitsTheSquaresBelowALegInOrderWithoutOverlap) {
  constexpr std::uint64_t kSeed = 21;
  Random random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", leg " << i);
    const int columns = 1 + int(random.below(9)), rows = 1 + int(random.below(9));
    const double size = 1 + random.below(3), xMax = columns * size, yMax = rows * size;
    const SightPoint from{{random.between(-3, xMax + 3), random.between(-3, yMax + 3)}, 0};
    const SightPoint to{{random.between(-3, xMax + 3), random.between(-3, yMax + 3)}, 100};
    const SightLeg leg(from, to);
    const SightRange range = rangeOver(leg, xMax, yMax);
    std::vector<Visited> visited;
    if (range.first <= range.last)
      forSquares(leg, range, size, columns, rows, [&](int column, int row, double t0, double t1) {
        visited.push_back({column, row, t0, t1});
        return true;
      });
    double done = range.first;
    std::set<std::pair<int, int>> squares;
    for (const Visited& v : visited) {
      EXPECT_EQ(v.t0, done);
      EXPECT_LE(v.t0, v.t1);
      EXPECT_TRUE(squares.insert({v.column, v.row}).second) << "visited twice";
      done = v.t1;
    }
    if (!visited.empty()) {
      EXPECT_NEAR(done, range.last, 1e-12);  // the border is computed twice
    }
    for (int k = 0; k <= 200; ++k) {
      const double t = k / 200.0, x = from.plan.x + t * (to.plan.x - from.plan.x),
                   y = from.plan.y + t * (to.plan.y - from.plan.y);
      const auto isNear = [](double v) { return std::fabs(v - std::round(v)) < 1e-6; };
      if (isNear(x) || isNear(y)) continue;
      const bool isInside = x > 0 && y > 0 && x < xMax && y < yMax;
      EXPECT_EQ(isInside, t >= range.first && t <= range.last) << t;
      if (isInside) {
        EXPECT_TRUE(squares.count({int(x / size), int(y / size)})) << t;
      }
    }
  }
}

TEST(SightWalk, StopsWhenAVisitReturnsFalse) {
  const SightLeg leg({{0.5, 0.5}, 0}, {{7.5, 0.5}, 70});
  int visits = 0;
  forSquares(leg, {0, 1}, 1, 8, 1, [&](int, int, double, double) { return ++visits < 3; });
  EXPECT_EQ(visits, 3);
}

TEST(SightWalk, ALineOnABorderIsInTheSquareThatItEnters) {
  EXPECT_EQ(squareAt(3, 1, 1, 8), 3);
  EXPECT_EQ(squareAt(3, -1, 1, 8), 2);
  EXPECT_EQ(squareAt(3.5, -1, 1, 8), 3);
  EXPECT_EQ(squareAt(12, 1, 4, 3), 2);
  EXPECT_EQ(squareAt(-1, 1, 4, 3), 0);
}

TEST(SightWalk, PutsALegOntoALatticeLineThatItIsOffByRounding) {
  const SightLeg on({{1, 3 + 1e-12}, 0}, {{9, 3 - 1e-12}, 80}), off({{1, 3}, 0}, {{9, 3 + 1e-6}, 80});
  EXPECT_EQ(on.y, 3);
  EXPECT_EQ(on.dy, 0);
  EXPECT_NE(off.dy, 0);
  EXPECT_EQ(on.distance(0.25), 20);
}

TEST(SightWalk, ReportsTheEndsAndWhatIsOutsideOfTheGrid) {
  const SightGrid grid(11, 3, std::vector<double>(33, 0.0));
  SightTrack track;
  track.points = {{{-5, 1.5}, 0}, {{15, 1.5}, 200}};
  const SightLine line(track, 10, 10);
  SightJudge judge(line, {});
  std::uint64_t cells = 0;
  forLegs(grid, judge,
          [&](const SightLeg& leg, SightRange range) { cells += judgeCells(grid, leg, range, judge); });
  const SightAnswer answer = judge.answer(cells);
  EXPECT_EQ(answer.verdict, SightVerdict::unknown);
  EXPECT_NEAR(answer.gapMetres, 100, 1e-9);
  EXPECT_NEAR(*answer.clearance, 10, 1e-12);
  EXPECT_EQ(cells, 10u);
}

}  // namespace
}  // namespace arete::test
