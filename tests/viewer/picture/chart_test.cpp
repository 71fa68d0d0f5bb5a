// SPDX-License-Identifier: GPL-3.0-or-later
// Charts with two logarithmic axes.
#include "viewer/picture/chart.h"

#include <gtest/gtest.h>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "viewer/picture_fixture.h"

namespace arete {
namespace {

TEST(Chart, DrawsEverySeriesInItsColor) {
  const std::vector<ChartSeries> series = {{"one", {{1, 1000}, {10, 100}, {100, 10}}, false},
                                           {"two", {{1, 500}, {100, 5}}, true}};
  const auto canvas =
      drawLogLogChart(series, {.width = 640, .height = 480, .title = "T", .xLabel = "x", .yLabel = "y"});
  ASSERT_TRUE(canvas);
  EXPECT_EQ(canvas->width(), 640);
  EXPECT_EQ(canvas->height(), 480);
  std::set<std::tuple<int, int, int>> colors;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const Rgb c = canvas->pixel(x, y);
      colors.insert({c.r, c.g, c.b});
    }
  }
  EXPECT_TRUE(colors.contains({0, 114, 178}));
  EXPECT_TRUE(colors.contains({213, 94, 0}));
}

TEST(Chart, DrawsOnePointAndNone) {
  EXPECT_TRUE(drawLogLogChart({}));
  const std::vector<ChartSeries> series = {{"one point", {{5, 7}}}, {"none", {}}};
  EXPECT_TRUE(drawLogLogChart(series));
}

TEST(Chart, NamesTheSeriesThatHasNoLogarithm) {
  const std::vector<ChartSeries> series = {{"good", {{1, 1}}}, {"bad", {{1, 1}, {0, 5}}}};
  const auto canvas = drawLogLogChart(series);
  ASSERT_FALSE(canvas);
  EXPECT_EQ(canvas.error().culprit, "bad");
}

}  // namespace
}  // namespace arete
