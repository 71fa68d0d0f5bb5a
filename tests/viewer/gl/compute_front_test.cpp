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

namespace arete {
namespace {

using test::DrawnMesh;

/// On a map in metres, north up, far from the origin of its coordinates.
TerrainModel builtModel(RasterHeightfield field, double pixelMetres = 30) {
  field.georeference = {};
  field.georeference.geoTransform = {512345.6, pixelMetres, 0, 5234567.8, 0, -pixelMetres};
  field.georeference.hasGeoTransform = true;
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

const TerrainModel& someMountains() {
  static const TerrainModel model = [] {
    TerrainOptions options;
    options.columns = 257;
    options.rows = 193;
    options.lake = false;
    Result<RasterHeightfield> field = generateTerrain(options);
    EXPECT_TRUE(field);
    return builtModel(std::move(*field));
  }();
  return model;
}

double highestOf(const TerrainModel& model) {
  double high = -1e300;
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v)
    high = std::max(high, model.mt.vertices().height(VertexId(v)));
  return high;
}

Camera someCamera(Random& random, const TerrainModel& model, int width = 320, int height = 200) {
  const Vec2 plan{random.between(-0.2, 1.2) * model.columns, random.between(-0.2, 1.2) * model.rows};
  return {.xy = model.toSource(plan),
          .height = highestOf(model) + random.between(5, 1500),
          .azimuthDegrees = random.between(0, 360),
          .pitchDegrees = random.between(-70, 10),
          .verticalFieldOfViewDegrees = random.between(25, 80),
          .widthPixels = double(width),
          .heightPixels = double(height)};
}

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
    const TerrainModel model = builtModel(family.make(61, 47, seed));
    Result<TerrainDrawable> view = TerrainDrawable::create(model, {.mostTriangles = 20000});
    ASSERT_TRUE(view) << view.error().describe();
    ASSERT_EQ(view->deviceRefusal(), "");
    Random random(seed);
    for (int i = 0; i < 8; ++i) {
      SCOPED_TRACE(std::string(family.name) + ", seed 11, camera " + std::to_string(i));
      const Camera camera = someCamera(random, model);
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
  const TerrainModel& model = someMountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {.mostTriangles = 3000});
  ASSERT_TRUE(view);
  Random random(5);
  const Camera camera = someCamera(random, model);
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
