// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models and layers in one picture, by its pixels.
#include "viewer/gl/scene.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "terrain/builder/build.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/frame_target.h"
#include "viewer/gl/terrain_drawable.h"

namespace arete {
namespace {

constexpr int kSide = 120;

/// Flat ground 300 m wide, its corner at a place of the map.
TerrainModel flatAt(double x) {
  RasterHeightfield field;
  field.columns = field.rows = 11;
  field.heights.assign(121, 100);
  field.georeference.geoTransform = {x, 30, 0, 4000000, 0, -30};
  field.georeference.hasGeoTransform = true;
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

/// A scene and what a camera straight above x = 0 sees of it, two metres a pixel.
struct Seen {
  Result<Scene> scene = Scene::create();
  Result<FrameTarget> target = FrameTarget::create(kSide, kSide);
  FrameFigures figures;

  void add(const TerrainModel& model) {
    Result<TerrainDrawable> made = TerrainDrawable::create(model, {});
    ASSERT_TRUE(made);
    ASSERT_TRUE(scene->add(std::make_unique<TerrainDrawable>(std::move(*made))));
  }
  Status draw() {
    const Camera camera{.xy = {0, 3999835},
                        .height = 100 + kSide,
                        .pitchDegrees = -90,
                        .verticalFieldOfViewDegrees = 90,
                        .widthPixels = kSide,
                        .heightPixels = kSide};
    ViewSettings settings;
    settings.look.isShaded = false;
    settings.look.coloring = Coloring::plain;
    ARETE_TRY(figures, scene->cut(camera, settings));
    target->begin();
    return scene->draw(camera, settings);
  }
  Rgb at(int x, int y) const { return target->image().at(x, y); }
};

Layer::Overlay plainOverlay(const Rgba& color) {
  return std::make_shared<const PlanPicture>(
      PlanPicture{.width = 1, .height = 1, .rgba = {color}, .scale = {}, .shift = {}});
}

const Rgb kGround{199, 199, 199};

TEST(Scene, DrawsAllOfItsModelsAndAddsUpTheirFigures) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel west = flatAt(-330), east = flatAt(30);
  Seen one, both;
  one.add(west);
  ASSERT_TRUE(one.draw());
  both.add(west);
  both.add(east);
  ASSERT_TRUE(both.draw());
  EXPECT_EQ(one.at(20, 60), kGround);
  EXPECT_NE(one.at(100, 60), kGround) << "the sky";
  EXPECT_EQ(both.at(20, 60), kGround);
  EXPECT_EQ(both.at(100, 60), kGround);
  EXPECT_NE(both.at(60, 60), kGround) << "the gap between them";
  EXPECT_EQ(both.figures.triangles, 2 * one.figures.triangles);
  EXPECT_TRUE(both.scene->isShown());
}

TEST(Scene, PaintsTheLayersOnTheGroundInTheirOrderWithTheirOpacity) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel model = flatAt(-150);
  Seen seen;
  seen.add(model);
  seen.scene->layers.put("red", plainOverlay({255, 0, 0, 255}));
  seen.scene->layers.put("blue", plainOverlay({0, 0, 255, 255}));
  ASSERT_TRUE(seen.draw());
  EXPECT_EQ(seen.at(60, 60), (Rgb{0, 0, 255}));
  seen.scene->layers.move(0, true);
  ASSERT_TRUE(seen.draw());
  EXPECT_EQ(seen.at(60, 60), (Rgb{255, 0, 0}));
  seen.scene->layers.find("red")->opacity = 0.5;
  ASSERT_TRUE(seen.draw());
  EXPECT_NEAR(seen.at(60, 60).r, 127.5, 1);
  EXPECT_NEAR(seen.at(60, 60).b, 127.5, 1);
  for (const char* name : {"red", "blue"}) seen.scene->layers.find(name)->isVisible = false;
  ASSERT_TRUE(seen.draw());
  EXPECT_EQ(seen.at(60, 60), kGround);
}

TEST(Scene, RefusesMoreLayersOnTheGroundThanItCanPaintByName) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel model = flatAt(-150);
  Seen seen;
  seen.add(model);
  for (const char* name : {"a", "b", "c", "d", "e"})
    seen.scene->layers.put(name, plainOverlay({1, 2, 3, 255}));
  const Status drawn = seen.draw();
  ASSERT_FALSE(drawn);
  EXPECT_EQ(drawn.error().culprit, "e");
  seen.scene->layers.find("b")->isVisible = false;
  EXPECT_TRUE(seen.draw());
}

TEST(Scene, DrawsLinesInSpaceWithTheirOpacity) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel model = flatAt(-150);
  Seen seen;
  seen.add(model);
  const CameraSpace& space = seen.scene->subject().space();
  SpaceVertices lines;
  for (int row = -4; row <= 4; ++row)
    lines.addLine(space.position({-40, 3999835 + row * 1.0}, 101),
                  space.position({40, 3999835 + row * 1.0}, 101), {255, 0, 0, 255});
  seen.scene->layers.put("lines", lines);
  ASSERT_TRUE(seen.draw());
  EXPECT_EQ(seen.at(60, 60), (Rgb{255, 0, 0}));
  EXPECT_EQ(seen.at(60, 20), kGround);
  seen.scene->layers.find("lines")->opacity = 0.5;
  ASSERT_TRUE(seen.draw());
  EXPECT_LT(seen.at(60, 60).r, 255);
  EXPECT_GT(seen.at(60, 60).g, 0);
}

}  // namespace
}  // namespace arete
