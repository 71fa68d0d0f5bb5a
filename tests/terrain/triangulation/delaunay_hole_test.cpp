// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/triangulation/delaunay_hole.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>
#include <set>

#include "engine/ids_of.h"
#include "terrain/error/raster_error.h"
#include "terrain/triangulation/lattice_plan.h"

namespace arete {
namespace {

constexpr std::uint32_t kColumns = 64, kRows = 64;

VertexId vertexAt(int column, int row) {
  return VertexId(static_cast<std::uint32_t>(row * int(kColumns) + column));
}

/// A star polygon on a lattice about the middle of a raster, convex or not, with random heights.
struct SomeHole {
  std::vector<double> heights;
  Star star;
  VertexId apex = vertexAt(32, 32);
};

SomeHole someHole(std::mt19937_64& random, int reach) {
  SomeHole hole;
  hole.heights.resize(std::size_t(kColumns) * kRows);
  for (double& z : hole.heights) z = static_cast<double>(random() % 100);
  // The vertices of a convex polygon: the hull of random lattice points around the apex.
  std::vector<std::array<int, 2>> points;
  const int count = 5 + static_cast<int>(random() % 8);
  const auto coordinate = [&] {
    return static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach;
  };
  for (int i = 0; i < count; ++i) points.push_back({coordinate(), coordinate()});
  for (const auto& p : {std::array{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}})
    points.push_back(p);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<std::array<int, 2>> hull;
  const auto half = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= start + 2) {
        const auto &a = hull[hull.size() - 2], &b = hull.back();
        if ((b[0] - a[0]) * ((*p)[1] - a[1]) - (b[1] - a[1]) * ((*p)[0] - a[0]) > 0) break;
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  half(points.begin(), points.end());
  half(points.rbegin(), points.rend());
  hole.star.linkSize = hole.star.triangleCount = static_cast<int>(hull.size());
  for (std::size_t i = 0; i < hull.size(); ++i)
    hole.star.link[i] = vertexAt(32 + hull[i][0], 32 + hull[i][1]);
  return hole;
}

Star starOf(std::initializer_list<std::uint32_t> link) {
  Star star;
  star.linkSize = star.triangleCount = static_cast<int>(link.size());
  std::ranges::copy(test::idsOf<VertexId>(link), star.link.begin());
  return star;
}

double signedArea(const LatticePlan& plan, const Star& star, const std::array<std::uint8_t, 3>& t) {
  const Vec2 a = plan.planPosition(star.link[t[0]]), b = plan.planPosition(star.link[t[1]]),
             c = plan.planPosition(star.link[t[2]]);
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

TEST(HoleTriangulation, BothWaysTileTheHoleWithDelaunayTriangles) {
  std::mt19937_64 random(20261121);
  for (int run = 0; run < 3000; ++run) {
    const SomeHole some = someHole(random, 1 + run % 12);
    const LatticePlan plan(kColumns, 1 + run % 3, 1 + run % 2);
    const RasterError errors(plan, some.heights, false);
    const RasterError::Hole hole(errors, some.star, some.apex);
    const auto polygon = hole.polygon();
    double whole = 0;
    for (int i = 1; i + 1 < some.star.linkSize; ++i)
      whole +=
          signedArea(plan, some.star, {0, static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i + 1)});
    for (const bool isUnconstrained : {true, false}) {
      const HoleTriangulation result = triangulateHoleDelaunay(some.star.linkSize, hole, isUnconstrained);
      ASSERT_EQ(result.size, some.star.linkSize - 2) << "run " << run;
      double sum = 0;
      for (const auto& t : result.view()) {
        EXPECT_TRUE(t[0] < t[1] && t[0] < t[2]) << "run " << run;
        const double area = signedArea(plan, some.star, t);
        EXPECT_GT(area, 0) << "run " << run;
        sum += area;
        for (int n = 0; n < some.star.linkSize; ++n) {
          if (n == t[0] || n == t[1] || n == t[2]) continue;
          EXPECT_LE(polygon.inCircle(t[0], t[1], t[2], n), 0) << "run " << run;
        }
      }
      EXPECT_EQ(sum, whole) << "run " << run;
    }
  }
}

TEST(HoleTriangulation, OfAnyStarPolygonIsConstrainedDelaunay) {
  std::mt19937_64 random(20261123);
  int unlikeWrapped = 0, tried = 0;
  for (int run = 0; run < 6000; ++run) {
    // Corners around the apex by their directions, near and far by turns: far from convex.
    SomeHole some = someHole(random, 1);
    std::vector<std::array<int, 2>> corners;
    for (int k = 0; k < 12; ++k) {
      const int reach = k % 2 == 0 ? 3 : 14;
      const auto coordinate = [&] {
        return static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach;
      };
      corners.push_back({coordinate(), coordinate()});
    }
    const auto angle = [](const std::array<int, 2>& p) { return std::atan2(p[1], p[0]); };
    std::erase_if(corners, [](const auto& p) { return p[0] == 0 && p[1] == 0; });
    std::sort(corners.begin(), corners.end(),
              [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
    corners.erase(
        std::unique(corners.begin(), corners.end(),
                    [&](const auto& a, const auto& b) { return std::abs(angle(a) - angle(b)) < 1e-9; }),
        corners.end());
    bool isAround = corners.size() >= 3;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
      isAround = isAround && a[0] * b[1] - a[1] * b[0] > 0;
    }
    if (!isAround) continue;
    ++tried;
    some.star.linkSize = some.star.triangleCount = static_cast<int>(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
      some.star.link[i] = vertexAt(32 + corners[i][0], 32 + corners[i][1]);
    const LatticePlan plan(kColumns, 1 + run % 3, 1 + run % 2);
    const RasterError errors(plan, some.heights, false);
    const RasterError::Hole hole(errors, some.star, some.apex);
    const auto polygon = hole.polygon();
    const HoleTriangulation result = triangulateHoleDelaunay(some.star.linkSize, hole, false);
    ASSERT_EQ(result.size, some.star.linkSize - 2) << "run " << run;
    const HoleTriangulation wrapped = wrapHole(some.star.linkSize, hole);
    unlikeWrapped += wrapped.size == 0 || !isLocallyDelaunay(wrapped, polygon) ? 1 : 0;
    for (const auto& t : result.view()) {
      EXPECT_GT(signedArea(plan, some.star, t), 0) << "run " << run;
      for (const auto& other : result.view()) {  // across a shared edge
        int shared = 0, opposite = -1;
        for (const std::uint8_t c : other)
          if (c == t[0] || c == t[1] || c == t[2])
            ++shared;
          else
            opposite = c;
        if (shared == 2) {
          EXPECT_LE(polygon.inCircle(t[0], t[1], t[2], opposite), 0) << "run " << run;
        }
      }
    }
  }
  EXPECT_GT(tried, 500);
  EXPECT_GT(unlikeWrapped, 50) << "both ways are meant to be tried";
}

TEST(HoleTriangulation, FromTheApexIsTheSameAndBeginsOverTheApex) {
  std::mt19937_64 random(20261122);
  for (int run = 0; run < 3000; ++run) {
    const SomeHole some = someHole(random, 1 + run % 12);
    const LatticePlan plan(kColumns, 1 + run % 3, 1 + run % 2);
    const RasterError errors(plan, some.heights, false);
    const RasterError::Hole hole(errors, some.star, some.apex);
    std::set<std::array<std::uint8_t, 3>> expected, found;
    const HoleTriangulation wrapped = wrapHole(some.star.linkSize, hole);
    for (const auto& t : wrapped.view()) expected.insert(t);
    const bool isWhole =
        wrapHoleFromApex(some.star.linkSize, hole, [&](int i, int j, int m, bool isOverApex) {
          EXPECT_EQ(isOverApex, found.empty()) << "run " << run;
          for (const auto& [a, b] : {std::array{i, j}, std::array{j, m}, std::array{m, i}})
            EXPECT_TRUE(!isOverApex || hole.polygon().orientationToApex(a, b) >= 0) << "run " << run;
          found.insert(
              {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), static_cast<std::uint8_t>(m)});
          return true;
        });
    EXPECT_TRUE(isWhole) << "run " << run;
    EXPECT_EQ(found, expected) << "run " << run;
  }
}

TEST(HoleTriangulation, OfAnUntouchedSampleCostsWhatTheRuleSays) {
  std::mt19937_64 random(11);
  for (int run = 0; run < 3000; ++run) {
    constexpr std::uint32_t kWidth = 3;
    std::vector<double> heights(9);
    for (double& z : heights) z = static_cast<double>(random() % 64) / 4;
    const LatticePlan plan(kWidth, 1 + run % 4, 1 + (run / 4) % 4);
    const RasterError errors(plan, heights, false);
    // The link of the middle sample, whose cells' diagonals run from the upper left to the lower right.
    const VertexId middle(4);
    const Star star = starOf({1, 5, 8, 7, 3, 0});
    const RasterError::Hole hole(errors, star, middle);
    double worst = 0;
    const HoleTriangulation filled = triangulateHoleDelaunay(6, hole, true);
    for (const auto& t : filled.view()) worst = std::max(worst, hole.maximum(t[0], t[1], t[2], 1e9));
    std::array<VertexId, 3> witness;
    EXPECT_NEAR(errors.costInFinest(middle, witness), worst, 1e-12) << "run " << run;
    for (const VertexId border : test::idsOf<VertexId>({0, 1, 2, 3, 5, 6, 7, 8}))
      EXPECT_EQ(errors.costInFinest(border, witness), -1);
    heights[star.link[random() % 6].index()] = std::nan("");
    EXPECT_EQ(errors.costInFinest(middle, witness), -1) << "beside NODATA";
  }
}

TEST(HoleTriangulation, OfASquareTakesTheDiagonalCloserToTheApex) {
  std::vector<double> heights(9, 0);
  const LatticePlan plan(3, 1, 1);
  const Star star = starOf({0, 2, 8, 6});
  heights[0] = heights[8] = 10;  // the apex, 4, lies at 0 and so does the diagonal from 2 to 6
  const RasterError errors(plan, heights, false);
  const RasterError::Hole hole(errors, star, VertexId(4));
  for (const bool isUnconstrained : {true, false}) {
    const HoleTriangulation result = triangulateHoleDelaunay(4, hole, isUnconstrained);
    double worst = 0;
    for (const auto& t : result.view()) worst = std::max(worst, hole.maximum(t[0], t[1], t[2], 1e9));
    EXPECT_LE(worst, 5) << "the middle of an edge of the square";
    for (const auto& t : result.view())
      EXPECT_TRUE(std::count(t.begin(), t.end(), 1) == 1 && std::count(t.begin(), t.end(), 3) == 1);
  }
}

TEST(HoleTriangulation, MeasuresATriangleAsALookAtEverySampleDoes) {
  std::mt19937_64 random(7);
  for (int run = 0; run < 4000; ++run) {
    std::vector<double> heights(std::size_t(kColumns) * kRows);
    for (double& z : heights)
      z = random() % 50 == 0 ? std::nan("") : static_cast<double>(random() % 1000) / 8;
    const int reach = 2 + run % 9;
    std::array<std::array<int, 2>, 3> c;
    for (auto& p : c)
      for (int& x : p) x = 20 + static_cast<int>(random() % static_cast<unsigned>(reach));
    const int area = (c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[1][1] - c[0][1]) * (c[2][0] - c[0][0]);
    if (area <= 0) continue;
    Star star;
    star.linkSize = star.triangleCount = 3;
    for (std::size_t i = 0; i < 3; ++i) {
      star.link[i] = vertexAt(c[i][0], c[i][1]);
      double& height = heights[star.link[i].index()];
      if (std::isnan(height)) height = 1;
    }
    double above = 0, below = 0;
    for (int y = 0; y < int(kRows); ++y)
      for (int x = 0; x < int(kColumns); ++x) {
        std::array<double, 3> weight;
        for (std::size_t i = 0; i < 3; ++i) {
          const auto &a = c[(i + 1) % 3], &b = c[(i + 2) % 3];
          weight[i] = double((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
        }
        const double z = heights[std::size_t(y) * kColumns + std::size_t(x)];
        if (std::min({weight[0], weight[1], weight[2]}) < 0 || std::isnan(z)) continue;
        double plane = 0;
        for (std::size_t i = 0; i < 3; ++i) plane += weight[i] * heights[star.link[i].index()];
        above = std::max(above, plane - z);
        below = std::max(below, z - plane);
      }
    const LatticePlan plan(kColumns, 1, 1);
    const RasterError errors(plan, heights, false);
    const RasterError::Hole hole(errors, star, star.link[0]);
    SignedBound bound;
    EXPECT_NEAR(hole.maximum(0, 1, 2, 1e9, bound), std::max(above, below), 1e-9) << "run " << run;
    EXPECT_NEAR(bound.above, above, 1e-9) << "run " << run;
    EXPECT_NEAR(bound.below, below, 1e-9) << "run " << run;
    EXPECT_NEAR(hole.maximum(0, 1, 2, 1e9), std::max(above, below), 1e-9) << "run " << run;
    const double limit = std::max(above, below) / 2;
    if (limit > 0) {
      EXPECT_GT(hole.maximum(0, 1, 2, limit), limit) << "run " << run;
    }
  }
}

}  // namespace
}  // namespace arete
