// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/simplify/simplify.h"

#include <gtest/gtest.h>

#include <atomic>

#include "engine/ids_of.h"
#include "terrain/simplify_fixture.h"

namespace arete {
namespace {

TEST(Simplifier, RemovesAllButTheFixedVerticesInAnyNumberOfTiles) {
  for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent})
    for (const std::uint32_t vertices : {8192u, 40u}) {
      SmallSimplification small(25, 19, 1, shape);
      auto isFixed = small.isFixed();
      isFixed[VertexId(100)] = isFixed[VertexId(230)] = 1;  // on the border, and inside
      const RunContext context;
      const TileOptions tiles{.most = vertices, .least = vertices, .fewest = 2, .span = 1.5};
      const auto root = Simplifier(small.state, tiles, context).run(isFixed);
      ASSERT_TRUE(root);
      EXPECT_EQ(root->vertices, test::idsOf<VertexId>({0, 24, 100, 230, 450, 474}));
      EXPECT_EQ(root->triangles.size(), 2u + 1 + 2) << "one more on the border, two more inside";
      EXPECT_GT(root->levels, 10u);
      EXPECT_TRUE(small.isWhole());
      EXPECT_TRUE(small.state.thresholds.empty());
    }
}

TEST(Simplifier, StopsWhenItIsCancelled) {
  SmallSimplification small(25, 19, 1, HoleShape::delaunay);
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const auto root =
      Simplifier(small.state, TileOptions::of(HoleShape::delaunay), context).run(small.isFixed());
  ASSERT_FALSE(root);
  EXPECT_EQ(root.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete
