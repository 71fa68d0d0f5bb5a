// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of a TIN over shaded relief.
#include "viewer/map/tin_picture.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <string>

#include "viewer/map/map_page.h"
#include "viewer/picture/hillshade.h"
#include "viewer/picture_fixture.h"

namespace arete {
namespace {

using test::bytesOf;
using test::field;
using test::finest;
using test::hills;
using test::located;
using test::TemporaryFolder;

TEST(TinPicture, IsTheSameFileTwice) {
  const TemporaryFolder folder;
  const RasterHeightfield h = hills();
  for (const char* name : {"a.png", "b.png"}) {
    auto canvas = drawTin(
        h, finest(h),
        {.width = 700, .title = "Hills", .tolerance = 1.0, .measuredError = 0.5, .finestTriangles = 20000});
    ASSERT_TRUE(canvas);
    ASSERT_TRUE(canvas->savePng(folder / name));
  }
  EXPECT_EQ(bytesOf(folder / "a.png"), bytesOf(folder / "b.png"));
}

TEST(TinPicture, DrawsTheEdges) {
  const RasterHeightfield h = located(field(11, 11, [](double, double) { return 100.0; }), 30);
  TriangleMesh mesh;
  for (const auto& [c, r] : {std::pair{0, 0}, {0, 10}, {10, 10}, {10, 0}}) {
    const Vec2 p = h.georeference.toSource(c, r);
    mesh.positions.push_back({p.x, p.y, 100});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto canvas = drawTin(h, mesh, {.width = 700, .isDecorated = false});
  const auto page =
      makeMapPage(11, 11, h.georeference, {.width = 700, .caption = {"", ""}, .isDecorated = false});
  ASSERT_TRUE(canvas && page);
  const Vec2 middle = page->toPage(5, 5), beside = page->toPage(2, 8);
  EXPECT_LT(canvas->pixel(int(middle.x), int(middle.y)).g + 40,
            canvas->pixel(int(beside.x), int(beside.y)).g);
}

TEST(TinPicture, PutsADetailOnATinTooDenseToSee) {
  const RasterHeightfield h = hills();
  const auto with = drawTin(h, finest(h), {.width = 700}),
             without = drawTin(h, finest(h), {.width = 700, .detail = false});
  ASSERT_TRUE(with && without);
  const auto reddish = [](const Canvas& canvas) {
    int count = 0;
    for (int y = 0; y < canvas.height(); ++y) {
      for (int x = 0; x < canvas.width(); ++x) count += canvas.pixel(x, y) == Rgb{168, 44, 30};
    }
    return count;
  };
  EXPECT_GT(reddish(*with), 500);
  EXPECT_EQ(reddish(*without), 0);
}

TEST(TinPicture, RefusesABrokenMesh) {
  TriangleMesh mesh;
  mesh.triangles = {{0, 1, 2}};
  EXPECT_FALSE(drawTin(hills(), mesh));
}

TEST(TinPicture, HasALegendWithTheColoursOfLevelGround) {
  // Wide terraces: in their middles the ground is level.
  const RasterHeightfield terraces =
      located(field(120, 120, [](double c, double) { return 4321 + 0.2 * std::floor(c / 30); }), 30);
  const auto canvas = drawTin(terraces, {}, {.width = 900, .title = "T"});
  ASSERT_TRUE(canvas) << canvas.error().describe();
  const ColorMap tints = hillshadeTints(terraces);
  for (int terrace = 0; terrace < 4; ++terrace) {
    const Rgb expected = onLevelGround(tints.at(4321 + 0.2 * terrace).opaque(), {.tint = 0.85});
    int inMap = 0, inLegend = 0;
    for (int y = 90; y < 400; ++y)
      for (int x = 0; x < canvas->width(); ++x) {
        const bool isRight = canvas->pixel(x, y) == expected;
        (x < 560 ? inMap : inLegend) += isRight ? 1 : 0;
      }
    EXPECT_GT(inMap, 5000) << terrace;
    EXPECT_GT(inLegend, 20) << "terrace " << terrace << " is not in the legend";
  }
}

}  // namespace
}  // namespace arete
