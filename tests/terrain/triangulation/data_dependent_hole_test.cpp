// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/triangulation/data_dependent_hole.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "terrain/error/raster_error.h"
#include "terrain/triangulation/lattice_plan.h"

namespace arete {
namespace {

constexpr int kFieldColumns = 41, kMiddle = 20;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Place {
  int x, y;
};

VertexId vertexAt(const Place& place) {
  return VertexId(std::uint32_t(place.y * kFieldColumns + place.x));
}

/// A polygon that is star-shaped about the middle of a raster, convex or not, with random heights.
struct RoughHole {
  std::vector<double> heights;
  std::vector<Place> places;  // of the corners
  Star star;
  VertexId apex = vertexAt({kMiddle, kMiddle});
};

std::int64_t turn(const Place& a, const Place& b, const Place& c) {
  return std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(b.y - a.y) * (c.x - a.x);
}

RoughHole someHole(std::mt19937_64& random, int reach, int wanted) {
  RoughHole hole;
  hole.heights.resize(std::size_t(kFieldColumns) * kFieldColumns);
  const unsigned range = random() % 3 == 0 ? 3 : 1000;  // few heights make many ties
  for (double& z : hole.heights) z = double(random() % range);
  const Place middle{kMiddle, kMiddle};
  for (;;) {
    std::vector<Place> around;
    for (int i = 0; i < wanted; ++i)
      around.push_back({kMiddle - reach + int(random() % unsigned(2 * reach + 1)),
                        kMiddle - reach + int(random() % unsigned(2 * reach + 1))});
    const auto angle = [](const Place& p) { return std::atan2(p.y - kMiddle, p.x - kMiddle); };
    std::sort(around.begin(), around.end(),
              [&](const Place& a, const Place& b) { return angle(a) < angle(b); });
    bool isStar = true;
    for (std::size_t i = 0; i < around.size(); ++i)
      isStar = isStar && turn(middle, around[i], around[(i + 1) % around.size()]) > 0;
    if (!isStar) continue;
    hole.places = around;
    hole.star.linkSize = hole.star.triangleCount = wanted;
    std::ranges::transform(around, hole.star.link.begin(), vertexAt);
    return hole;
  }
}

/// Every sample of the raster against one triangle.
double errorOf(const RoughHole& hole, int i, int j, int m) {
  const Place &a = hole.places[std::size_t(i)], &b = hole.places[std::size_t(j)],
              &c = hole.places[std::size_t(m)];
  const auto height = [&](const Place& p) { return hole.heights[std::size_t(p.y * kFieldColumns + p.x)]; };
  const double area = double(turn(a, b, c));
  double worst = 0;
  for (int y = 0; y < kFieldColumns; ++y)
    for (int x = 0; x < kFieldColumns; ++x) {
      const Place p{x, y};
      const auto atC = turn(a, b, p), atA = turn(b, c, p), atB = turn(c, a, p);
      if (atA < 0 || atB < 0 || atC < 0) continue;
      const double z = (double(atA) * height(a) + double(atB) * height(b) + double(atC) * height(c)) / area;
      worst = std::max(worst, std::abs(z - height(p)));
    }
  return worst;
}

double squaredDistance(const RoughHole& hole, int i, int j) {
  const Place &p = hole.places[std::size_t(i)], &q = hole.places[std::size_t(j)];
  return double((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y));
}

double aspectOf(const RoughHole& hole, int i, int j, int m) {
  return double(turn(hole.places[std::size_t(i)], hole.places[std::size_t(j)], hole.places[std::size_t(m)])) /
         std::max({squaredDistance(hole, i, j), squaredDistance(hole, j, m), squaredDistance(hole, m, i)});
}

/// The least largest error of all triangulations, one after the other: the edge j - i takes each corner
/// between. No bound, nothing kept.
double leastOfAll(const RoughHole& hole, int i, int j, double minimumAspect) {
  if (j - i < 2) return 0;
  double least = kInfinity;
  for (int m = i + 1; m < j; ++m) {
    if (!(aspectOf(hole, i, m, j) > 0) || aspectOf(hole, i, m, j) < minimumAspect) continue;
    least = std::min(least, std::max({errorOf(hole, i, m, j), leastOfAll(hole, i, m, minimumAspect),
                                      leastOfAll(hole, m, j, minimumAspect)}));
  }
  return least;
}

TEST(DataDependentHole, CostsTheLeastOfAllTriangulations) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const int corners = 3 + int(random() % 6);
    const RoughHole some = someHole(random, 3 + int(random() % 6), corners);
    const double minimumAspect = random() % 2 ? 0.02 : 0.2;
    const LatticePlan plan(kFieldColumns, 1, 1);
    const RasterError errors(plan, some.heights, false);
    const RasterError::Hole hole(errors, some.star, some.apex);
    const double least = leastOfAll(some, 0, corners - 1, minimumAspect);

    DataDependentSearch search(corners, hole, minimumAspect);
    const HoleCost cost = search.cost(1e9, 1e9);
    const auto errorIn = [&](int i, int m, int j) { return hole.maximum(i, m, j, 1e9); };
    EXPECT_EQ(cost.isExact, least < kInfinity);
    if (least == kInfinity) {
      EXPECT_EQ(cost.error, kInfinity);
      EXPECT_EQ(search.shortest(1e9, errorIn).size, 0);
      continue;
    }
    EXPECT_NEAR(cost.error, least, 1e-9);
    EXPECT_EQ(search.shortest(cost.error - 1e-9, errorIn).size, 0);
    const HoleTriangulation floor = search.shortest(cost.error + 1e-9, errorIn);
    ASSERT_EQ(floor.size, corners - 2);
    std::int64_t area = 0, whole = 0;
    double worst = 0;
    for (const auto& t : floor.view()) {
      EXPECT_LT(t[0], t[1]);
      EXPECT_LT(t[1], t[2]);
      EXPECT_GE(aspectOf(some, t[0], t[1], t[2]), minimumAspect * (1 - 1e-12));
      area += turn(some.places[t[0]], some.places[t[1]], some.places[t[2]]);
      worst = std::max(worst, errorOf(some, t[0], t[1], t[2]));
    }
    for (int i = 0; i < corners; ++i)
      whole +=
          turn({kMiddle, kMiddle}, some.places[std::size_t(i)], some.places[std::size_t((i + 1) % corners)]);
    EXPECT_EQ(area, whole);
    EXPECT_NEAR(worst, least, 1e-9);
  }
}

TEST(DataDependentHole, FindsNothingBeyondALimitButABoundFromBelow) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const int corners = 3 + int(random() % 6);
    const RoughHole some = someHole(random, 3 + int(random() % 6), corners);
    const LatticePlan plan(kFieldColumns, 1, 1);
    const RasterError errors(plan, some.heights, false);
    const RasterError::Hole hole(errors, some.star, some.apex);
    const double least = leastOfAll(some, 0, corners - 1, 0.02);
    for (const double part : {0.1, 0.5, 0.9, 0.999, 1.001, 1.2}) {
      const double threshold = std::min(least, 1e6) * part;
      DataDependentSearch search(corners, hole, 0.02);
      const HoleCost cost = search.cost(threshold, threshold * 1.1);
      if (threshold >= least) {
        EXPECT_TRUE(cost.isExact);
      }
      if (cost.isExact) {
        EXPECT_NEAR(cost.error, least, 1e-9);
      } else if (least > 0) {
        EXPECT_GT(cost.error, threshold);
        EXPECT_LE(cost.error, least * (1 + 1e-9));
      }
    }
  }
}

/// The least sum of squared diagonals, j - i among them, of all triangulations within the limit.
double shortestOfAll(const RoughHole& hole, int i, int j, double minimumAspect, double limit) {
  if (j - i < 2) return 0;
  double least = kInfinity;
  for (int m = i + 1; m < j; ++m) {
    if (!(aspectOf(hole, i, m, j) > 0) || aspectOf(hole, i, m, j) < minimumAspect) continue;
    if (errorOf(hole, i, m, j) > limit) continue;
    least = std::min(least, shortestOfAll(hole, i, m, minimumAspect, limit) +
                                shortestOfAll(hole, m, j, minimumAspect, limit));
  }
  return least + squaredDistance(hole, i, j);
}

TEST(DataDependentHole, TakesTheShortestDiagonalsThatKeepTheLimit) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const int corners = 3 + int(random() % 7);
    const RoughHole some = someHole(random, 3 + int(random() % 6), corners);
    const LatticePlan plan(kFieldColumns, 1, 1);
    const RasterError errors(plan, some.heights, false);
    const RasterError::Hole hole(errors, some.star, some.apex);
    const double least = leastOfAll(some, 0, corners - 1, 0.02);
    if (least == kInfinity) continue;
    for (const double more : {1.0, 1.05, 1.5, 100.0}) {
      const double limit = least * more + 1e-6;
      std::array<std::array<int, 9>, 9> asked{};  // by the least and the greatest corner: the one between
      const HoleTriangulation floor =
          DataDependentSearch(corners, hole, 0.02).shortest(limit, [&](int i, int m, int j) {
            asked[std::size_t(i)][std::size_t(j)] = m;
            return hole.maximum(i, m, j, limit);
          });
      ASSERT_EQ(floor.size, corners - 2);
      double sum = 0;
      for (const auto& [i, m, j] : floor.view()) {
        EXPECT_LE(errorOf(some, i, m, j), limit);
        EXPECT_EQ(asked[i][j], m);
        sum += squaredDistance(some, i, j);
      }
      EXPECT_NEAR(sum, shortestOfAll(some, 0, corners - 1, 0.02, limit), 1e-9);
    }
  }
}

}  // namespace
}  // namespace arete
