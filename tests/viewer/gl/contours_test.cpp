// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contour lines of pictures against the contours of the finest triangulation, marched and projected in the test.
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

TEST(Contours, MeasureRealData) {
  const char* path = std::getenv("INK_DEM");
  if (path == nullptr) GTEST_SKIP();
  ARETE_NEEDS_OPENGL(context);
  auto read = readDem(path, {});
  ASSERT_TRUE(read) << read.error().describe();
  RasterHeightfield field = std::get<RasterHeightfield>(read->heightfield);
  auto model = build(field);
  ASSERT_TRUE(model);
  const GroundHeights ground(*model);
  auto view = TerrainDrawable::create(*model, {});
  ASSERT_TRUE(view);
  const double interval = std::atof(std::getenv("INK_INTERVAL"));
  const double threshold = std::getenv("INK_THRESHOLD") ? std::atof(std::getenv("INK_THRESHOLD")) : 0.25;
  const double extent = std::max(model->columns * model->mt.metric().scale.x, model->rows * std::abs(model->mt.metric().scale.y));
  double top = -1e9;
  for (double h : field.heights) if (!std::isnan(h)) top = std::max(top, h);
  struct Place { const char* name; Vec2 plan; double height, azimuth, pitch; };
  const double m = 1 / model->georeference.verticalUnitMetres;
  const Place places[] = {{"above all", {0.5, 0.5}, extent * 0.9, 0, -90}, {"above near", {0.4, 0.6}, 3000, 30, -90},
                          {"oblique", {0.5, 0.7}, 1000, 20, -30}, {"oblique far", {0.5, 1.1}, extent * 0.3, 350, -35}, {"close", {0.6, 0.5}, 200, 200, -40}, {"grazing", {0.3, 0.4}, 300, 100, -5}};
  for (const Place& p : places)
    for (const double pixels : {0.1, 1.0, 10.0}) {
      const Vec2 xy = model->toSource({p.plan.x * model->columns, p.plan.y * model->rows});
      const auto under = ground.at(xy);
      Camera camera{.xy = xy, .height = (under ? under->height : top) + p.height * m, .azimuthDegrees = p.azimuth, .pitchDegrees = p.pitch, .widthPixels = 640, .heightPixels = 400};
      Picture with = drawn(*view, camera, inkAlone(pixels), interval);
      const auto hasInk = [&](int x, int y) { return with.image.at(x, y).r < kBare - threshold * 140; };
      const InkReport r = test::compareInk(field, *model, camera, interval, pixels + 0.5, with.depths, hasInk, true);
      if (std::getenv("INK_OUT") && pixels == 1.0) {
        auto canvas = Canvas::create(640, 400);
        canvas->image(with.image, 0, 0);
        for (auto [x, y] : r.missing) canvas->fill({double(x), double(y), 1, 1}, {255, 0, 0});
        for (auto [x, y] : r.astrayAt) canvas->fill({double(x), double(y), 1, 1}, {0, 0, 255});
        (void)canvas->savePng(fmt::format("{}_{}.png", std::getenv("INK_OUT"), p.name));
      }
      std::vector<double> metres = r.metres; std::sort(metres.begin(), metres.end());
      fmt::print("{:12} tol {:4}: ink {:6} astray {:6.2f}%  contours {:6} without {:6.2f}%  index {:6} without {:6.2f}%  plan median {:.1f} 90% {:.1f}\n", p.name, pixels, r.ink, 100 * r.astray(), r.contour, 100 * r.without(), r.index, 100 * r.indexAway(), metres.empty() ? 0 : metres[metres.size() / 2], metres.empty() ? 0 : metres[metres.size() * 9 / 10]);
    }
}

TEST(Contours, MeasureCrawl) {
  const char* path = std::getenv("INK_DEM");
  if (path == nullptr) GTEST_SKIP();
  ARETE_NEEDS_OPENGL(context);
  auto read = readDem(path, {});
  RasterHeightfield field = std::get<RasterHeightfield>(read->heightfield);
  auto model = build(field);
  ASSERT_TRUE(model);
  const GroundHeights ground(*model);
  auto view = TerrainDrawable::create(*model, {});
  const auto target = FrameTarget::create(480, 270, 4);
  for (const bool shaded : {true})
  for (const double interval : {100.0, 250.0})
    for (const double pitch : {-20.0, -60.0}) {
      Image last;
      double most = 0, sum = 0;
      const Vec2 middle = model->toSource({0.5 * model->columns, 0.5 * model->rows});
      double top = ground.at(middle)->height + 1000;
      for (int i = 0; i < 5; ++i) {
        Camera camera{.xy = {middle.x + 1.2 * i, middle.y + 1.6 * i}, .height = top, .azimuthDegrees = 36.87, .pitchDegrees = pitch, .widthPixels = 480, .heightPixels = 270};
        ViewSettings settings = inkAlone(1);
        settings.look.isShaded = shaded;
        if (shaded) settings.look.coloring = Coloring::height;
        ASSERT_TRUE(view->cut(camera, settings));
        target->begin();
        ASSERT_TRUE(view->draw(camera, settings, contourLayer(interval).list()));
        Image now = target->image();
        if (i > 0) {
          int changed = 0;
          for (int y = 0; y < 270; ++y) for (int x = 0; x < 480; ++x) {
            Rgb a = now.at(x, y), b = last.at(x, y);
            changed += std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) > 16;
          }
          const double part = 100.0 * changed / (480 * 270);
          most = std::max(most, part); sum += part;
        }
        last = std::move(now);
      }
      fmt::print("shaded {} interval {} pitch {}: mean {:.3f}% most {:.3f}%\n", shaded, interval, pitch, sum / 4, most); std::fflush(stdout);
    }
}

const TerrainModel& valleys() {
  static const TerrainModel model = [] {
    TerrainOptions options;
    options.columns = 193;
    options.rows = 161;
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
                           camera.xy.y, camera.height, camera.azimuthDegrees, camera.pitchDegrees, interval, pixels));
  const Picture picture = drawn(view, camera, inkAlone(pixels), interval);
  const InkReport r = test::compareInk(field, model, camera, interval, pixels + 0.5, picture.depths,
                                       inkOf(picture.image));
  EXPECT_LE(r.astray(), 0.01) << r.inkAstray << " of " << r.ink;
  EXPECT_LE(r.indexAway(), 0.01) << r.indexWithout << " of " << r.index;
  EXPECT_GT(r.ink, 200);
}

Camera over(const TerrainModel& model, Vec2 part, double above, double azimuth, double pitch) {
  const Vec2 xy = model.toSource({part.x * model.columns, part.y * model.rows});
  const auto ground = GroundHeights(model).at(xy);
  return {.xy = xy,
          .height = (ground ? ground->height : 0) + above,
          .azimuthDegrees = azimuth,
          .pitchDegrees = pitch,
          .widthPixels = 400,
          .heightPixels = 260};
}

TEST(Contours, InkLiesOnTheContoursOfTheFinestTriangles) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = valleys();
  const RasterHeightfield field = model.rasterSamples();
  auto view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  for (const double pixels : {0.1, 1.0, 10.0}) {
    expectTrueInk(*view, field, model, over(model, {0.5, 0.5}, 1500, 20, -90), 50, pixels);
    expectTrueInk(*view, field, model, over(model, {0.4, 0.6}, 900, 140, -60), 20, pixels);
  }
  for (const double pixels : {0.5, 3.0}) {
    expectTrueInk(*view, field, model, over(model, {0.5, 0.8}, 700, 350, -30), 50, pixels);
    expectTrueInk(*view, field, model, over(model, {0.5, 0.5}, 5000, 0, -90), 100, pixels);
  }
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
    const Camera camera{.xy = {900, -900}, .height = height, .pitchDegrees = -90, .widthPixels = 300, .heightPixels = 300};
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
        ASSERT_GT(column, 20 - 0.2 - pixel) << "on the sea";
        ASSERT_LT(column, 40 + 0.2 + pixel) << "on the lake";
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
  for (int y = 0; y < 260; ++y)
    for (int x = 0; x < 400; ++x) ASSERT_EQ(with.image.at(x, y), without.image.at(x, y));
}

TEST(Contours, InkLiesOnTheContoursOfRealTerrain) {
  ARETE_NEEDS_OPENGL(context);
  int found = 0;
  for (const auto& [name, interval] : {std::pair("srtm1_bigtujunga_utm11.tif", 100.0), {"srtm3_zion_cc0.tif", 100.0}}) {
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
