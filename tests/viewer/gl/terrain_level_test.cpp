// SPDX-License-Identifier: GPL-3.0-or-later
//
// Levels of a terrain that are chosen by hand, against the engine's own cuts and the camera, which does not
// count.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/gl_mountains.h"

namespace arete {
namespace {

using test::anyCamera;
using test::mountains;

Camera cameraOf(const TerrainModel& model, std::uint64_t seed) {
  Random random(seed);
  return anyCamera(random, model);
}

TEST(TerrainLevel, OfAnErrorIsTheCutOfThatErrorWhateverTheCameraAndTheExaggeration) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  const double largest = model.mt.largestError();
  for (const double stretch : {1.0, 3.0})
    for (const double error : {largest / 3, largest / 60}) {
      ViewSettings settings;
      settings.stretch = stretch;
      settings.level = HandLevel{.error = error};
      const Cut cut = *takeCut(model.mt, UniformError(error), {.method = CutMethod::saturated});
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", error " << error << ", times " << stretch);
        const auto figures = view->cut(cameraOf(model, seed), settings);
        ASSERT_TRUE(figures) << figures.error().describe();
        EXPECT_NEAR(double(figures->triangles), double(cut.triangles.size()), 0.01 * double(cut.ids.size()));
        EXPECT_TRUE(figures->isComplete);
        EXPECT_EQ(figures->moving, 0u);
        EXPECT_EQ(test::whyNotConforming(test::readDrawn(*view)), "");
      }
    }
}

TEST(TerrainLevel, OfTrianglesHasAsManyAtMostAndTheRootIfThatIsMore) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  ViewSettings settings;
  for (const std::uint32_t most : {1u, 500u, 3000u}) {
    settings.level = HandLevel{.triangles = most};
    const auto figures = view->cut(cameraOf(model, 3), settings);
    ASSERT_TRUE(figures) << figures.error().describe();
    EXPECT_LE(figures->triangles, std::max(most, model.mt.rootTriangleCount()));
    if (most > 1) {
      EXPECT_GT(figures->triangles, most * 9 / 10);
    }
  }
  // By the view again, and on the device.
  settings.level.reset();
  ASSERT_TRUE(view->cut(cameraOf(model, 3), settings));
}

TEST(TerrainLevel, ZeroIsAllOfTheTerrain) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  ViewSettings settings;
  settings.level = HandLevel{};
  const auto figures = view->cut(cameraOf(model, 1), settings);
  ASSERT_TRUE(figures);
  const Cut cut = *takeCut(model.mt, UniformError(0), {.method = CutMethod::saturated});
  EXPECT_EQ(figures->triangles, cut.triangles.size());
}

TEST(TerrainLevel, TheStoredErrorOfADrawnTriangleIsThatOfTheTriangleOverThePlace) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  for (const bool isByHand : {false, true}) {
    ViewSettings settings;
    const double error = model.mt.largestError() / 20;
    if (isByHand) settings.level = HandLevel{.error = error};
    ASSERT_TRUE(view->cut(cameraOf(model, 5), settings));
    const auto mesh = test::readDrawn(*view);
    for (int i = 0; i < 50; ++i) {
      Pick pick;
      pick.plan = {double(3 + 5 * i), double(2 + 3 * i)};  // a sample
      const auto stored = view->drawnError(pick, Camera(), {}, settings);
      ASSERT_TRUE(stored.has_value()) << i;
      if (isByHand) {
        EXPECT_LE(*stored, error * (1 + 1e-9));
      }
      // No sample is farther from the drawn triangle than its error says.
      const auto ground = view->subject().heights()->at(model.toSource(pick.plan));
      ASSERT_TRUE(ground.has_value());
      for (const auto& t : mesh.triangles) {
        const Vec2 &a = mesh.plan[t[0]], &b = mesh.plan[t[1]], &c = mesh.plan[t[2]];
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        const Vec2 p = pick.plan;
        const double u = ((b.x - p.x) * (c.y - p.y) - (b.y - p.y) * (c.x - p.x)) / area,
                     v = ((c.x - p.x) * (a.y - p.y) - (c.y - p.y) * (a.x - p.x)) / area, w = 1 - u - v;
        if (u < 0 || v < 0 || w < 0) continue;
        if (!isByHand) break;  // vertices of the device's cut may be on the move
        const double height =
            u * mesh.vertices[t[0]].z + v * mesh.vertices[t[1]].z + w * mesh.vertices[t[2]].z;
        EXPECT_LE(std::abs(height - ground->height), *stored + 1e-3) << i;
      }
    }
  }
}

}  // namespace
}  // namespace arete
