// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the device cuts and draws, against the engine's own cuts, a rasteriser that shares no code with
// OpenGL, and every sample.
#include "viewer/gl/terrain_drawable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "datasets/families.h"
#include "datasets/random.h"
#include "datasets/terrain_generator.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "engine/morph/geomorph.h"
#include "terrain/builder/build.h"
#include "terrain/locate/ground_height.h"
#include "viewer/color/color_tables.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/frame_target.h"
#include "viewer/gl_mountains.h"
#include "viewer/reference_rasteriser.h"

namespace arete {
namespace {

using test::anyCamera;
using test::DrawnMesh;
using test::MapCamera;
using test::modelOf;
using test::mountains;
using test::ReferencePicture;

/// The drawn surface at every sample, by laying the triangles over the grid.
std::vector<double> heightsAtSamples(const DrawnMesh& mesh, const TerrainModel& model) {
  std::vector<double> heights(std::size_t(model.columns) * model.rows, std::nan(""));
  for (const auto& t : mesh.triangles) {
    const Vec2 &a = mesh.plan[t[0]], &b = mesh.plan[t[1]], &c = mesh.plan[t[2]];
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    for (int row = int(std::ceil(std::min({a.y, b.y, c.y}) - 1e-6)); row <= std::max({a.y, b.y, c.y}) + 1e-6;
         ++row)
      for (int col = int(std::ceil(std::min({a.x, b.x, c.x}) - 1e-6));
           col <= std::max({a.x, b.x, c.x}) + 1e-6; ++col) {
        const double u = ((c.x - b.x) * (row - b.y) - (c.y - b.y) * (col - b.x)) / area,
                     v = ((a.x - c.x) * (row - c.y) - (a.y - c.y) * (col - c.x)) / area, w = 1 - u - v;
        if (u < -1e-6 || v < -1e-6 || w < -1e-6) continue;
        heights[std::size_t(row) * model.columns + std::size_t(col)] =
            u * mesh.vertices[t[0]].z + v * mesh.vertices[t[1]].z + w * mesh.vertices[t[2]].z;
      }
  }
  return heights;
}

TEST(TerrainDrawable, BothPathsDrawTheSameSurface) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  Random random(8);
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE("seed 8, camera " + std::to_string(i));
    const Camera camera = anyCamera(random, model, 1280, 720);
    ViewSettings settings;
    settings.pixels = random.between(0.5, 4);
    test::expectBothPathsAgree(*view, camera, settings);
  }
}

TEST(TerrainDrawable, PicturesAgreeWithARasteriserOfAnotherKind) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  double low = 1e300, high = -1e300;
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) {
    low = std::min(low, model.mt.vertices().height(VertexId(v)));
    high = std::max(high, model.mt.vertices().height(VertexId(v)));
  }
  const GroundHeights truth(model);
  Random random(21);
  for (int i = 0; i < 12; ++i) {
    SCOPED_TRACE("seed 21, camera " + std::to_string(i));
    Camera camera = anyCamera(random, model);
    ViewSettings settings;
    settings.path = i % 3 == 0 ? CutPath::processor : CutPath::device;
    settings.look.isShaded = false;
    ASSERT_TRUE(view->cut(camera, settings));
    const auto target = FrameTarget::create(320, 200);
    ASSERT_TRUE(target);
    target->begin();
    ASSERT_TRUE(view->draw(camera, settings));
    const auto frame = view->frameOf(camera, settings);
    const std::vector<float> depths = target->depths(frame->drawnNear);
    const Image image = target->image();
    const DrawnMesh mesh = test::readDrawn(*view);
    const ReferencePicture reference =
        test::drawReference(mesh.vertices, mesh.triangles, camera, frame->drawnNear);
    const MapCamera map(camera);
    // Where a pixel's middle falls on an edge, or a silhouette, rounding decides: there a neighbour agrees.
    int differing = 0, covered = 0, wrong = 0, wrongColor = 0;
    for (int y = 1; y + 1 < 200; ++y)
      for (int x = 1; x + 1 < 320; ++x) {
        const double drawn = double(depths[std::size_t(y) * 320 + std::size_t(x)]);
        const auto agrees = [&](int dx, int dy) {
          const double expected = reference.at(x + dx, y + dy);
          if (!std::isfinite(expected) || !std::isfinite(drawn))
            return std::isfinite(expected) == std::isfinite(drawn);
          return std::abs(drawn - expected) <= 1e-4 * expected;
        };
        covered += reference.isCovered(x, y) ? 1 : 0;
        if (!agrees(0, 0)) {
          ++differing;
          bool hasNeighbour = false;
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
              const double expected = reference.at(x + dx, y + dy);
              hasNeighbour = hasNeighbour || !std::isfinite(expected) || !std::isfinite(drawn) ||
                             std::abs(drawn - expected) <= 0.05 * expected;
            }
          wrong += hasNeighbour ? 0 : 1;
        } else if (reference.isCovered(x, y)) {
          const double part = (map.heightAt(x, y, reference.at(x, y)) - low) / (high - low);
          const Rgb expected = colorTable("height").at(part).opaque(), got = image.at(x, y);
          const int off = std::max(
              {std::abs(expected.r - got.r), std::abs(expected.g - got.g), std::abs(expected.b - got.b)});
          if (off <= 3) continue;
          // The colour is that of the true height at the place, which a drawn triangle misses by the
          // tolerance: it lies between those of the heights of the places around.
          double lowest = 1, highest = 0;
          for (int dy = std::max(-2, -y); dy <= std::min(2, 199 - y); ++dy)
            for (int dx = std::max(-2, -x); dx <= std::min(2, 319 - x); ++dx) {
              const Vec3 place = map.placeAt(x + dx, y + dy, reference.at(x + dx, y + dy));
              const auto there = truth.at({place.x, place.y});
              if (!there) continue;
              lowest = std::min(lowest, (there->height - low) / (high - low));
              highest = std::max(highest, (there->height - low) / (high - low));
            }
          const Rgb from = colorTable("height").at(lowest).opaque(),
                    to = colorTable("height").at(highest).opaque();
          const auto isBetween = [](int a, int b, int c) {
            return c >= std::min(a, b) - 3 && c <= std::max(a, b) + 3;
          };
          wrongColor += isBetween(from.r, to.r, got.r) && isBetween(from.g, to.g, got.g) &&
                                isBetween(from.b, to.b, got.b)
                            ? 0
                            : 1;
        }
      }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(wrongColor, 0);
    EXPECT_LE(differing, 40 + covered / 200) << "of " << covered;
  }
}

TEST(TerrainDrawable, NoBackgroundShowsThroughFromAHundredCameras) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  const auto target = FrameTarget::create(320, 200);
  ASSERT_TRUE(target);
  Random random(33);
  std::size_t inside = 0;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE("seed 33, camera " + std::to_string(i));
    const Camera camera = anyCamera(random, model);
    ViewSettings settings;
    settings.pixels = random.between(0.5, 12);
    settings.path = i % 2 == 0 ? CutPath::device : CutPath::processor;
    ASSERT_TRUE(view->cut(camera, settings));
    target->begin();
    glClearColor(1, 0, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    const auto frame = view->frameOf(camera, settings);
    view->painter().setFrame(*frame);
    ASSERT_TRUE(view->painter().drawFlat(view->terrain(), view->front(), {0, 1, 0, 1}));
    const Image image = target->image();
    // The silhouette is that of the surface at full detail, a border of pixels away from its outline.
    const DrawnMesh mesh = test::readDrawn(*view);
    const ReferencePicture reference =
        test::drawReference(mesh.vertices, mesh.triangles, camera, frame->drawnNear);
    for (int y = 1; y + 1 < 200; ++y)
      for (int x = 1; x + 1 < 320; ++x) {
        bool isInside = true;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) isInside = isInside && reference.isCovered(x + dx, y + dy);
        if (!isInside) continue;
        ++inside;
        ASSERT_EQ(image.at(x, y), (Rgb{0, 255, 0})) << "pixel " << x << ", " << y;
      }
  }
  EXPECT_GT(inside, 1000000u);
}

TEST(TerrainDrawable, WhatIsDrawnKeepsItsPixelsAtEverySampleInSight) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  const RasterHeightfield samples = model.rasterSamples();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  Random random(55);
  double largestPart = 0;
  std::size_t seen = 0;
  for (int i = 0; i < 24; ++i) {
    SCOPED_TRACE("seed 55, camera " + std::to_string(i));
    const Camera camera = anyCamera(random, model, 1280, 720);
    ViewSettings settings;
    settings.pixels = random.between(0.5, 10);
    settings.isGeomorphed = i % 2 == 0;
    settings.path = i % 4 < 2 ? CutPath::device : CutPath::processor;
    const auto figures = view->cut(camera, settings);
    ASSERT_TRUE(figures);
    ASSERT_TRUE(figures->isComplete);
    const DrawnMesh mesh = test::readDrawn(*view);
    const std::vector<double> drawn = heightsAtSamples(mesh, model);
    const MapCamera map(camera);
    for (std::uint32_t row = 0; row < model.rows; ++row)
      for (std::uint32_t col = 0; col < model.columns; ++col) {
        const Vec2 xy = model.toSource({double(col), double(row)});
        const Vec3 truth{xy.x, xy.y, samples.at(col, row)};
        const double there = drawn[samples.index(col, row)];
        if (std::isnan(truth.z) || std::isnan(there) || !map.sees(truth)) continue;
        const Vec3 a = map.project(truth), b = map.project({xy.x, xy.y, there});
        const double off = std::hypot(a.x - b.x, a.y - b.y);
        ASSERT_LE(off, settings.pixels + 0.02) << "sample " << col << ", " << row;
        largestPart = std::max(largestPart, off / settings.pixels);
        ++seen;
      }
  }
  EXPECT_GT(seen, 100000u);
  EXPECT_GT(largestPart, 0.3) << "the test sees next to nothing";
}

TEST(TerrainDrawable, NothingJumpsFurtherThanReportedAlongASlowFlight) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  Random random(77);
  for (const bool isGeomorphed : {true, false}) {
    Camera camera = anyCamera(random, model, 1280, 720);
    camera.xy = model.toSource({0.5 * model.columns, 0.9 * model.rows});
    camera.azimuthDegrees = 0;
    camera.pitchDegrees = -15;
    ViewSettings settings;
    settings.pixels = 2;
    settings.isGeomorphed = isGeomorphed;
    settings.path = CutPath::processor;
    std::vector<double> last;
    double largest = 0, reported = 0;
    for (int i = 0; i < 60; ++i) {
      SCOPED_TRACE("seed 77, frame " + std::to_string(i));
      camera.xy.y += 1;
      const auto figures = view->cut(camera, settings);
      ASSERT_TRUE(figures);
      const std::vector<double> now = heightsAtSamples(test::readDrawn(*view), model);
      const MapCamera map(camera);
      for (std::size_t s = 0; s < last.size(); ++s) {
        const Vec2 xy = model.toSource({double(s % model.columns), double(s / model.columns)});
        if (std::isnan(now[s]) || !map.sees({xy.x, xy.y, now[s]}) || !map.sees({xy.x, xy.y, last[s]}))
          continue;
        const Vec3 a = map.project({xy.x, xy.y, now[s]}), b = map.project({xy.x, xy.y, last[s]});
        const double jump = std::hypot(a.x - b.x, a.y - b.y);
        // A metre of the flight moves the shares of vertices by little; that is motion, not a jump.
        ASSERT_LE(jump, figures->jumpPixels + 0.1) << "sample " << s;
        largest = std::max(largest, jump);
      }
      if (i > 0) reported = std::max(reported, figures->jumpPixels);
      last = now;
    }
    std::cout << (isGeomorphed ? "with" : "without") << " geomorphing: largest jump " << largest
              << " px, reported " << reported << " px\n";
  }
}

TEST(TerrainDrawable, FarAndNearFitIntoOneDepthBuffer) {
  ARETE_NEEDS_OPENGL(context);
  // 200 km across, a camera a metre above the ground.
  RasterHeightfield field = rasterFamilies()[1].make(101, 101, 3);
  for (std::size_t i = 0; i < field.heights.size(); ++i) {
    const double x = double(i % 101) - 50, y = double(i / 101) - 50;
    field.heights[i] = 2000 * std::exp(-(x * x + y * y) / 200) + 400 * std::sin(0.3 * x) * std::cos(0.2 * y);
  }
  const TerrainModel model = modelOf(field, 2000);
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  Camera camera{.xy = model.toSource({50.0, 98.0}),
                .azimuthDegrees = 2,
                .pitchDegrees = -1,
                .widthPixels = 320,
                .heightPixels = 200};
  camera.height = field.at(50, 98) + 1;
  ViewSettings settings;
  ASSERT_TRUE(view->cut(camera, settings));
  const auto target = FrameTarget::create(320, 200);
  ASSERT_TRUE(target);
  target->begin();
  ASSERT_TRUE(view->draw(camera, settings));
  const auto frame = view->frameOf(camera, settings);
  const std::vector<float> depths = target->depths(frame->drawnNear);
  const DrawnMesh mesh = test::readDrawn(*view);
  const ReferencePicture reference =
      test::drawReference(mesh.vertices, mesh.triangles, camera, frame->drawnNear);
  int agreeing = 0, covered = 0;
  double nearest = 1e300, farthest = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (!std::isfinite(reference.depth[i])) continue;
    ++covered;
    nearest = std::min(nearest, reference.depth[i]);
    farthest = std::max(farthest, reference.depth[i]);
    agreeing += std::abs(double(depths[i]) - reference.depth[i]) <= 1e-3 * reference.depth[i] ? 1 : 0;
  }
  EXPECT_LT(nearest, 20);
  EXPECT_GT(farthest, 90000);
  EXPECT_GE(agreeing, 0.98 * covered) << "of " << covered;
}

}  // namespace
}  // namespace arete
