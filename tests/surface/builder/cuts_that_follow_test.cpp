// SPDX-License-Identifier: GPL-3.0-or-later
//
// Incremental cuts of surfaces (engine/follow/incremental_cut.h). The oracle is the cut from scratch.
#include <gtest/gtest.h>

#include <random>

#include "engine/criteria/space_region.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "engine/follow/incremental_cut.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "surface/laws/validate_surface.h"

namespace arete {
namespace {

NodeSet fromScratch(const MultiTriangulation& mt, const Criterion& criterion) {
  return takeNodes(mt, criterion, {.method = CutMethod::saturated})->nodes;
}

/// A camera that turns around the surface, comes nearer and goes away, at times inside of it.
View viewOf(const SurfaceModel& model, std::mt19937_64& random, int move) {
  std::normal_distribution<double> step(0, 0.03);
  const double turn = 0.3 * move, distance = model.diagonal * (move % 7 == 6 ? 0.05 : 0.4 + 0.1 * (move % 5));
  View view;
  view.eye = {distance * std::cos(turn), distance * std::sin(turn), 0.3 * distance};
  view.forward = -view.eye + model.diagonal * Vec3{step(random), step(random), step(random)};
  view.widthPixels = 320;
  view.heightPixels = 200;
  return view;
}

TEST(CutsThatFollow, OfASurfaceEqualTheCutFromScratchAfterEveryMoveOfTheCamera) {
  const std::uint64_t seed = 31;
  std::mt19937_64 random(seed);
  for (const shapes::NamedMesh& m : shapes::families(seed)) {
    SCOPED_TRACE(m.name);
    const Result<SurfaceModel> model = buildSurface(SurfaceMesh(m.mesh));
    ASSERT_TRUE(model) << model.error().describe();
    const MultiTriangulation& mt = model->mt;
    const Result<SurfaceTopology> topology = SurfaceTopology::of(mt);
    ASSERT_TRUE(topology);
    IncrementalCut cut(mt);
    for (int move = 0; move < 30; ++move) {
      const View view = viewOf(*model, random, move);
      ASSERT_TRUE(view.validate());
      const ViewError criterion({.view = view, .pixels = 0.5 + 0.5 * (move % 4)}, mt.arrays().metric);
      const auto update = cut.update(criterion);
      ASSERT_TRUE(update) << update.error().describe();
      EXPECT_TRUE(update->isComplete);
      ASSERT_EQ(cut.nodes(), fromScratch(mt, criterion)) << "move " << move;
      ASSERT_TRUE(topology->check(cut.front())) << "move " << move;
    }
    EXPECT_TRUE(cut.validate());
  }
}

TEST(CutsThatFollow, OfASurfaceGoFromOneRegionToAnotherAndKeepABudget) {
  const std::uint64_t seed = 32;
  std::mt19937_64 random(seed);
  for (const shapes::NamedMesh& m : shapes::families(seed)) {
    SCOPED_TRACE(m.name);
    const Result<SurfaceModel> model = buildSurface(SurfaceMesh(m.mesh));
    ASSERT_TRUE(model) << model.error().describe();
    const MultiTriangulation& mt = model->mt;
    IncrementalCut cut(mt);
    for (int round = 0; round < 12; ++round) {
      const Vec3 at = mt.position(VertexId(static_cast<std::uint32_t>(random() % mt.vertexCount())));
      const auto ball = std::make_shared<BallRegion>(at, model->diagonal / 8);
      const SpaceRegionError criterion(ball, mt.arrays().metric, 0, model->diagonal / 50);
      ASSERT_TRUE(cut.update(criterion));
      ASSERT_EQ(cut.nodes(), fromScratch(mt, criterion)) << "round " << round;

      const std::uint32_t most = mt.rootTriangleCount() + 10 * static_cast<std::uint32_t>(round);
      const UniformError everywhere(0);
      const auto kept = cut.update(everywhere, {.maxTriangles = most});
      ASSERT_TRUE(kept);
      EXPECT_LE(cut.triangles().size(), most);
      EXPECT_TRUE(cut.validate());
    }
  }
}

}  // namespace
}  // namespace arete
