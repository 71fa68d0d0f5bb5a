// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contour lines of pictures against the contours of the finest triangulation, marched and projected in the
// test.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "datasets/families.h"
#include "datasets/random.h"
#include "datasets/terrain_generator.h"
#include "io/geo/dem/dem_reader.h"
#include "io/io_fixture.h"
#include "terrain/builder/build.h"
#include "terrain/locate/ground_height.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/frame_target.h"
#include "viewer/true_contours.h"

namespace arete {
namespace {

using test::InkReport;

constexpr double kBare = 0.78 * 255;

struct Picture {
  Image image;
  std::vector<float> depths;
};

Layers contourLayer(double interval) {
  Layers layers;
  if (interval > 0) layers.put("contours", Contours{interval});
  return layers;
}

Picture drawn(TerrainDrawable& view, const Camera& camera, const ViewSettings& settings, double interval) {
  EXPECT_TRUE(view.cut(camera, settings));
  const auto target = FrameTarget::create(int(camera.widthPixels), int(camera.heightPixels));
  EXPECT_TRUE(target);
  target->begin();
  EXPECT_TRUE(view.draw(camera, settings, contourLayer(interval).list()));
  return {target->image(), target->depths(view.frameOf(camera, settings)->drawnNear)};
}

ViewSettings inkAlone(double pixels) {
  ViewSettings settings;
  settings.pixels = pixels;
  settings.look.isShaded = false;
  settings.look.coloring = Coloring::plain;
  return settings;
}

const TerrainModel& valleys() {
  static const TerrainModel model = [] {
    TerrainOptions options;
    options.columns = 129;
    options.rows = 113;
    options.sea = options.lake = false;
    Result<RasterHeightfield> field = generateTerrain(options);
    EXPECT_TRUE(field);
    field->georeference = {};
    field->georeference.geoTransform = {512345.6, 30, 0, 5234567.8, 0, -30};
    field->georeference.hasGeoTransform = true;
    Result<TerrainModel> built = build(*field);
    EXPECT_TRUE(built);
    return std::move(*built);
  }();
  return model;
}

/// Everything that differs from bare ground by more than a person overlooks.
auto inkOf(const Image& image) {
  return [&image](int x, int y) { return image.at(x, y).r < kBare - 16; };
}

void expectTrueInk(TerrainDrawable& view, const RasterHeightfield& field, const TerrainModel& model,
                   const Camera& camera, double interval, double pixels) {
  SCOPED_TRACE(fmt::format("camera {:.1f},{:.1f},{:.0f},{:.0f},{:.0f}, interval {}, {} pixels", camera.xy.x,
                           camera.xy.y, camera.height, camera.azimuthDegrees, camera.pitchDegrees, interval,
                           pixels));
  const Picture picture = drawn(view, camera, inkAlone(pixels), interval);
  const InkReport r =
      test::compareInk(field, model, camera, interval, pixels + 0.5, picture.depths, inkOf(picture.image));
  EXPECT_LE(r.astray(), 0.01) << r.inkAstray << " of " << r.ink;
  // A tenth of a pixel leaves no room for the ink of lines that bend within one.
  EXPECT_LE(r.indexAway(), pixels < 0.5 ? 0.015 : 0.01) << r.indexWithout << " of " << r.index;
  EXPECT_GT(r.ink, 200);
}

Camera over(const TerrainModel& model, Vec2 part, double above, double azimuth, double pitch) {
  const Vec2 xy = model.toSource({part.x * model.columns, part.y * model.rows});
  const auto ground = GroundHeights(model).at(xy);
  return {.xy = xy,
          .height = (ground ? ground->height : 0) + above,
          .azimuthDegrees = azimuth,
          .pitchDegrees = pitch,
          .widthPixels = 320,
          .heightPixels = 200};
}

TEST(Contours, InkLiesOnTheContoursOfTheFinestTriangles) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = valleys();
  const RasterHeightfield field = model.rasterSamples();
  auto view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  expectTrueInk(*view, field, model, over(model, {0.5, 0.5}, 1200, 20, -90), 50, 0.1);
  expectTrueInk(*view, field, model, over(model, {0.4, 0.6}, 900, 140, -60), 20, 0.5);
  expectTrueInk(*view, field, model, over(model, {0.5, 0.8}, 700, 350, -30), 50, 1);
  expectTrueInk(*view, field, model, over(model, {0.5, 0.5}, 5000, 0, -90), 100, 3);
  expectTrueInk(*view, field, model, over(model, {0.4, 0.6}, 900, 140, -60), 20, 10);
}

TEST(Contours, TheSeaAndLakesAtALevelHaveNone) {
  ARETE_NEEDS_OPENGL(context);
  // A sea at 0, a lake at 100 exactly, a slope between them, and ground without data.
  RasterHeightfield field;
  field.columns = field.rows = 60;
  field.georeference.geoTransform = {0, 30, 0, 0, 0, -30};
  field.georeference.hasGeoTransform = true;
  for (int row = 0; row < 60; ++row)
    for (int column = 0; column < 60; ++column)
      field.heights.push_back(row < 4 ? std::nan("") : std::clamp((column - 20) * 5.0 + 0.5, 0.0, 100.0));
  auto model = build(field);
  ASSERT_TRUE(model);
  auto view = TerrainDrawable::create(*model, {});
  ASSERT_TRUE(view);
  for (const double height : {400.0, 2500.0, 20000.0}) {
    const Camera camera{
        .xy = {900, -900}, .height = height, .pitchDegrees = -90, .widthPixels = 300, .heightPixels = 300};
    const Picture picture = drawn(*view, camera, inkAlone(1), 50);
    const test::ScreenOfModel screen(camera, *model);
    const auto hasInk = inkOf(picture.image);
    int ink = 0;
    for (int y = 0; y < 300; ++y)
      for (int x = 0; x < 300; ++x) {
        const float depth = picture.depths[std::size_t(y) * 300 + std::size_t(x)];
        if (!std::isfinite(depth) || !hasInk(x, y)) continue;
        ++ink;
        const Vec3 at = screen.unproject(x + 0.5, y + 0.5, double(depth));
        const double column = at.x / model->mt.metric().scale.x + model->mt.metric().origin.x,
                     pixel = double(depth) * 2 * std::tan(0.5236) / 300 / 30;
        ASSERT_GT(column, 19 - 0.1 - pixel) << "on the sea";
        ASSERT_LT(column, 40 + 0.1 + pixel) << "on the lake";
      }
    EXPECT_GT(ink, height < 20000 ? 100 : -1);
  }
}

TEST(Contours, AnIntervalWithoutALevelBetweenHasNone) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = valleys();
  auto view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  const Camera camera = over(model, {0.5, 0.5}, 1500, 20, -60);
  const Picture with = drawn(*view, camera, inkAlone(1), 1e6), without = drawn(*view, camera, inkAlone(1), 0);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 320; ++x) ASSERT_EQ(with.image.at(x, y), without.image.at(x, y));
}

TEST(Contours, InkLiesOnTheContoursOfRealTerrain) {
  ARETE_NEEDS_OPENGL(context);
  int found = 0;
  std::vector<const char*> names = {"srtm3_zion_cc0.tif"};
  if (std::getenv("ARETE_FULL") != nullptr)
    names = {"srtm3_zion_cc0.tif", "srtm1_bigtujunga_utm11.tif", "srtm3_S33W071_aconcagua.tif",
             "srtm3_N46E008_bernese_alps.tif", "usgsdem_mt_st_helens.dem"};
  constexpr double interval = 100;
  for (const char* name : names) {
    const std::string path = test::realData(std::string("dem/") + name);
    if (path.empty()) continue;
    ++found;
    SCOPED_TRACE(name);
    auto read = readDem(path);
    ASSERT_TRUE(read);
    const auto& field = std::get<RasterHeightfield>(read->heightfield);
    auto model = build(field);
    ASSERT_TRUE(model);
    auto view = TerrainDrawable::create(*model, {});
    ASSERT_TRUE(view);
    expectTrueInk(*view, field, *model, over(*model, {0.4, 0.6}, 3000, 30, -90), interval, 0.1);
    expectTrueInk(*view, field, *model, over(*model, {0.5, 0.7}, 1500, 20, -35), interval, 1);
  }
  if (found == 0) GTEST_SKIP() << "no real data here";
}

}  // namespace
}  // namespace arete
