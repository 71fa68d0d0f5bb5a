// SPDX-License-Identifier: GPL-3.0-or-later
// The GPU's cut against the engine's, node for node.
#include "viewer/gl/compute_front.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "datasets/families.h"
#include "datasets/random.h"
#include "datasets/terrain_generator.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "terrain/builder/build.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/gl_mountains.h"

namespace arete {
namespace {

using test::anyCamera;
using test::DrawnMesh;
using test::modelOf;
using test::mountains;

std::vector<bool> nodesOf(const std::vector<std::uint32_t>& words, std::uint32_t count) {
  std::vector<bool> in(count);
  for (std::uint32_t n = 0; n < count; ++n) in[n] = (words[n / 32] >> (n % 32) & 1) != 0;
  return in;
}

TEST(ComputeFront, TheDevicesCutIsTheProcessorsNodeForNode) {
  ARETE_NEEDS_OPENGL(context);
  int compared = 0;
  for (const RasterFamily& family : rasterFamilies()) {
    const std::uint64_t seed = 11;
    const TerrainModel model = modelOf(family.make(61, 47, seed));
    Result<TerrainDrawable> view = TerrainDrawable::create(model, {.mostTriangles = 20000});
    ASSERT_TRUE(view) << view.error().describe();
    ASSERT_EQ(view->deviceRefusal(), "");
    Random random(seed);
    for (int i = 0; i < 8; ++i) {
      SCOPED_TRACE(std::string(family.name) + ", seed 11, camera " + std::to_string(i));
      const Camera camera = anyCamera(random, model);
      ViewSettings settings;
      settings.pixels = std::pow(2.0, random.between(-3, 6));
      settings.isGeomorphed = i % 2 == 0;
      const auto figures = view->cut(camera, settings);
      ASSERT_TRUE(figures);
      const auto frame = view->frameOf(camera, settings);
      const ViewError criterion({.view = frame->view, .pixels = frame->pixels}, model.mt.arrays().metric);
      const auto nodes = takeNodes(model.mt, criterion, {.method = CutMethod::saturated});
      ASSERT_TRUE(nodes);
      const auto members = nodesOf(view->computeFront()->members(), model.mt.nodeCount());
      for (std::uint32_t n = 0; n < model.mt.nodeCount(); ++n)
        ASSERT_EQ(members[n], nodes->nodes[n] != 0) << "node " << n;
      const DrawnMesh mesh = test::readDrawn(*view);
      EXPECT_EQ(mesh.triangles.size(), front(model.mt, nodes->nodes).triangles.size());
      EXPECT_EQ(figures->triangles, mesh.triangles.size());
      EXPECT_EQ(test::whyNotConforming(mesh), "");
      ++compared;
    }
  }
  EXPECT_GT(compared, 50);
}

TEST(ComputeFront, ACutThatHasNoRoomLeavesTheLastFrontWhole) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {.mostTriangles = 3000});
  ASSERT_TRUE(view);
  Random random(5);
  const Camera camera = anyCamera(random, model);
  ViewSettings settings;
  settings.pixels = 20;
  auto figures = view->cut(camera, settings);
  ASSERT_TRUE(figures);
  ASSERT_TRUE(figures->isComplete);
  const DrawnMesh before = test::readDrawn(*view);
  settings.pixels = 0.01;
  figures = view->cut(camera, settings);
  ASSERT_TRUE(figures);
  EXPECT_FALSE(figures->isComplete);
  EXPECT_GT(figures->asked, 3000u);
  const DrawnMesh after = test::readDrawn(*view);
  EXPECT_EQ(after.triangles, before.triangles);
  EXPECT_EQ(test::whyNotConforming(after), "");
}

}  // namespace
}  // namespace arete
