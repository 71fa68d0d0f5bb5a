// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/picture/chart_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace arete {
namespace {

/// Whether a line enters a rectangle: by walking along it.
bool enters(const Rect& room, const std::vector<Vec2>& line) {
  for (std::size_t i = 1; i < line.size(); ++i)
    for (int k = 0; k <= 400; ++k) {
      const Vec2 p = line[i - 1] + (line[i] - line[i - 1]) * (k / 400.0);
      if (p.x > room.left && p.x < room.right() && p.y > room.top && p.y < room.bottom()) return true;
    }
  return false;
}

TEST(ChartLabels, CrossNeitherLinesNorEachOther) {
  const unsigned seed = 60;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<> height(40, 360);
  const Rect plot = {100, 20, 800, 380};
  const Canvas canvas = *Canvas::create(1000, 450);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    // A skyline and a line of sight over it.
    std::vector<Vec2> ground, sight = {{100, height(random)}, {900, height(random)}};
    for (int x = 0; x <= 10; ++x) ground.push_back({100 + 80.0 * x, height(random)});
    ChartLabels labels(plot);
    labels.avoid(ground);
    labels.avoid(sight);
    labels.add(ground[std::size_t(i) % 11], "obstruction at 1234 m", {205, 50, 30});
    labels.add(sight[0], "from, at 512 m", {});
    labels.add(sight[1], "to, at 530 m", {});
    const auto placed = labels.place(canvas);
    ASSERT_EQ(placed.size(), 3u);
    int free = 0;
    for (const auto& label : placed) {
      EXPECT_GE(label.room.left, plot.left);
      EXPECT_LE(label.room.right(), plot.right());
      free += label.isFree ? 1 : 0;
      if (!label.isFree) continue;
      EXPECT_FALSE(enters(label.room, ground)) << label.text;
      EXPECT_FALSE(enters(label.room, sight)) << label.text;
    }
    EXPECT_EQ(free, 3) << "there is room for all";
  }
}

TEST(ChartLabels, AreDrawnWithoutAnyRoom) {
  Canvas canvas = *Canvas::create(60, 40);
  ChartLabels labels({5, 5, 50, 30});
  labels.avoid(std::vector<Vec2>{{0, 20}, {60, 20}});
  labels.add({30, 20}, "a text that is far too long", {1, 2, 3});
  EXPECT_FALSE(labels.place(canvas)[0].isFree);
  labels.draw(canvas);
}

TEST(ChartKeys, TakeAsManyRowsAsTheyNeed) {
  const Canvas canvas = *Canvas::create(10, 10);
  std::vector<ChartKey> keys(4, {"line of sight", {0, 0, 0}, ChartKey::Shape::line});
  const double one = chartKeysHeight(canvas, keys, 2000), many = chartKeysHeight(canvas, keys, 100);
  EXPECT_EQ(many, 4 * one);
}

}  // namespace
}  // namespace arete
