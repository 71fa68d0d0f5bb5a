// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/decoration/legend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "viewer/color/color_tables.h"
#include "viewer/picture_fixture.h"

namespace arete {
namespace {

using namespace test;

Canvas paper() {
  return *Canvas::create(400, 900);
}

TEST(Legend, HasTheColoursOfItsMap) {
  for (const ColorTable& table : colorTables()) {
    SCOPED_TRACE(table.name);
    const ColorLegend legend = legendOf(table.map, "what", "m");
    ASSERT_TRUE(legend.scale);
    Canvas canvas = paper();
    const auto scales = drawLegends(canvas, std::span(&legend, 1), {20, 20});
    ASSERT_EQ(scales.size(), 1u);
    const Rect bar = scales[0].bar;
    for (int row = 0; row < int(bar.height); ++row) {
      const double value = scales[0].high - (scales[0].high - scales[0].low) * row / (bar.height - 1);
      for (const int x : {0, int(bar.width) - 1})
        ASSERT_EQ(canvas.pixel(int(bar.left) + x, int(bar.top) + row), table.map.at(value).opaque()) << row;
    }
    EXPECT_EQ(canvas.pixel(int(bar.left), int(bar.top)), table.map.at(table.map.high()).opaque());
  }
}

TEST(Legend, ShowsEveryShadeOfAShadedMap) {
  ColorLegend legend = legendOf(colorTable("height").over(0, 100), "height", "m");
  legend.scale->shade = [](Rgb color, double across) { return mix({0, 0, 0}, color, across); };
  Canvas canvas = paper();
  const Rect bar = drawLegends(canvas, std::span(&legend, 1), {20, 20})[0].bar;
  EXPECT_EQ(canvas.pixel(int(bar.left), int(bar.top) + 5), (Rgb{0, 0, 0}));
  EXPECT_EQ(canvas.pixel(int(bar.right()) - 1, int(bar.top)), legend.scale->map.at(100).opaque());
}

TEST(Legend, NamesTheClassesOfAMapOfClasses) {
  const double inf = std::numeric_limits<double>::infinity();
  const ColorMap exact =
      *ColorMap::make({{1, {10, 20, 30}, "water"}, {2, {40, 50, 60}}, {3, {70, 80, 90}, "rock"}},
                      {.between = ColorsBetween::exact});
  const ColorLegend classes = legendOf(exact, "cover");
  ASSERT_EQ(classes.classes.size(), 3u);
  EXPECT_EQ(classes.classes[0].label, "rock");
  EXPECT_EQ(classes.classes[1].label, "2");
  EXPECT_EQ(classes.classes[2].colors, (std::vector<Rgb>{{10, 20, 30}}));
  const ColorMap discrete = *ColorMap::make({{10, {1, 1, 1}}, {20, {2, 2, 2}}, {inf, {3, 3, 3}}},
                                            {.between = ColorsBetween::discrete});
  const ColorLegend steps = legendOf(discrete, "slope", "degrees");
  ASSERT_EQ(steps.classes.size(), 3u);
  EXPECT_EQ(steps.classes[0].label, "above 20");
  EXPECT_EQ(steps.classes[1].label, "10 to 20");
  EXPECT_EQ(steps.classes[2].label, "up to 10");
  Canvas canvas = paper();
  drawLegends(canvas, std::span(&classes, 1), {20, 20});
  for (const LegendClass& entry : classes.classes) {
    int count = 0;
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 200; ++x) count += canvas.pixel(x, y) == entry.colors[0] ? 1 : 0;
    EXPECT_GT(count, 200) << entry.label;
  }
}

TEST(Legend, TakesTheRoomThatItSaysAndCountsWhatHasNone) {
  ColorLegend legend{.title = "many"};
  for (int i = 0; i < 100; ++i) legend.classes.push_back({{Rgb{0, 0, 0}}, "class"});
  const LegendStyle style = {.maxHeight = 200};
  const Vec2 size = legendSize(std::span(&legend, 1), style);
  EXPECT_LE(size.y, 200);
  EXPECT_GT(size.y, 150);
  Canvas canvas = paper();
  drawLegends(canvas, std::span(&legend, 1), {10, 10}, style);
  for (int y = 0; y < 900; ++y)
    for (int x = 0; x < 400; ++x) {
      if (y <= 11 + size.y && x <= 12 + size.x) continue;
      ASSERT_EQ(canvas.pixel(x, y), (Rgb{255, 255, 255})) << x << " " << y;
    }
}

TEST(Legend, OfFlatGroundHasOneNumber) {
  const ColorLegend legend = legendOf(colorTable("height").over(7, 7), "height", "m");
  Canvas canvas = paper();
  EXPECT_EQ(drawLegends(canvas, std::span(&legend, 1), {20, 20}).size(), 1u);
  const ColorLegend none;
  EXPECT_TRUE(drawLegends(canvas, std::span(&none, 1), {20, 20}).empty());
}

}  // namespace
}  // namespace arete
