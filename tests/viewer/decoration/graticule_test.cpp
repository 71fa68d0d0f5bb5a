// SPDX-License-Identifier: GPL-3.0-or-later
// Lines against the places of the pixels: every vertex lies on its line, and no line is missing.
#include "viewer/decoration/graticule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "viewer/decoration_fixture.h"

namespace arete {
namespace {

using namespace test;

double distanceTo(const GraticuleLine& line, Vec2 p) {
  double least = 1e9;
  for (const auto& part : line.parts)
    for (std::size_t i = 1; i < part.size(); ++i) {
      const Vec2 a = part[i - 1], way = part[i] - a;
      const double t = std::clamp(dot(p - a, way) / std::max(dot(way, way), 1e-12), 0.0, 1.0);
      const Vec2 near = a + way * t;
      least = std::min(least, std::hypot(near.x - p.x, near.y - p.y));
    }
  return least;
}

double turned(double degrees) {
  return std::abs(degrees - 360 * std::round(degrees / 360));
}

/// The distance between neighbouring lines; 0 if there are no two.
double stepOf(const std::vector<GraticuleLine>& lines, bool isMeridian) {
  double step = 0;
  for (const auto& a : lines)
    for (const auto& b : lines) {
      if (a.isMeridian != isMeridian || b.isMeridian != isMeridian || &a == &b) continue;
      const double gap = isMeridian ? turned(a.degrees - b.degrees) : std::abs(a.degrees - b.degrees);
      if (gap > 1e-12 && (step == 0 || gap < step)) step = gap;
    }
  return step;
}

void check(const PictureGround& ground, const std::string& what) {
  SCOPED_TRACE(what);
  const auto lines = graticuleOf(ground, 120);
  ASSERT_FALSE(lines.empty());
  std::set<std::pair<bool, std::string>> labels;
  for (const GraticuleLine& line : lines) {
    EXPECT_TRUE(labels.insert({line.isMeridian, line.label}).second) << line.label << " is there twice";
    for (const auto& part : line.parts)
      for (const Vec2 p : part) {
        const Rect& f = ground.frame();
        if (p.x < f.left || p.x > f.right() || p.y < f.top || p.y > f.bottom()) continue;
        const auto place = ground.lonLatAt(p);
        ASSERT_TRUE(place) << line.label;
        const double off =
            line.isMeridian ? turned(place->x - line.degrees) : std::abs(place->y - line.degrees);
        // Near a pole a hair's breadth is many degrees.
        if (std::abs(place->y) < 89.9) {
          EXPECT_LT(off, 1e-6) << line.label;
        }
      }
  }
  // Between two pixels of different sides of a line there is the line.
  const Rect& f = ground.frame();
  for (const bool isMeridian : {true, false}) {
    const double step = stepOf(lines, isMeridian);
    if (step == 0) continue;
    for (double y = f.top + 0.5; y < f.bottom(); y += 37)
      for (double x = f.left + 0.5; x + 1 < f.right(); x += 1) {
        const auto a = ground.lonLatAt({x, y}), b = ground.lonLatAt({x + 1, y});
        if (!a || !b || std::abs(a->y) > 89 || std::abs(b->y) > 89) continue;
        const double from = isMeridian ? a->x : a->y, to = isMeridian ? b->x : b->y;
        if (std::abs(from - to) > step || std::floor(from / step) == std::floor(to / step)) continue;
        const double at = std::floor(std::max(from, to) / step) * step;
        const bool isDrawn = std::ranges::any_of(lines, [&](const GraticuleLine& line) {
          const double off = isMeridian ? turned(line.degrees - at) : std::abs(line.degrees - at);
          return line.isMeridian == isMeridian && off < step / 1000 && distanceTo(line, {x + 0.5, y}) < 1.5;
        });
        ASSERT_TRUE(isDrawn) << (isMeridian ? "meridian " : "parallel ") << at << " at " << x << ", " << y;
      }
  }
}

TEST(Graticule, IsCompleteAndExactInMapsOfAllKinds) {
  check(pictureOf(mapAbout("EPSG:32633", {500000, 5000000}, 30)), "UTM");
  check(pictureOf(mapAbout("EPSG:32633", {200000, 7900000}, 5000)), "UTM, wide");
  check(pictureOf(mapAbout("EPSG:3857", {1.9e7, 5e6}, 20000)), "Web Mercator to the seam");
  check(pictureOf(mapAbout("EPSG:3035", {4321000, 3210000}, 20000)), "equal area");
  check(pictureOf(mapAbout("EPSG:3413", {0, 0}, 50000)), "around the north pole");
  check(pictureOf(mapAbout("EPSG:3031", {300000, -200000}, 20000)), "around the south pole");
  check(pictureOf(mapAbout("EPSG:3413", {1500000, 900000}, 2000)), "beside the north pole");
  check(pictureOf(degreesAbout({10, 47}, 0.01)), "degrees");
  check(pictureOf(degreesAbout({200, -30}, 0.5)), "degrees past half a turn");
}

TEST(Graticule, CrossesTheAntimeridianOnce) {
  // Mercator of the Pacific: its middle is at 150 degrees east.
  const PictureGround pacific = pictureOf(mapAbout("EPSG:3832", {3339584, 1e6}, 40000));
  check(pacific, "Pacific");
  const auto lines = graticuleOf(pacific, 120);
  const auto count = [&](const std::string& label) {
    return std::ranges::count(lines, label, &GraticuleLine::label);
  };
  EXPECT_EQ(count("180\u00b0"), 1);
  EXPECT_EQ(count("175\u00b0 E"), 1);
  EXPECT_EQ(count("175\u00b0 W"), 1);
}

TEST(Graticule, HasRoundStepsAtEveryScale) {
  const unsigned seed = 20261128;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (int i = 0; i < 60; ++i) {
    const double cell = std::pow(10, std::uniform_real_distribution<>(-7, 0)(random));
    const double latitude = std::uniform_real_distribution<>(-60, 60)(random);
    const auto lines = graticuleOf(pictureOf(degreesAbout({33.3, latitude}, cell)), 120);
    for (const bool isMeridian : {true, false}) {
      const auto number = std::ranges::count(lines, isMeridian, &GraticuleLine::isMeridian);
      EXPECT_GE(number, 2) << cell << " at " << latitude;
      EXPECT_LE(number, 31) << cell << " at " << latitude;
    }
    std::set<std::pair<bool, std::string>> labels;
    for (const auto& line : lines)
      EXPECT_TRUE(labels.insert({line.isMeridian, line.label}).second) << line.label;
  }
}

TEST(Graticule, WritesAnglesForPeople) {
  EXPECT_EQ(angleText(118.25, 0.25, true), "118\u00b0 15\u2032 E");
  EXPECT_EQ(angleText(-118, 1, true), "118\u00b0 W");
  EXPECT_EQ(angleText(190, 10, true), "170\u00b0 W");
  EXPECT_EQ(angleText(-180, 10, true), "180\u00b0");
  EXPECT_EQ(angleText(0, 10, true), "0\u00b0");
  EXPECT_EQ(angleText(0, 10, false), "0\u00b0");
  EXPECT_EQ(angleText(-34.5, 0.5, false), "34\u00b0 30\u2032 S");
  EXPECT_EQ(angleText(34 + 59.0 / 60 + 59.99999999 / 3600, 5.0 / 3600, false),
            "35\u00b0 00\u2032 00\u2033 N");
  EXPECT_EQ(angleText(1.0 / 3600 * 0.5, 0.5 / 3600, false), "0\u00b0 00\u2032 00.5\u2033 N");
  EXPECT_NEAR(roundAngleDown(0.3), 0.25, 1e-9 + 0.05) << "20 minutes are a third of a degree";
  EXPECT_EQ(roundAngleDown(100), 90);
  EXPECT_EQ(roundAngleDown(7), 5);
}

TEST(Graticule, IsNotDrawnWithoutPlaces) {
  EXPECT_TRUE(graticuleOf(pictureOf(mapAbout("", {0, 0}, 30)), 120).empty());
  EXPECT_TRUE(
      graticuleOf(pictureOf(mapAbout("LOCAL_CS[\"site\",UNIT[\"metre\",1]]", {0, 0}, 30)), 120).empty());
}

TEST(Graticule, StaysOnTheGroundOfAView) {
  const PictureGround view = obliqueView("EPSG:32633", -30);
  const auto lines = graticuleOf(view, 120);
  ASSERT_FALSE(lines.empty());
  for (const auto& line : lines)
    for (const auto& part : line.parts)
      for (const Vec2 p : part) {
        if (p.x < 0 || p.x > 800 || p.y < 0 || p.y > 600) continue;
        const auto place = view.lonLatAt(p);
        ASSERT_TRUE(place) << line.label << " is drawn into the sky";
        EXPECT_NEAR(line.isMeridian ? place->x : place->y, line.degrees, 1e-6);
      }
}

TEST(Graticule, LabelsStayInThePictureAndCoverNothing) {
  auto canvas = Canvas::create(860, 860, {200, 60, 60});
  ASSERT_TRUE(canvas);
  const PictureGround ground = pictureOf(mapAbout("EPSG:32633", {500000, 5000000}, 30));
  const Rect taken = {30, 420, 800, 400};
  drawGraticuleLabels(*canvas, ground, graticuleOf(ground, 120), {{taken}}, 13);
  int marked = 0;
  for (int y = 0; y < 860; ++y)
    for (int x = 0; x < 860; ++x) {
      const bool isMarked = !(canvas->pixel(x, y) == Rgb{200, 60, 60});
      marked += isMarked ? 1 : 0;
      if (isMarked && (y > 422 || y < 20 || x < 30 || x > 830)) FAIL() << x << ", " << y;
    }
  EXPECT_GT(marked, 500);
}

}  // namespace
}  // namespace arete
