// SPDX-License-Identifier: GPL-3.0-or-later
//
// Positions of vertices, and the chain of triangles of a descent.
#include "terrain/locate/triangle_locator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

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
      EXPECT_EQ(locator.planPosition(VertexId(v)),
                (Vec2{double(samples[v] % columns), double(samples[v] / columns)}));
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
        for (int k = 0; k < 3; ++k) ASSERT_EQ(VertexId(corners[k]), t->corners[k]);
        for (int k = 0; k < 3; ++k) {
          const Vec2 a = locator.planPosition(t->corners[k]),
                     b = locator.planPosition(t->corners[(k + 1) % 3]);
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
