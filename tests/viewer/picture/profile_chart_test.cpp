// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/picture/profile_chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace arete {
namespace {

/// 100 high over 4 km, but for a wall in the middle and a gap behind it.
Profile wall() {
  Profile profile;
  profile.length = 4000;
  profile.gapMetres = 800;
  const auto at = [](double s, double z, bool joined = true) { return ProfileVertex{s, {s, 0}, z, joined}; };
  profile.vertices = {at(0, 100, false), at(1900, 100),        at(2000, 160), at(2100, 100),
                      at(2200, 100),     at(3000, 100, false), at(4000, 100)};
  return profile;
}

SightLine lineAt(double height) {
  SightTrack track;
  track.points = {{{0, 0}, 0}, {{4000, 0}, 4000}};
  return {track, height, height};
}

int pixelsLike(const Canvas& canvas, Rgb color) {
  int count = 0;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x) count += canvas.pixel(x, y) == color;
  return count;
}

constexpr Rgb kGround = {196, 186, 168}, kGap = {238, 238, 240}, kClear = {0, 140, 90},
              kBlocked = {205, 50, 30}, kAssumed = {118, 122, 132};

TEST(ProfileChart, ShowsTheGroundAndItsGaps) {
  const auto canvas = drawProfile(wall(), std::nullopt, {.width = 800, .height = 400, .unit = "m"});
  ASSERT_TRUE(canvas) << canvas.error().describe();
  EXPECT_GT(pixelsLike(*canvas, kGround), 5000);
  // A fifth of the width is a gap, from top to bottom.
  EXPECT_NEAR(double(pixelsLike(*canvas, kGap)), 0.2 * (800 - 140) * 300, 0.1 * (800 - 140) * 300);
  EXPECT_EQ(pixelsLike(*canvas, kClear), 0);
}

TEST(ProfileChart, ShowsWhereTheLineIsCutOff) {
  const SightLine low = lineAt(130), high = lineAt(200);
  SightAnswer blocked;
  blocked.verdict = SightVerdict::blocked;
  blocked.obstruction = SightPlace{1950, {1950, 0}, 130, 130};
  const auto one = drawProfile(wall(), ProfileSight{low, blocked}, {.title = "T", .subtitle = "S"});
  ASSERT_TRUE(one);
  EXPECT_GT(pixelsLike(*one, kClear), 300);
  EXPECT_GT(pixelsLike(*one, kBlocked), 100);
  const auto other = drawProfile(wall(), ProfileSight{high, {}}, {.title = "T", .subtitle = "S"});
  ASSERT_TRUE(other);
  EXPECT_GT(pixelsLike(*other, kClear), 600);
  EXPECT_EQ(pixelsLike(*other, kBlocked), 0);
  // The zone takes paper's colour away about the line.
  ProfileSight radio{high, {}};
  radio.wavelength = 1;
  const auto zone = drawProfile(wall(), radio, {.title = "T", .subtitle = "S"});
  ASSERT_TRUE(zone);
  EXPECT_LT(pixelsLike(*zone, {255, 255, 255}), pixelsLike(*other, {255, 255, 255}));
}

TEST(ProfileChart, DrawsTheLineOverAGapUnlikeTheFreeLine) {
  const SightLine high = lineAt(200);
  Profile whole = wall();
  whole.vertices[5].isJoined = true;
  whole.gapMetres = 0;
  const auto over = drawProfile(wall(), ProfileSight{high, {}}, {.title = "T"});
  const auto none = drawProfile(whole, ProfileSight{high, {}}, {.title = "T"});
  ASSERT_TRUE(over && none);
  EXPECT_LT(pixelsLike(*over, kClear), 0.85 * pixelsLike(*none, kClear));
  EXPECT_GT(pixelsLike(*over, kAssumed), 100);
  EXPECT_EQ(pixelsLike(*none, kAssumed), 0);
}

TEST(ProfileChart, DrawsExtremeShapesWithTheirLegends) {
  const auto at = [](double s, double z, bool joined = true) { return ProfileVertex{s, {s, 0}, z, joined}; };
  const auto profile = [](double length, std::vector<ProfileVertex> vertices) {
    Profile made;
    made.length = length;
    made.vertices = std::move(vertices);
    return made;
  };
  const std::vector<Profile> shapes = {
      profile(4000, {at(0, 0, false), at(4000, 0)}),                              // flat
      profile(4000, {at(0, 4321.2, false), at(2000, 4321.8), at(4000, 4321.2)}),  // slight, and high
      profile(4000, {at(0, 0, false), at(1999, 0), at(2000, 9000), at(2001, 0), at(4000, 0)}),  // a spike
      profile(1e-3, {at(0, 5, false), at(1e-3, 5.1)}),
      profile(2e7, {at(0, -9000, false), at(2e7, 8000)}),
      profile(4000, {at(1990, 7, false), at(2010, 7)}),  // nearly all void
      profile(4000, {at(2000, 7, false)}),               // one place
  };
  for (std::size_t i = 0; i < shapes.size(); ++i)
    for (const auto& [width, height] : {std::pair{1400, 700}, {640, 400}, {320, 240}}) {
      SCOPED_TRACE(i);
      const auto plain =
          drawProfile(shapes[i], std::nullopt, {.width = width, .height = height, .unit = "m"});
      ASSERT_TRUE(plain) << plain.error().describe();
      SightTrack track;
      track.points = {{{0, 0}, 0}, {{shapes[i].length, 0}, shapes[i].length}};
      const SightLine line{track, shapes[i].vertices[0].height + 2, shapes[i].vertices[0].height + 2};
      SightAnswer blocked;
      const double half = shapes[i].length / 2;
      blocked.obstruction = SightPlace{half, {half, 0}, line.height(half), line.height(half)};
      const auto sight = drawProfile(shapes[i], ProfileSight{line, blocked},
                                     {.width = width, .height = height, .title = "T", .subtitle = "S"});
      ASSERT_TRUE(sight) << sight.error().describe();
      // Over a void the line is grey.
      EXPECT_GT(pixelsLike(*sight, kClear) + 2 * pixelsLike(*sight, kAssumed), 50);
      EXPECT_GT(pixelsLike(*sight, kBlocked), 20);
    }
}

TEST(ProfileChart, RefusesWhatCannotBeDrawn) {
  EXPECT_EQ(drawProfile(wall(), std::nullopt, {.width = 100}).error().code, ErrorCode::usage);
  EXPECT_EQ(drawProfile({}, std::nullopt).error().code, ErrorCode::degenerate);
}

}  // namespace
}  // namespace arete
