// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/map/viewshed_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace arete {
namespace {

RasterHeightfield plain(std::uint32_t columns, std::uint32_t rows) {
  RasterHeightfield field;
  field.columns = columns;
  field.rows = rows;
  field.heights.assign(std::size_t{columns} * rows, 100);
  return field;
}

double share(const Canvas& canvas, bool (*isLike)(Rgb)) {
  double count = 0;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x) count += isLike(canvas.pixel(x, y)) ? 1 : 0;
  return count / (double(canvas.width()) * canvas.height());
}

bool isWarm(Rgb c) {
  return c.r > c.b + 60 && c.g > c.b + 20;
}
bool isBlue(Rgb c) {
  return c.b > c.r + 40;
}

TEST(ViewshedMap, ColoursWhatIsSeenAndWhatIsUnknown) {
  const RasterHeightfield field = plain(40, 40);
  Viewshed viewshed;
  viewshed.columns = viewshed.rows = 40;
  viewshed.cells.assign(1600, ViewshedCell::hidden);
  viewshed.hidden = 1600;
  const auto dark = drawViewshedMap(field, viewshed, {5, 5}, {.width = 800});
  ASSERT_TRUE(dark) << dark.error().describe();
  EXPECT_LT(share(*dark, isWarm), 0.001);
  for (std::size_t i = 0; i < 800; ++i) viewshed.cells[i] = ViewshedCell::seen;
  for (std::size_t i = 800; i < 1200; ++i) viewshed.cells[i] = ViewshedCell::unknown;
  viewshed.seen = 800;
  viewshed.unknown = viewshed.hidden = 400;
  const auto light = drawViewshedMap(field, viewshed, {5, 35}, {.width = 800});
  ASSERT_TRUE(light);
  const double warm = share(*light, isWarm), blue = share(*light, isBlue);
  EXPECT_GT(warm, 0.2);
  EXPECT_NEAR(warm / blue, 2, 0.3);
}

}  // namespace
}  // namespace arete
