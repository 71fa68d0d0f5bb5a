// SPDX-License-Identifier: GPL-3.0-or-later
// Where a page puts its map, caption and scale bar.
#include "viewer/map/map_page.h"

#include <gtest/gtest.h>
#include <cmath>
#include <string>

#include "viewer/picture_fixture.h"

namespace arete {
namespace {

TEST(MapPage, GivesALongCaptionARowOfItsOwn) {
  const std::string longCaption(200, 'm');
  const auto brief = makeMapPage(60, 40, {}, {.width = 700, .caption = {"brief"}});
  const auto wordy = makeMapPage(60, 40, {}, {.width = 700, .caption = {longCaption}});
  ASSERT_TRUE(brief && wordy);
  EXPECT_GT(wordy->canvas.height(), brief->canvas.height());
  // However long the line, it ends at the margin.
  for (int y = 0; y < wordy->canvas.height(); ++y) {
    for (int x = 662; x < 700; ++x) ASSERT_EQ(wordy->canvas.pixel(x, y), (Rgb{255, 255, 255}));
  }
}

TEST(MapPage, HoldsTheWholeGridInsideThePage) {
  for (const auto& [columns, rows] : {std::pair{100u, 100u}, {2000u, 50u}, {50u, 2000u}, {2u, 2u}}) {
    const auto page = makeMapPage(columns, rows, {}, {.width = 900, .sideWidth = 120, .title = "Map"});
    ASSERT_TRUE(page) << page.error().describe();
    SCOPED_TRACE(columns);
    EXPECT_GE(page->map.left, 0);
    EXPECT_GE(page->map.top, 0);
    EXPECT_LE(page->map.right(), page->canvas.width());
    EXPECT_LE(page->map.bottom(), page->canvas.height());
    EXPECT_LE(page->canvas.width(), 900);
    EXPECT_GE(page->side.left, page->map.right()) << "the free space is beside the map";
    const Vec2 first = page->toPage(0, 0), last = page->toPage(columns - 1, rows - 1);
    for (const Vec2 corner : {first, last}) {
      EXPECT_GE(corner.x, page->map.left - 1);
      EXPECT_LE(corner.x, page->map.right() + 1);
      EXPECT_GE(corner.y, page->map.top - 1);
      EXPECT_LE(corner.y, page->map.bottom() + 1);
    }
  }
}

TEST(MapPage, RefusesANarrowPageAndAGridOfOneLine) {
  EXPECT_EQ(makeMapPage(10, 10, {}, {.width = 639}).error().code, ErrorCode::usage);
  EXPECT_EQ(makeMapPage(1, 10, {}, {}).error().code, ErrorCode::degenerate);
  EXPECT_EQ(makeMapPage(10, 1, {}, {}).error().code, ErrorCode::degenerate);
}

}  // namespace
}  // namespace arete
