// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is drawn, against the places of the features on the screen by the camera's own arithmetic.
#include "viewer/layers/feature_painter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "datasets/terrain_generator.h"
#include "terrain/builder/build.h"
#include "terrain/model/camera.h"
#include "viewer/gl/frame_target.h"
#include "viewer/gl/offscreen.h"
#include "viewer/gl/terrain_drawable.h"

namespace arete {
namespace {

constexpr Rgb kRed = {255, 0, 0};
constexpr int kWidth = 480, kHeight = 300;

const TerrainModel& hills() {
  static const TerrainModel model = [] {
    TerrainOptions options;
    options.columns = 129;
    options.rows = 97;
    options.lake = false;
    Result<RasterHeightfield> field = generateTerrain(options);
    EXPECT_TRUE(field);
    field->georeference = {};
    field->georeference.geoTransform = {512345.6, 30, 0, 5234567.8, 0, -30};
    field->georeference.hasGeoTransform = true;
    Result<TerrainModel> made = build(*field);
    EXPECT_TRUE(made);
    return std::move(*made);
  }();
  return model;
}

/// One OpenGL context, terrain and painter for all tests of this file.
class FeaturePainterTest : public testing::Test {
 protected:
  void SetUp() override {
    context_ = std::make_unique<Result<OffscreenContext>>(OffscreenContext::create());
    if (!*context_) GTEST_SKIP() << context_->error().describe();
    auto view = TerrainDrawable::create(hills(), {});
    ASSERT_TRUE(view) << view.error().describe();
    view_ = std::make_unique<TerrainDrawable>(std::move(*view));
    auto painter = FeaturePainter::create();
    ASSERT_TRUE(painter) << painter.error().describe();
    painter_ = std::make_unique<FeaturePainter>(std::move(*painter));
  }
  void TearDown() override {
    painter_.reset();
    view_.reset();
    context_.reset();
  }

  GroundFeatures grounded(const FeatureLayer& layer) {
    const Profiles profiles(hills());
    auto ground = layOnGround(layer, profiles);
    EXPECT_TRUE(ground) << ground.error().describe();
    return std::move(*ground);
  }

  /// The picture of the terrain with the features over it.
  Image picture(const GroundFeatures& features, const Camera& camera, const ViewSettings& settings,
                const FeatureStyle& style = {.color = kRed, .width = 3}) {
    auto target = FrameTarget::create(kWidth, kHeight);
    EXPECT_TRUE(target);
    target->begin();
    EXPECT_TRUE(view_->cut(camera, settings));
    EXPECT_TRUE(view_->draw(camera, settings));
    FeatureBuffers buffers =
        uploadFeatures(features, [](Vec2 xy, double height) { return metricPosition(xy, height, hills()); });
    painter_->setFrame(*view_->frameOf(camera, settings), hills().mt.metric());
    painter_->draw(buffers, style);
    LabelPlacement placement(kWidth, kHeight);
    painter_->keepPointsFree(buffers, style, placement);
    EXPECT_TRUE(painter_->drawLabels(buffers, features, style, placement));
    return target->image();
  }

  Vec2 pixelOf(Vec2 xy, double height, const Camera& camera) {
    const auto frame = view_->frameOf(camera, settings_);
    const Frustum frustum(frame->view);
    const Vec3 p = frustum.toView(metricPosition(xy, height, hills()));
    const double side = frame->isMirrored ? -1 : 1;
    return {kWidth * (0.5 + 0.5 * side * p.x / (p.z * frustum.planes().slopeX)),
            kHeight * (0.5 - 0.5 * p.y / (p.z * frustum.planes().slopeY))};
  }

  Camera above() const {
    return {.xy = hills().toSource({64, 48}),
            .height = 6000,
            .azimuthDegrees = 20,
            .pitchDegrees = -89.9,
            .verticalFieldOfViewDegrees = 40,
            .widthPixels = kWidth,
            .heightPixels = kHeight};
  }

  std::unique_ptr<Result<OffscreenContext>> context_;
  std::unique_ptr<TerrainDrawable> view_;
  std::unique_ptr<FeaturePainter> painter_;
  ViewSettings settings_;
};

bool isRed(Rgb c) {
  return c.r > 150 && c.g < 90 && c.b < 90;
}

FeatureLayer aWay(const TerrainModel& model) {
  FeatureLayer layer;
  layer.name = "way";
  layer.vertices = {model.toSource({20.3, 30.2}), model.toSource({70, 40.5}), model.toSource({100.2, 80.1})};
  layer.lines = {{0, 3}};
  return layer;
}

TEST_F(FeaturePainterTest, ALineIsSeenWholeFromAboveAtEveryTolerance) {
  const GroundFeatures way = grounded(aWay(hills()));
  const Camera camera = above();
  for (const double pixels : {0.1, 1.0, 10.0}) {
    settings_.pixels = pixels;
    const Image image = picture(way, camera, settings_);
    int seen = 0, all = 0;
    for (const auto& vertex : way.vertices) {
      const Vec2 p = pixelOf(vertex.xy, vertex.height, camera);
      const int x = int(std::floor(p.x)), y = int(std::floor(p.y));
      if (x < 1 || y < 1 || x + 1 >= kWidth || y + 1 >= kHeight) continue;
      ++all;
      // From above, what is raised moves outwards by up to the tolerance.
      const int reach = 1 + int(pixels);
      bool isThere = false;
      for (int dy = -reach; dy <= reach && !isThere; ++dy)
        for (int dx = -reach; dx <= reach && !isThere; ++dx)
          isThere = x + dx >= 0 && y + dy >= 0 && x + dx < kWidth && y + dy < kHeight &&
                    isRed(image.at(x + dx, y + dy));
      seen += isThere ? 1 : 0;
    }
    EXPECT_GT(all, 100);
    EXPECT_EQ(seen, all) << pixels << " pixels";
  }
}

TEST_F(FeaturePainterTest, AWayBehindAMountainIsHidden) {
  // A wall across the model hides what is behind it from a low eye.
  FeatureLayer layer;
  layer.name = "behind";
  double highest = -1e300, lowest = 1e300;
  for (std::uint32_t v = 0; v < hills().mt.vertexCount(); ++v) {
    highest = std::max(highest, double(hills().mt.vertices().height(VertexId(v))));
    lowest = std::min(lowest, double(hills().mt.vertices().height(VertexId(v))));
  }
  const GroundHeights heights(hills());
  for (int i = 0; i < 128; ++i) layer.vertices.push_back(hills().toSource({double(i), 2.0}));
  layer.lines = {{0, 128}};
  const GroundFeatures way = grounded(layer);
  const Vec2 eye = hills().toSource({64, 94});
  const Camera camera = {.xy = eye,
                         .height = heights.at(eye)->height + 20,
                         .azimuthDegrees = 0,
                         .pitchDegrees = 0,
                         .verticalFieldOfViewDegrees = 60,
                         .widthPixels = kWidth,
                         .heightPixels = kHeight};
  settings_.pixels = 0.5;
  const Image image = picture(way, camera, settings_);
  // The oracle: rays to the vertices of the line, in steps of a tenth of a sample.
  int wronglySeen = 0, hidden = 0, wronglyHidden = 0, visible = 0;
  for (const auto& vertex : way.vertices) {
    const Vec2 p = pixelOf(vertex.xy, vertex.height, camera);
    if (p.x < 3 || p.y < 3 || p.x >= kWidth - 3 || p.y >= kHeight - 3) continue;
    double clearance = 1e300;  // of the ray, in pixels on the screen
    for (double t = 0.01; t < 0.97; t += 0.002) {
      const Vec2 xy = eye + t * (vertex.xy - eye);
      const auto ground = heights.at(xy);
      if (!ground) continue;
      const Vec2 q = pixelOf(xy, ground->height, camera);
      clearance = std::min(clearance, q.y - p.y);
    }
    const bool isThere = isRed(image.at(int(p.x), int(p.y))) || isRed(image.at(int(p.x), int(p.y) - 1)) ||
                         isRed(image.at(int(p.x), int(p.y) + 1));
    if (clearance < -4) {
      ++hidden;
      wronglySeen += isThere ? 1 : 0;
    } else if (clearance > 2) {
      ++visible;
      wronglyHidden += isThere ? 0 : 1;
    }
  }
  EXPECT_GT(hidden + visible, 60);
  EXPECT_LE(wronglySeen, hidden / 50) << hidden;
  EXPECT_LE(wronglyHidden, visible / 50) << visible;
}

TEST_F(FeaturePainterTest, LabelsStandAtTheirPlacesAndGoBehindTheTerrain) {
  FeatureLayer layer;
  layer.name = "peaks";
  layer.points = {{hills().toSource({64, 48})}};
  layer.labels = {{"Mont \xC3\x89t\xC3\xA9", {hills().toSource({64, 48})}}};
  const GroundFeatures peaks = grounded(layer);
  settings_.pixels = 1;
  const Image with = picture(peaks, above(), settings_);
  const Image without = picture(GroundFeatures{}, above(), settings_);
  const Vec2 p = pixelOf(peaks.labels[0].at.xy, peaks.labels[0].at.height, above());
  int changed = 0, outside = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (!(with.at(x, y) == without.at(x, y))) {
        ++changed;
        outside += std::abs(x - p.x) > 60 || y > p.y + 6 || y < p.y - 40 ? 1 : 0;
      }
  EXPECT_GT(changed, 200);
  EXPECT_EQ(outside, 0);

  // From below the ground nothing of it is seen.
  GroundFeatures buried = peaks;
  buried.points[0].height -= 500;
  buried.labels[0].at.height -= 500;
  const Image none = picture(buried, above(), settings_);
  EXPECT_EQ(none.pixels, without.pixels);
}

TEST_F(FeaturePainterTest, PointsAreDiscsAtTheirPlacesOrNotThereAtAll) {
  // Over the whole terrain, from a low eye: a marker is drawn if its place is seen, and then the whole of it.
  FeatureLayer layer;
  layer.name = "points";
  for (int i = 0; i < 12; ++i)
    layer.points.push_back({hills().toSource({10.0 * i + 4.3, 10.1 + (i * 37) % 80})});
  const GroundFeatures points = grounded(layer);
  ASSERT_EQ(points.points.size(), 12u);
  settings_.pixels = 1;
  const Camera low = {.xy = hills().toSource({64, 130}),
                      .height = 2500,
                      .azimuthDegrees = 0,
                      .pitchDegrees = -25,
                      .verticalFieldOfViewDegrees = 60,
                      .widthPixels = kWidth,
                      .heightPixels = kHeight};
  for (const Camera& camera : {above(), low}) {
    const Image none = picture(GroundFeatures{}, camera, settings_);
    int whole = 0;
    for (const auto& point : points.points) {
      GroundFeatures one;
      one.points = {point};
      const Image image = picture(one, camera, settings_, {.color = kRed, .width = 2});
      const Vec2 p = pixelOf(point.xy, point.height, camera);
      int changed = 0, beside = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          if (!(image.at(x, y) == none.at(x, y))) {
            ++changed;
            beside += std::hypot(x + 0.5 - p.x, y + 0.5 - p.y) > 6 ? 1 : 0;
          }
      EXPECT_EQ(beside, 0);
      if (changed == 0) continue;
      ++whole;
      if (p.x > 6 && p.y > 6 && p.x < kWidth - 6 && p.y < kHeight - 6) {
        EXPECT_GT(changed, 55) << "a disc of radius 4.5";
        EXPECT_TRUE(isRed(image.at(int(p.x), int(p.y))));
      }
    }
    EXPECT_GT(whole, camera.pitchDegrees < -80 ? 10 : 4);
  }
}

TEST_F(FeaturePainterTest, OpacityMixesWithTheGround) {
  const GroundFeatures way = grounded(aWay(hills()));
  settings_.pixels = 0.5;
  const Image none = picture(GroundFeatures{}, above(), settings_);
  const Image full = picture(way, above(), settings_, {.color = kRed, .width = 5, .opacity = 1});
  const Image half = picture(way, above(), settings_, {.color = kRed, .width = 5, .opacity = 0.5});
  int compared = 0;
  for (std::size_t i = 0; i < full.pixels.size(); ++i) {
    if (!(full.pixels[i] == kRed)) continue;
    ++compared;
    EXPECT_NEAR(half.pixels[i].r, (255 + none.pixels[i].r) / 2.0, 2);
    EXPECT_NEAR(half.pixels[i].g, none.pixels[i].g / 2.0, 2);
  }
  EXPECT_GT(compared, 500);
}

}  // namespace
}  // namespace arete
