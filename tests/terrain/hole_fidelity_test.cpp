// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/hole_fidelity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "terrain/hole_code.h"
#include "terrain/lattice_plan.h"
#include "terrain/raster_error.h"

namespace arete {
namespace {

constexpr int kColumns = 41, kMiddle = 20;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Place {
  int x, y;
};

/// A polygon that is star-shaped about the middle of a raster, convex or not, with random heights.
struct SomeHole {
  std::vector<double> heights;
  std::vector<Place> places;  // of the corners
  Star star;
  std::uint32_t apex = kMiddle * kColumns + kMiddle;
};

std::int64_t turn(const Place& a, const Place& b, const Place& c) {
  return std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(b.y - a.y) * (c.x - a.x);
}

SomeHole someHole(std::mt19937_64& random, int reach, int wanted) {
  SomeHole hole;
  hole.heights.resize(std::size_t(kColumns) * kColumns);
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
    for (int i = 0; i < wanted; ++i)
      hole.star.link[std::size_t(i)] =
          std::uint32_t(around[std::size_t(i)].y * kColumns + around[std::size_t(i)].x);
    return hole;
  }
}

/// Every sample of the raster against one triangle.
double errorOf(const SomeHole& hole, int i, int j, int m) {
  const Place &a = hole.places[std::size_t(i)], &b = hole.places[std::size_t(j)],
              &c = hole.places[std::size_t(m)];
  const auto height = [&](const Place& p) { return hole.heights[std::size_t(p.y * kColumns + p.x)]; };
  const double area = double(turn(a, b, c));
  double worst = 0;
  for (int y = 0; y < kColumns; ++y)
    for (int x = 0; x < kColumns; ++x) {
      const Place p{x, y};
      const auto atC = turn(a, b, p), atA = turn(b, c, p), atB = turn(c, a, p);
      if (atA < 0 || atB < 0 || atC < 0) continue;
      const double z = (double(atA) * height(a) + double(atB) * height(b) + double(atC) * height(c)) / area;
      worst = std::max(worst, std::abs(z - height(p)));
    }
  return worst;
}

double aspectOf(const SomeHole& hole, int i, int j, int m) {
  const auto squared = [&](int u, int v) {
    const Place &p = hole.places[std::size_t(u)], &q = hole.places[std::size_t(v)];
    return double((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y));
  };
  return double(turn(hole.places[std::size_t(i)], hole.places[std::size_t(j)], hole.places[std::size_t(m)])) /
         std::max({squared(i, j), squared(j, m), squared(m, i)});
}

/// The least largest error of all triangulations, one after the other: the edge j - i takes each corner
/// between. No bound, nothing kept.
double leastOfAll(const SomeHole& hole, int i, int j, double minimumAspect) {
  if (j - i < 2) return 0;
  double least = kInfinity;
  for (int m = i + 1; m < j; ++m) {
    if (!(aspectOf(hole, i, m, j) > 0) || aspectOf(hole, i, m, j) < minimumAspect) continue;
    least = std::min(least, std::max({errorOf(hole, i, m, j), leastOfAll(hole, i, m, minimumAspect),
                                      leastOfAll(hole, m, j, minimumAspect)}));
  }
  return least;
}

TEST(HoleFidelity, CostsTheLeastOfAllTriangulations) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const int corners = 3 + int(random() % 6);
    const SomeHole some = someHole(random, 3 + int(random() % 6), corners);
    const double minimumAspect = random() % 2 ? 0.02 : 0.2;
    const LatticePlan plan(kColumns, 1, 1);
    const RasterError errors(plan, some.heights, false);
    const RasterError::Hole hole(errors, some.star, some.apex);
    const double least = leastOfAll(some, 0, corners - 1, minimumAspect);

    FidelitySearch search(corners, hole, minimumAspect);
    double cost = 0;
    const HoleTriangulation floor = search.run(1e9, 1e9, cost);
    if (least == kInfinity) {
      EXPECT_EQ(floor.size, 0);
      EXPECT_EQ(cost, kInfinity);
      continue;
    }
    ASSERT_EQ(floor.size, corners - 2);
    EXPECT_NEAR(cost, least, 1e-9);
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

TEST(HoleFidelity, FindsNothingBeyondALimitButABoundFromBelow) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const int corners = 3 + int(random() % 6);
    const SomeHole some = someHole(random, 3 + int(random() % 6), corners);
    const LatticePlan plan(kColumns, 1, 1);
    const RasterError errors(plan, some.heights, false);
    const RasterError::Hole hole(errors, some.star, some.apex);
    const double least = leastOfAll(some, 0, corners - 1, 0.02);
    for (const double part : {0.1, 0.5, 0.9, 0.999, 1.001, 1.2}) {
      const double threshold = std::min(least, 1e6) * part;
      FidelitySearch search(corners, hole, 0.02);
      double cost = 0;
      const HoleTriangulation floor = search.run(threshold, threshold * 1.1, cost);
      if (threshold >= least) {
        EXPECT_GT(floor.size, 0);
      }
      if (floor.size > 0) {
        EXPECT_NEAR(cost, least, 1e-9);
      } else if (least > 0) {
        EXPECT_GT(cost, threshold);
        EXPECT_LE(cost, least * (1 + 1e-9));
      }
    }
  }
}

TEST(HoleCode, GivesBackEveryTriangulation) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const int corners = 3 + int(random() % unsigned(HoleCode::kMostCorners - 2));
    HoleTriangulation floor;
    std::vector<std::array<int, 2>> edges{{0, corners - 1}};
    while (!edges.empty()) {
      const auto [i, j] = edges.back();
      edges.pop_back();
      if (j - i < 2) continue;
      const int m = i + 1 + int(random() % unsigned(j - i - 1));
      floor.triangles[std::size_t(floor.size++)] = {std::uint8_t(i), std::uint8_t(m), std::uint8_t(j)};
      edges.push_back({i, m});
      edges.push_back({m, j});
    }
    const HoleTriangulation again = HoleCode::decode(HoleCode::encode(floor, corners), corners);
    ASSERT_EQ(again.size, floor.size);
    std::vector<std::array<std::uint8_t, 3>> a(floor.view().begin(), floor.view().end()),
        b(again.view().begin(), again.view().end());
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    EXPECT_EQ(a, b);
  }
}

}  // namespace
}  // namespace arete
