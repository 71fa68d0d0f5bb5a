// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "datasets/families.h"
#include "engine/cut.h"
#include "terrain/build.h"
#include "terrain/finest_points.h"
#include "terrain/finest_raster.h"
#include "terrain/validate_model.h"

namespace arete {
namespace {

TEST(FinestRaster, SplitsWholeCellsFromUpperLeftToLowerRightAndKeepsHalfCells) {
  RasterHeightfield field;
  field.columns = field.rows = 2;
  const double none = std::nan("");
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  field.heights = {1, 2, 3, 4};
  EXPECT_EQ(finestTriangulation(field), (Triangles{{0, 1, 3}, {0, 3, 2}}));
  field.heights = {none, 2, 3, 4};
  EXPECT_EQ(finestTriangulation(field), (Triangles{{1, 3, 2}}));
  field.heights = {1, none, 3, 4};
  EXPECT_EQ(finestTriangulation(field), (Triangles{{0, 3, 2}}));
  field.heights = {1, 2, none, 4};
  EXPECT_EQ(finestTriangulation(field), (Triangles{{0, 1, 3}}));
  field.heights = {1, 2, 3, none};
  EXPECT_EQ(finestTriangulation(field), (Triangles{{0, 1, 2}}));
  field.heights = {1, none, none, 4};
  EXPECT_TRUE(finestTriangulation(field).empty());
}

TEST(FinestRaster, IsDelaunayUpToCocircularTiesByCgalsPredicates) {
  // The layout is the finest front of a model; validateDelaunayFront asks CGAL about every triangle and edge.
  for (const RasterFamily& family : rasterFamilies()) {
    const auto model = build(family.make(37, 29, 6));
    ASSERT_TRUE(model) << family.name;
    const Cut finest = frontOfPrefix(model->mt, model->mt.nodeCount());
    const Status status = validateDelaunayFront(*model, finest);
    EXPECT_TRUE(status) << family.name << ": " << status.error().message;
    EXPECT_EQ(finest.triangles.size(), finestTriangulation(family.make(37, 29, 6)).size());
  }
}

TEST(FinestPoints, HasTheTrianglesOfTheEulerRelation) {
  for (const PointFamily& family : pointFamilies()) {
    const PointHeightfield field = family.make(500, 8);
    const auto triangles = finestTriangulation(field, 1);
    ASSERT_TRUE(triangles) << family.name;
    // Counter-clockwise everywhere, and no vertex left out but exact repeats.
    std::vector<char> seen(field.size(), 0);
    for (const auto& t : *triangles)
      for (const std::uint32_t v : t) seen[v] = 1;
    std::size_t used = 0;
    for (const char s : seen) used += s;
    EXPECT_LE(triangles->size(), 2 * used);
    EXPECT_GE(used, 3u) << family.name;
  }
}

}  // namespace
}  // namespace arete
