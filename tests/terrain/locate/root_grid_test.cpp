// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lists of root triangles against the distance of every triangle.
#include "terrain/locate/root_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

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
          ASSERT_TRUE(std::binary_search(listed.begin(), listed.end(), TriangleId(t)))
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

TEST(RootGrid, ListsEveryTriangleNearASegmentOnce) {
  for (const RasterFamily& family : rasterFamilies()) {
    const auto model = build(family.make(50, 40, 6));
    ASSERT_TRUE(model) << family.name;
    const double margin = 0.1;
    const RootGrid grid(model->mt, margin);
    Random random(2);
    std::vector<TriangleId> listed;
    for (int i = 0; i < 40; ++i) {
      const Vec2 from{random.between(-3, 53), random.between(-3, 43)},
          to{random.between(-3, 53), random.between(-3, 43)};
      grid.along(from, to, listed);
      EXPECT_TRUE(std::ranges::adjacent_find(listed, std::ranges::greater_equal()) == listed.end());
      for (int k = 0; k <= 20; ++k) {
        const Vec2 p{from.x + (to.x - from.x) * k / 20, from.y + (to.y - from.y) * k / 20};
        for (const TriangleId t : grid.near(p)) {
          std::array<Vec2, 3> corners;
          for (int c = 0; c < 3; ++c)
            corners[c] =
                model->mt.vertices().planPosition(VertexId(model->mt.arrays().rootTriangles[t.index()][c]));
          if (plainDistance(corners, p) < margin) {
            ASSERT_TRUE(std::ranges::binary_search(listed, t)) << family.name << ", segment " << i;
          }
        }
      }
    }
    grid.along({std::nan(""), 0}, {1, 1}, listed);
    EXPECT_TRUE(listed.empty());
  }
}

}  // namespace
}  // namespace arete
