// SPDX-License-Identifier: GPL-3.0-or-later
// Maps of signed errors: colours, extremes, refusals.
#include "viewer/map/error_map.h"

#include <gtest/gtest.h>
#include <cmath>
#include <cstdlib>

#include "viewer/color/color_tables.h"
#include "viewer/picture_fixture.h"

namespace arete {
namespace {

using test::field;
using test::kNone;
using test::located;

TEST(ErrorMap, PaintsZeroExtremesAndNodata) {
  // Four quarters: -8 m, +8 m, 0, none.
  const auto errors = located(field(60, 40,
                                    [](double c, double r) {
                                      if (r < 20) return c < 30 ? -8.0 : 8.0;
                                      return c < 30 ? 0.0 : kNone;
                                    }),
                              30);
  const ErrorMapOptions options = {.width = 800, .title = "Errors", .limit = 8};
  const auto layout = errorMapLayout(errors, options);
  const auto canvas = drawErrorMap(errors, options);
  ASSERT_TRUE(layout && canvas);
  EXPECT_EQ(canvas->width(), 800);
  const auto at = [&](double x, double y) {
    return canvas->pixel(int(layout->map.left + layout->map.width * x),
                         int(layout->map.top + layout->map.height * y));
  };
  const ColorMap& colors = colorTable("difference");
  const Rgb lowest = colors.at(-1).opaque(), highest = colors.at(1).opaque();
  EXPECT_EQ(at(0.25, 0.25), lowest);
  EXPECT_EQ(at(0.75, 0.25), highest);
  EXPECT_EQ(at(0.25, 0.75), colors.at(0).opaque());
  const Rgb none = at(0.75, 0.75);
  EXPECT_TRUE(none.r == 190 && none.g == 191 && none.b == 194);

  // The frame covers the outermost row of the bar.
  const Rect bar = layout->colorBar;
  const int middle = int(bar.left + bar.width / 2);
  const auto near = [](Rgb a, Rgb b) {
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) <= 16;
  };
  EXPECT_TRUE(near(canvas->pixel(middle, int(bar.top) + 2), highest));
  EXPECT_TRUE(near(canvas->pixel(middle, int(bar.bottom()) - 3), lowest));
}

TEST(ErrorMap, ShowsALoneExtremeHoweverFarReduced) {
  const auto errors = located(
      field(2001, 1001, [](std::uint32_t c, std::uint32_t r) { return c == 777 && r == 333 ? 5.0 : 0.0; }),
      1);
  const ErrorMapOptions options = {.width = 640};
  const auto canvas = drawErrorMap(errors, options);
  const auto layout = errorMapLayout(errors, options);
  ASSERT_TRUE(canvas && layout);
  EXPECT_DOUBLE_EQ(layout->limit, 5);
  int found = 0;
  for (int y = int(layout->map.top) + 1; y < int(layout->map.bottom()) - 1; ++y) {
    for (int x = int(layout->map.left) + 1; x < int(layout->map.right()) - 1; ++x)
      found += canvas->pixel(x, y) == colorTable("difference").at(1).opaque();
  }
  EXPECT_EQ(found, 1);
}

TEST(ErrorMap, RefusesWhatItCannotDraw) {
  EXPECT_EQ(drawErrorMap(field(5, 5, [](double, double) { return kNone; })).error().code,
            ErrorCode::invalidData);
  EXPECT_EQ(drawErrorMap(field(5, 5, [](double, double) { return 1.0; }), {.limit = -1}).error().code,
            ErrorCode::invalidData);
  EXPECT_EQ(drawErrorMap(field(5, 1, [](double, double) { return 1.0; })).error().code,
            ErrorCode::degenerate);
  EXPECT_EQ(drawErrorMap(field(5, 5, [](double, double) { return 1.0; }), {.width = 100}).error().code,
            ErrorCode::usage);
}

}  // namespace
}  // namespace arete
