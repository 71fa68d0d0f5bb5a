// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a picture over a terrain looks like, against a look-up of the place on the map of every pixel drawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "datasets/random.h"
#include "io/drape_fixture.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/drape_on_gpu.h"
#include "viewer/gl/frame_target.h"
#include "viewer/gl/scene.h"
#include "viewer/gl/terrain_drawable.h"

namespace arete {
namespace {

using test::PictureSpec;
using test::TemporaryFolder;
using test::terrainAt;
using test::Transform;
using test::writePicture;

constexpr int kWidth = 320, kHeight = 200;
constexpr const char* kUtm = "EPSG:32611";
const Transform kDem = {500000, 30, 0, 4000000, 0, -30};
constexpr std::uint8_t kPlain = 199;  // 0.78 of 255

/// A terrain, a picture over it, and what one camera sees.
struct DrapedView {
  Image image;
  std::vector<Vec2> place;  ///< on the map, of the middle of each pixel; infinite where there is sky
  std::uint32_t tiles = 0;
  int levels = 0;
  Vec2 placeAt(int x, int y) const { return place[std::size_t(y) * kWidth + std::size_t(x)]; }
};

class Laid {
 public:
  Laid(const TerrainModel& model, const std::string& picture, std::uint32_t tileSide) {
    auto view = TerrainDrawable::create(model, {});
    EXPECT_TRUE(view);
    view_.emplace(std::move(*view));
    auto drape = DrapeOnGpu::load(picture, model, {.read = {}, .tileSide = tileSide});
    EXPECT_TRUE(drape) << drape.error().describe();
    drape_ = std::make_shared<const DrapeOnGpu>(std::move(*drape));
    layers_.put("drape", drape_);
  }
  const DrapeOnGpu& drape() const { return *drape_; }

  DrapedView draw(const Camera& camera) {
    ViewSettings settings;
    settings.look.isShaded = false;
    settings.look.coloring = Coloring::plain;
    EXPECT_TRUE(view_->cut(camera, settings));
    const auto target = FrameTarget::create(kWidth, kHeight);
    EXPECT_TRUE(target);
    target->begin();
    EXPECT_TRUE(view_->draw(camera, settings, layers_.list()));
    const std::vector<float> depths = target->depths(view_->frameOf(camera, settings)->drawnNear);
    DrapedView scene{target->image(), {}, drape_->tiles(), drape_->levels()};
    // The map has metres along both axes, and the camera looks along it.
    const double a = camera.azimuthDegrees * std::numbers::pi / 180,
                 p = camera.pitchDegrees * std::numbers::pi / 180;
    const double focal = kHeight / 2.0 / std::tan(camera.verticalFieldOfViewDegrees * std::numbers::pi / 360);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double depth = double(depths[std::size_t(y) * kWidth + std::size_t(x)]);
        const double right = (x + 0.5 - kWidth / 2.0) / focal, up = (kHeight / 2.0 - y - 0.5) / focal;
        const double along = std::cos(p) - up * std::sin(p);  // the horizontal part of where the pixel looks
        scene.place.push_back({camera.xy.x + depth * (along * std::sin(a) + right * std::cos(a)),
                               camera.xy.y + depth * (along * std::cos(a) - right * std::sin(a))});
      }
    return scene;
  }

 private:
  std::optional<TerrainDrawable> view_;
  std::shared_ptr<const DrapeOnGpu> drape_;
  Layers layers_;
};

Vec2 inPicture(const Transform& t, Vec2 p) {
  const double det = t[1] * t[5] - t[2] * t[4], x = p.x - t[0], y = p.y - t[3];
  return {(x * t[5] - y * t[2]) / det, (y * t[1] - x * t[4]) / det};
}

/// How far apart in the picture the places of pixels beside this one are, or nothing beside the sky.
std::optional<double> reachOf(const DrapedView& scene, const Transform& t, int x, int y) {
  const Vec2 here = inPicture(t, scene.placeAt(x, y));
  double reach = 0;
  for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    const Vec2 p = inPicture(t, scene.placeAt(x + dx, y + dy));
    const double away = std::hypot(p.x - here.x, p.y - here.y);
    if (!std::isfinite(away)) return std::nullopt;
    reach = std::max(reach, away);
  }
  return reach;
}

Camera above(const TerrainModel& model, Vec2 plan, double height, double azimuth = 0, double pitch = -90) {
  return {.xy = model.toSource(plan),
          .height = height,
          .azimuthDegrees = azimuth,
          .pitchDegrees = pitch,
          .verticalFieldOfViewDegrees = 50,
          .widthPixels = double(kWidth),
          .heightPixels = double(kHeight)};
}

double checker(int c, int r, int b) {
  return 40 + ((c / 8) * 7 + (r / 8) * 13) * (b + 3) * 29 % 200;
}

TEST(Drape, EveryPixelShowsTheColourOfItsPlaceOnTheMap) {
  ARETE_NEEDS_OPENGL(context);
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtm, kDem);
  const Transform places[] = {{500000, 10, 0, 4000000, 0, -10},
                              {500330.3, 3.3, 0, 3999711.7, 0, -4.1},  // a part of the terrain
                              {500300, 8.6, 3.1, 3999800, 3.1, -8.6},  // turned
                              {500000, 10, 0, 3999000, 0, 10}};        // on its head
  for (const Transform& t : places)
    for (const std::uint32_t tileSide : {0u, 16u, 37u}) {
      const PictureSpec spec{.columns = 124, .rows = 100, .transform = t, .crs = kUtm, .value = checker};
      Laid laid(model, writePicture(folder.file("picture.tif"), spec), tileSide);
      std::size_t compared = 0, bare = 0, wrong = 0;
      Random random(4);
      for (int i = 0; i < 6; ++i) {
        SCOPED_TRACE("seed 4, camera " + std::to_string(i) + ", tiles of " + std::to_string(tileSide));
        const Camera camera = i < 3 ? above(model, {20, 16}, 300 + 250 * i, 40 * i)
                                    : above(model, {random.between(5, 35), random.between(5, 28)}, 400,
                                            random.between(0, 360), -50);
        const DrapedView scene = laid.draw(camera);
        for (int y = 1; y + 1 < kHeight; ++y)
          for (int x = 1; x + 1 < kWidth; ++x) {
            const auto reach = reachOf(scene, t, x, y);
            if (!reach) continue;
            const Vec2 p = inPicture(t, scene.placeAt(x, y));
            const double beside =
                (t[2] != 0 ? 2.2 : 1.1) + 2 * *reach;  // that filtering may touch: twice where it is turned
            const Rgb got = scene.image.at(x, y);
            if (p.x < -beside || p.y < -beside || p.x > spec.columns + beside || p.y > spec.rows + beside) {
              wrong += got == Rgb{kPlain, kPlain, kPlain} ? 0 : 1;
              ++bare;
              continue;
            }
            const auto isNear = [&](double at, double every) {
              return std::abs(at / every - std::round(at / every)) * every < beside;
            };
            const double edge = t[2] != 0 ? beside : 0;  // a turned one fades there
            if (isNear(p.x, 8) || isNear(p.y, 8) || p.x < edge || p.y < edge || p.x > spec.columns - edge ||
                p.y > spec.rows - edge)
              continue;
            const int c = int(p.x), r = int(p.y);
            const double off =
                std::max({std::abs(got.r - checker(c, r, 0)), std::abs(got.g - checker(c, r, 1)),
                          std::abs(got.b - checker(c, r, 2))});
            wrong += off > 1.5 ? 1 : 0;
            ++compared;
          }
      }
      EXPECT_EQ(wrong, 0u) << "tiles of " << tileSide << ", picture at " << t[0];
      EXPECT_GT(compared, 20000u);
      std::cout << laid.drape().tiles() << " tiles, " << laid.drape().levels() << " levels: " << compared
                << " pixels, " << bare << " outside\n";
    }
}

TEST(Drape, ASmoothPictureOverManyTilesHasNoSeamAtAnyZoom) {
  ARETE_NEEDS_OPENGL(context);
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtm, kDem);
  const Transform t = {499985, 1.75, 0, 4000015, 0, -1.75};
  const int columns = 720, rows = 580;
  const auto smooth = [&](double c, double r, int b) {
    return b == 0   ? 10 + 230 * c / columns
           : b == 1 ? 10 + 230 * r / rows
                    : 240 - 115 * (c / columns + r / rows);
  };
  Laid laid(
      model,
      writePicture(folder.file("picture.tif"),
                   {.columns = columns,
                    .rows = rows,
                    .transform = t,
                    .crs = kUtm,
                    .value = [&](int c, int r, int b) { return std::round(smooth(c + 0.5, r + 0.5, b)); }}),
      34);
  EXPECT_GT(laid.drape().tiles(), 400u);
  EXPECT_GE(laid.drape().levels(), 5);
  const Camera cameras[] = {above(model, {20, 16}, 140),         above(model, {20, 16}, 600, 30),
                            above(model, {20, 16}, 2500),        above(model, {20, 16}, 9000, 70),
                            above(model, {20, 40}, 300, 0, -20), above(model, {-5, 20}, 180, 95, -8),
                            above(model, {20, 60}, 5000, 5, -65)};
  std::size_t compared = 0;
  double worst = 0;
  for (const Camera& camera : cameras) {
    const DrapedView scene = laid.draw(camera);
    for (int y = 1; y + 1 < kHeight; ++y)
      for (int x = 1; x + 1 < kWidth; ++x) {
        const auto reach = reachOf(scene, t, x, y);
        if (!reach) continue;
        const Vec2 p = inPicture(t, scene.placeAt(x, y));
        const double beside = 2 + 3 * *reach;
        if (p.x < beside || p.y < beside || p.x > columns - beside || p.y > rows - beside) continue;
        const Rgb got = scene.image.at(x, y);
        // Where the ground bends, what a pixel covers is not what its middle says.
        const double allowed = 3 + 0.15 * *reach;
        const double off =
            std::max({std::abs(got.r - smooth(p.x, p.y, 0)), std::abs(got.g - smooth(p.x, p.y, 1)),
                      std::abs(got.b - smooth(p.x, p.y, 2))});
        worst = std::max(worst, off);
        ASSERT_LE(off, allowed) << "camera at " << camera.height << ", pixel " << x << ", " << y << ", reach "
                                << *reach;
        ++compared;
      }
  }
  std::cout << compared << " pixels, at most " << worst << " off\n";
  EXPECT_GT(compared, 100000u);
}

TEST(Drape, FarFromItsFirstCornerALongPictureIsAsSharp) {
  ARETE_NEEDS_OPENGL(context);
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtm, kDem);
  // 100 000 pixels along 1200 m, 12 mm each; cells of 8.
  const int columns = 100000, rows = 24;
  const Transform t = {500000, 0.012, 0, 3999520, 0, -0.5};
  Laid laid(model,
            writePicture(folder.file("picture.tif"),
                         {.columns = columns, .rows = rows, .transform = t, .crs = kUtm, .value = checker}),
            128);
  EXPECT_EQ(laid.drape().columns(), 100000u);
  std::size_t compared = 0, wrong = 0;
  for (const double x : {500003.0, 500600.7, 501196.2}) {
    Camera camera = above(model, model.toPlan({x, 3999514}), 0);
    // Two metres above the ground.
    const RasterHeightfield samples = model.rasterSamples();
    const Vec2 plan = model.toPlan({x, 3999514});
    camera.height = samples.at(std::uint32_t(plan.x + 0.5), std::uint32_t(plan.y + 0.5)) + 3;
    const DrapedView scene = laid.draw(camera);
    for (int y = 1; y + 1 < kHeight; ++y)
      for (int px = 1; px + 1 < kWidth; ++px) {
        const Vec2 p = inPicture(t, scene.placeAt(px, y));
        if (!std::isfinite(p.x) || p.x < 8 || p.x > columns - 8 || p.y < 1 || p.y > rows - 1) continue;
        const auto isNear = [](double at) { return std::abs(at / 8 - std::round(at / 8)) * 8 < 2.2; };
        if (isNear(p.x) || isNear(p.y)) continue;
        const Rgb got = scene.image.at(px, y);
        wrong += std::abs(got.r - checker(int(p.x), int(p.y), 0)) > 2 ? 1 : 0;
        ++compared;
      }
  }
  std::cout << compared << " pixels, " << wrong << " wrong\n";
  EXPECT_GT(compared, 5000u);
  EXPECT_EQ(wrong, 0u);
}

TEST(Drape, HalfHiddenPixelsLetHalfOfTheColourBelowThrough) {
  ARETE_NEEDS_OPENGL(context);
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtm, kDem);
  const Transform t = {499900, 20, 0, 4000100, 0, -20};
  Laid laid(
      model,
      writePicture(
          folder.file("picture.tif"),
          {.columns = 80,
           .rows = 80,
           .transform = t,
           .crs = kUtm,
           .bands = 4,
           .value = [](int c, int, int b) { return b == 3   ? (c < 40 ? 0 : 128)
                                                   : b == 0 ? 250
                                                            : 20; },
           .adjust = [](GDALDataset& d) { d.GetRasterBand(4)->SetColorInterpretation(GCI_AlphaBand); }}),
      0);
  const DrapedView scene = laid.draw(above(model, {20, 16}, 700));
  std::size_t clear = 0, covered = 0;
  for (int y = 1; y + 1 < kHeight; ++y)
    for (int x = 1; x + 1 < kWidth; ++x) {
      const Vec2 p = inPicture(t, scene.placeAt(x, y));
      if (!std::isfinite(p.x) || std::abs(p.x - 40) < 2) continue;
      const Rgb got = scene.image.at(x, y);
      if (p.x < 40) {
        ASSERT_EQ(got, (Rgb{kPlain, kPlain, kPlain}));
        ++clear;
      } else {
        ASSERT_NEAR(got.r, (250 * 128 + kPlain * 127) / 255.0, 1.5);
        ASSERT_NEAR(got.g, (20 * 128 + kPlain * 127) / 255.0, 1.5);
        ++covered;
      }
    }
  EXPECT_GT(std::min(clear, covered), 10000u);
}

TEST(Drape, ClassesKeepTheirColoursNearAndAreTheMajorityFarAway) {
  ARETE_NEEDS_OPENGL(context);
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtm, kDem);
  const Transform t = {500000, 1.5, 0, 4000000, 0, -1.5};
  const Rgb colors[] = {{20, 90, 40}, {230, 200, 60}, {190, 30, 30}, {40, 80, 200}};
  // In the west class 1 has 55 of 100 pixels, in the east class 2 has; single pixels of all classes between
  // them.
  const auto classAt = [](int c, int r, int) {
    return Random::at(3, c, r) % 100 < 40 ? double(c < 400 ? 1 : 2) : double(Random::at(4, c, r) % 4);
  };
  Laid laid(model,
            writePicture(folder.file("cover.tif"),
                         {.columns = 800,
                          .rows = 640,
                          .transform = t,
                          .crs = kUtm,
                          .bands = 1,
                          .value = classAt,
                          .adjust =
                              [&](GDALDataset& d) {
                                GDALColorTable table;
                                for (int i = 0; i < 4; ++i) {
                                  const GDALColorEntry e{colors[i].r, colors[i].g, colors[i].b, 255};
                                  table.SetColorEntry(i, &e);
                                }
                                d.GetRasterBand(1)->SetColorTable(&table);
                              }}),
            66);
  EXPECT_TRUE(laid.drape().hasClasses());
  std::size_t nearby = 0, nearbyRight = 0, far = 0, farRight = 0;
  for (const Camera& camera : {above(model, {22, 14}, 150, 30, -60), above(model, {20, 16}, 2600)}) {
    const DrapedView scene = laid.draw(camera);
    for (int y = 1; y + 1 < kHeight; ++y)
      for (int x = 1; x + 1 < kWidth; ++x) {
        const auto reach = reachOf(scene, t, x, y);
        if (!reach) continue;
        const Vec2 p = inPicture(t, scene.placeAt(x, y));
        const double beside = 2 + 2 * *reach;
        if (p.x < beside || p.y < beside || p.x > 800 - beside || p.y > 640 - beside) continue;
        const Rgb got = scene.image.at(x, y);
        ASSERT_NE(std::ranges::find(colors, got), std::end(colors))
            << "no class has the colour at " << x << ", " << y;
        const auto isInside = [](double at) { return std::abs(at - std::round(at)) > 0.1; };
        if (*reach < 0.9 && isInside(p.x) && isInside(p.y)) {
          ++nearby;
          nearbyRight += got == colors[int(classAt(int(p.x), int(p.y), 0))] ? 1 : 0;
        } else if (*reach > 6 && std::abs(p.x - 400) > 2 * *reach) {
          ++far;
          farRight += got == colors[p.x < 400 ? 1 : 2] ? 1 : 0;
        }
      }
  }
  std::cout << nearbyRight << " of " << nearby << " near, " << farRight << " of " << far << " far away\n";
  EXPECT_GT(nearby, 5000u);
  EXPECT_EQ(nearbyRight, nearby);
  EXPECT_GT(far, 1000u);
  EXPECT_GE(double(farRight), 0.97 * double(far));
}

TEST(Drape, APictureTooLargeForTheDeviceIsToldToBeCoarser) {
  ARETE_NEEDS_OPENGL(context);
  const TemporaryFolder folder;
  const TerrainModel model = terrainAt(folder, kUtm, kDem);
  const Transform t = {500000, 1.5, 0, 4000000, 0, -1.5};
  // With tiles of two pixels the layers of a texture are soon used up.
  const auto drape = DrapeOnGpu::load(
      writePicture(folder.file("picture.tif"),
                   {.columns = 600, .rows = 500, .transform = t, .crs = kUtm, .value = checker}),
      model, {.read = {}, .tileSide = 4});
  ASSERT_TRUE(drape) << drape.error().describe();
  EXPECT_LT(drape->columns(), 600u);
  ASSERT_EQ(drape->warnings().size(), 1u);
  EXPECT_NE(drape->warnings()[0].sentence.find("coarse"), std::string::npos);
}

}  // namespace
}  // namespace arete
