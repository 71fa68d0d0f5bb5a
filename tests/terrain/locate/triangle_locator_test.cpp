// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of a descent: the sign that decides, the lists of root triangles, the chain of triangles.
#include "terrain/locate/triangle_locator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/build/build.h"
#include "terrain/model/plan_orientation.h"

namespace arete {
namespace {

TEST(PlanOrientation, IsExactWherePointsAreAlmostOnALine) {
  __extension__ using Wide = __int128;
  Random random(3);
  const auto whole = [&](std::int64_t most) {
    return static_cast<std::int64_t>(random.unit() * double(most));
  };
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    // Multiples of 2^-20, all of 50 bits: a and b far apart, c one step or none off a point of their line.
    const std::int64_t ax = whole(1LL << 24), ay = whole(1LL << 24), dx = whole(1LL << 22) + 1,
                       dy = whole(1LL << 22);
    const std::int64_t at = whole(1 << 20);
    const std::int64_t bx = ax + (dx << 20), by = ay + (dy << 20);
    const std::int64_t cx = ax + dx * at + whole(3) - 1, cy = ay + dy * at + whole(3) - 1;
    const Wide turn = Wide(bx - ax) * (cy - ay) - Wide(by - ay) * (cx - ax);
    const int expected = (turn > 0) - (turn < 0);
    const auto point = [](std::int64_t x, std::int64_t y) {
      return Vec2{std::ldexp(double(x), -20), std::ldexp(double(y), -20)};
    };
    const Vec2 a = point(ax, ay), b = point(bx, by), c = point(cx, cy);
    ASSERT_EQ(planOrientation(a, b, c), expected) << i;
    ASSERT_EQ(planOrientation(b, c, a), expected) << i;
    ASSERT_EQ(planOrientation(b, a, c), -expected) << i;
    zeros += expected == 0;
  }
  EXPECT_GT(zeros, 100);
}

TEST(PlanOrientation, SurvivesTheSmallestAndTheLargestNumbers) {
  const double tiny = std::numeric_limits<double>::denorm_min(), large = 1e300;
  EXPECT_EQ(planOrientation({0, 0}, {tiny, 0}, {0, tiny}), 1);
  EXPECT_EQ(planOrientation({0, 0}, {tiny, tiny}, {2 * tiny, 2 * tiny}), 0);
  EXPECT_EQ(planOrientation({0, 0}, {large, 0}, {0, large}), 1);
  EXPECT_EQ(planOrientation({-large, -large}, {large, large}, {0, -large}), -1);
}

/// Distance of a point to a closed triangle, the plain way.
double plainDistance(const std::array<Vec2, 3>& t, Vec2 p) {
  bool isInside = true;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec2 a = t[i], b = t[(i + 1) % 3];
    isInside = isInside && (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0;
    for (int k = 0; k <= 1000; ++k)
      least =
          std::min(least, std::hypot(a.x + (b.x - a.x) * k / 1000 - p.x, a.y + (b.y - a.y) * k / 1000 - p.y));
  }
  return isInside ? 0 : least;
}

TEST(RootGrid, ListsEveryTriangleWithinTheMargin) {
  std::size_t largestRoot = 0;
  for (const RasterFamily& family : rasterFamilies()) {
    const auto model = build(family.make(70, 40, 5));
    ASSERT_TRUE(model) << family.name;
    const MultiTriangulation& mt = model->mt;
    largestRoot = std::max<std::size_t>(largestRoot, mt.rootTriangleCount());
    const double margin = 0.3;
    const RootGrid grid(mt, margin);
    Random random(1);
    for (int i = 0; i < 100; ++i) {
      const Vec2 p = {random.unit() * 72 - 1, random.unit() * 42 - 1};
      const auto listed = grid.near(p);
      EXPECT_TRUE(std::is_sorted(listed.begin(), listed.end()));
      for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) {
        std::array<Vec2, 3> corners;
        for (int k = 0; k < 3; ++k)
          corners[k] = mt.vertices().planPosition(VertexId(mt.arrays().rootTriangles[t][k]));
        if (plainDistance(corners, p) < margin) {
          ASSERT_TRUE(std::binary_search(listed.begin(), listed.end(), t))
              << family.name << " triangle " << t << " at " << p.x << ", " << p.y;
        }
      }
    }
  }
  EXPECT_GT(largestRoot, 100u) << "no family has a root that needs a grid";
}

TEST(RootGrid, StaysSmallWhereTrianglesOverlap) {
  // What no build makes and a hostile file may hold: every triangle covers everything.
  const std::vector<Vec2> plan = {{0, 0}, {100, 0}, {0, 100}};
  const std::vector<std::array<std::uint32_t, 3>> triangles(20000, {0, 1, 2});
  MtArrays arrays;
  arrays.rootTriangles = triangles;
  arrays.vertices.plan = plan;
  const RootGrid grid(MultiTriangulation(arrays, nullptr), 0);
  EXPECT_EQ(grid.near({10, 10}).size(), triangles.size());
  EXPECT_TRUE(grid.near({-10, 10}).empty());
}

TEST(TriangleLocator, FindsTheColumnAndRowOfEverySample) {
  // Few vertices of a raster with as many samples as 32 bits can number: the first and last ones of rows.
  for (const std::uint32_t columns : {1u, 2u, 3u, 7u, 65535u, 65537u, 99991u, 2147483647u, 4294967294u}) {
    std::vector<std::uint32_t> samples;
    const std::uint64_t rows = 4294967295ull / columns;
    for (const std::uint64_t row : {std::uint64_t{0}, rows / 3, rows - 1})
      for (const std::uint64_t column :
           {std::uint64_t{0}, std::uint64_t{columns / 2}, std::uint64_t{columns - 1}})
        samples.push_back(static_cast<std::uint32_t>(row * columns + column));
    MtArrays arrays;
    arrays.vertices.columns = columns;
    arrays.vertices.samples = samples;
    const TriangleLocator locator(MultiTriangulation(arrays, nullptr));
    for (std::uint32_t v = 0; v < samples.size(); ++v)
      EXPECT_EQ(locator.planPosition(v), (Vec2{double(samples[v] % columns), double(samples[v] / columns)}));
  }
}

TEST(TriangleLocator, WalksThroughTrianglesThatEachHoldThePlace) {
  for (const RasterFamily& family : rasterFamilies()) {
    const auto model = build(family.make(50, 45, 9));
    ASSERT_TRUE(model) << family.name;
    const TriangleLocator locator(model->mt);
    Random random(2);
    for (int i = 0; i < 400; ++i) {
      // Quarters: many places on edges and vertices.
      const Vec2 p = {std::floor(random.unit() * 200) / 4, std::floor(random.unit() * 180) / 4};
      NodeId last;
      for (auto t = locator.inRoot(p); t; t = locator.finer(*t, p)) {
        const auto corners = model->mt.corners(t->triangle);
        ASSERT_EQ(corners, t->corners);
        for (int k = 0; k < 3; ++k) {
          const Vec2 a = locator.planPosition(corners[k]), b = locator.planPosition(corners[(k + 1) % 3]);
          ASSERT_GE((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x), 0) << family.name;
        }
        const NodeId creator = model->mt.creator(t->triangle);
        if (last.isValid()) {
          ASSERT_TRUE(creator.isValid());
          ASSERT_GT(creator, last) << "steps go to younger nodes";
        }
        if (creator.isValid()) last = creator;
        if (locator.isFinest(*t)) break;
        ASSERT_TRUE(locator.finer(*t, p)) << family.name << ": lost on the way";
      }
    }
  }
}

}  // namespace
}  // namespace arete
