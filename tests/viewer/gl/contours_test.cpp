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

}  // namespace
}  // namespace arete
