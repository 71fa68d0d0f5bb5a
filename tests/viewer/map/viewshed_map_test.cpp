// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/map/viewshed_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include "terrain/viewshed/many.h"
#include "viewer/color/difference.h"
#include "viewer/color_oracle.h"
#include "viewer/picture_fixture.h"

namespace arete {
namespace {

using namespace test;
using enum ViewshedCell;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

using Colors = std::set<std::tuple<int, int, int>>;

/// The colours of the largest part of the page that has no paper: the map.
Colors colorsIn(const Canvas& canvas, const Rect& area) {
  Colors colors;
  for (int y = int(area.top); y < int(area.bottom()); ++y)
    for (int x = int(area.left); x < int(area.right()); ++x) {
      const Rgb c = canvas.pixel(x, y);
      colors.insert({c.r, c.g, c.b});
    }
  return colors;
}

RasterHeightfield slopes() {
  return field(40, 40, [](double c, double r) { return 100 + 20 * std::sin(c / 5) * std::cos(r / 7); });
}

/// A page of 900 pixels has its map from 40 to the right; inside of its frame.
constexpr Rect kInsideTheMap = {44, 84, 400, 400};

TEST(ViewshedMap, HasTheColoursOfItsLegendAndNoOther) {
  std::vector<ViewshedCell> cells(1600, hidden);
  for (std::size_t i = 0; i < 400; ++i) cells[i] = seen;
  for (std::size_t i = 400; i < 800; ++i) cells[i] = unknown;
  for (std::size_t i = 800; i < 900; ++i) cells[i] = undecided;
  for (std::size_t i = 900; i < 1000; ++i) cells[i] = outside;
  const auto canvas = drawViewshedMap(slopes(), cells, {}, {}, {.width = 900, .title = "T"});
  ASSERT_TRUE(canvas) << canvas.error().describe();
  Colors shades;
  for (const ViewshedCell cell : {seen, hidden, unknown, undecided, outside})
    for (int shade = 0; shade < 16; ++shade) {
      const Rgb c = viewshedColor(cell, shade);
      shades.insert({c.r, c.g, c.b});
    }
  const Colors map = colorsIn(*canvas, kInsideTheMap);
  EXPECT_GT(map.size(), 20u) << "the relief is seen";
  for (const auto& color : map)
    EXPECT_TRUE(shades.contains(color)) << std::get<0>(color) << " " << std::get<1>(color);
  const Colors legend = colorsIn(*canvas, {500, 60, canvas->width() - 502.0, 300});
  for (const auto& color : shades)
    EXPECT_TRUE(legend.contains(color))
        << std::get<0>(color) << " " << std::get<1>(color) << " " << std::get<2>(color);
}

TEST(ViewshedMap, HasAnswersThatAreUnlikeEachOtherForAllEyes) {
  const std::array<ViewshedCell, 5> cells = {seen, hidden, unknown, undecided, outside};
  for (const ViewshedCell a : cells)
    for (const ViewshedCell b : cells) {
      if (a >= b) continue;
      for (const test::Eyes eyes : test::kAllEyes)
        for (const int i : {0, 5, 10, 15})
          for (const int j : {0, 5, 10, 15})
            ASSERT_GE(colorDifference(test::seenBy(eyes, viewshedColor(a, i)),
                                      test::seenBy(eyes, viewshedColor(b, j))),
                      10)
                << int(a) << " and " << int(b) << " for eyes " << int(eyes);
    }
}

TEST(ViewshedMap, ColoursNumbersHeightsAndTheHorizon) {
  std::vector<ViewshedCell> cells(1600, seen);
  std::vector<double> values(1600);
  for (std::size_t i = 0; i < 1600; ++i) values[i] = double(i / 400);
  const auto colors = [&](ViewshedMapKind kind) {
    const auto canvas =
        drawViewshedMap(slopes(), cells, values, {}, {.width = 900, .title = "T", .kind = kind});
    EXPECT_TRUE(canvas);
    return colorsIn(*canvas, kInsideTheMap);
  };
  const auto hasUnknown = [](const Colors& all) {
    for (int i = 0; i < 16; ++i) {
      const Rgb c = viewshedColor(unknown, i);
      if (all.contains({c.r, c.g, c.b})) return true;
    }
    return false;
  };
  for (const auto kind : {ViewshedMapKind::counts, ViewshedMapKind::servers, ViewshedMapKind::heights,
                          ViewshedMapKind::horizon}) {
    SCOPED_TRACE(int(kind));
    EXPECT_FALSE(hasUnknown(colors(kind)));
  }
  for (std::size_t i = 0; i < 300; ++i) values[i] = ViewshedOfMany::kUnknown;
  EXPECT_TRUE(hasUnknown(colors(ViewshedMapKind::counts)));
  EXPECT_TRUE(hasUnknown(colors(ViewshedMapKind::servers)));
  for (std::size_t i = 0; i < 300; ++i) values[i] = kNone, cells[i] = unknown;
  for (std::size_t i = 300; i < 600; ++i) values[i] = kInfinite, cells[i] = hidden;
  EXPECT_TRUE(hasUnknown(colors(ViewshedMapKind::heights)));
  EXPECT_TRUE(hasUnknown(colors(ViewshedMapKind::horizon)));
  for (std::size_t i = 0; i < 300; ++i) cells[i] = hidden;  // hidden at one height, and none is known
  EXPECT_TRUE(hasUnknown(colors(ViewshedMapKind::heights)));
}

TEST(ViewshedMap, ShowsThePartWithAnswers) {
  std::vector<ViewshedCell> cells(1600, outside);
  for (std::size_t r = 18; r < 22; ++r)
    for (std::size_t c = 18; c < 22; ++c) cells[r * 40 + c] = seen;
  const std::vector<Vec2> observer = {{20, 20}};
  const auto canvas = drawViewshedMap(slopes(), cells, {}, observer, {.width = 900, .title = "T"});
  ASSERT_TRUE(canvas);
  int warm = 0, red = 0;
  for (int y = 84; y < 484; ++y)
    for (int x = 44; x < 444; ++x) {
      const Rgb c = canvas->pixel(x, y);
      warm += c.r > c.b + 100 && c.g > 120 ? 1 : 0;
      red += c == Rgb{200, 30, 40} ? 1 : 0;
    }
  EXPECT_GT(warm, 400 * 400 / 3) << "a window about the answers fills the map";
  EXPECT_GT(red, 60) << "the observer";
  const auto plain = drawViewshedMap(slopes(), cells, {}, observer, {.width = 900, .isDecorated = false});
  ASSERT_TRUE(plain);
  EXPECT_LT(plain->height(), canvas->height() + 200);
}

TEST(ViewshedMap, NumbersSeveralObservers) {
  const std::vector<ViewshedCell> cells(1600, seen);
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec2> one = {{10, 20}}, two = {{10, 20}, {kNowhere, kNowhere}};
  const auto ink = [&](const std::vector<Vec2>& observers) {
    const auto canvas = drawViewshedMap(slopes(), cells, {}, observers, {.width = 900, .title = "T"});
    EXPECT_TRUE(canvas);
    int dark = 0;
    for (int y = 84; y < 484; ++y)
      for (int x = 44; x < 444; ++x) dark += canvas->pixel(x, y) == Rgb{40, 44, 52} ? 1 : 0;
    return dark;
  };
  EXPECT_EQ(ink(one), ink({})) << "the only one needs no number";
  EXPECT_GT(ink(two), ink(one) + 10);
}

TEST(ViewshedMap, SaysOnWhatEarthItWasComputed) {
  EXPECT_EQ(earthWords({}, false, 0), "over a plane Earth, without refraction");
  EXPECT_EQ(earthWords({}, true, 0), "over the ellipsoid of radius 6378 km, without refraction");
  EXPECT_EQ(earthWords({}, true, 0.25),
            "over the ellipsoid of radius 6378 km, refraction 0.25: as over 8504 km");
}

}  // namespace
}  // namespace arete
