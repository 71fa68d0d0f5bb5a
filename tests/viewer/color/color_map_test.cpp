// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of values between, at and beyond stops, against a search through all stops in double precision.
#include "viewer/color/color_map.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "datasets/random.h"
#include "viewer/color_oracle.h"

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Rgba kRed{255, 0, 0}, kGreen{0, 255, 0}, kBlue{0, 0, 255, 128}, kNothing{0, 0, 0, 0};

ColorMap made(std::vector<ColorStop> stops, ColorsBetween between = ColorsBetween::linear) {
  ColorMapOptions options;
  options.between = between;
  return ColorMap::make(std::move(stops), options).value();
}

TEST(ColorMap, MixesLinearlyAsGdaldemDoes) {
  // gdaldem color-relief of GDAL 3.6 on 2.5, 5 and 12.5 with "0 aqua, 50 brown, 100 indigo" of per cent.
  const ColorMap map = made({{0, {0, 191, 191}}, {12.5, {191, 127, 63}}, {25, {0, 127, 255}}});
  EXPECT_EQ(map.at(5), (Rgba{76, 165, 140}));
  EXPECT_EQ(map.at(0), (Rgba{0, 191, 191}));
  EXPECT_EQ(map.at(12.5), (Rgba{191, 127, 63}));
  EXPECT_EQ(map.at(-1), (Rgba{0, 191, 191}));
  EXPECT_EQ(map.at(26), (Rgba{0, 127, 255}));
}

TEST(ColorMap, StepsWhereTwoStopsHaveOneValue) {
  const ColorMap map = made({{0, kRed}, {10, kRed}, {10, kGreen}, {20, kGreen}});
  EXPECT_EQ(map.at(std::nextafter(10.0f, 0.0f)), kRed);
  EXPECT_EQ(map.at(10), kGreen);
  EXPECT_EQ(map.at(15), kGreen);
}

TEST(ColorMap, ExtendsColoursToInfiniteStops) {
  const ColorMap map = made({{-kInfinity, kRed}, {10, kGreen}, {kInfinity, kBlue}});
  EXPECT_EQ(map.at(-kInfinity), kRed);
  EXPECT_EQ(map.at(-1e30), kGreen);
  EXPECT_EQ(map.at(10), kGreen);
  EXPECT_EQ(map.at(1e30), kGreen);
  EXPECT_EQ(map.at(kInfinity), kBlue);
  const ColorMap classes = made({{10, kRed}, {kInfinity, kGreen}}, ColorsBetween::discrete);
  EXPECT_EQ(classes.at(10), kRed);
  EXPECT_EQ(classes.at(10.001), kGreen);
  EXPECT_EQ(classes.at(kInfinity), kGreen);
  EXPECT_EQ(classes.at(-kInfinity), kRed);
}

TEST(ColorMap, HoldsClassesUpToAndWithTheirStops) {
  const ColorMap map = made({{10, kRed}, {20, kGreen}}, ColorsBetween::discrete);
  EXPECT_EQ(map.at(-5), kRed);
  EXPECT_EQ(map.at(10), kRed);
  EXPECT_EQ(map.at(10.5), kGreen);
  EXPECT_EQ(map.at(20), kGreen);
  EXPECT_EQ(map.at(20.5), kNothing);
}

TEST(ColorMap, GivesExactColoursToStopsOnly) {
  ColorMapOptions options;
  options.between = ColorsBetween::exact;
  options.outside = kBlue;
  const ColorMap map = ColorMap::make({{0.1, kRed}, {20, kGreen}}, options).value();
  EXPECT_EQ(map.at(0.1), kRed);
  EXPECT_EQ(map.at(0.1f), kRed);
  EXPECT_EQ(map.at(20), kGreen);
  EXPECT_EQ(map.at(19.99), kBlue);
  EXPECT_EQ(map.at(kInfinity), kBlue);
  EXPECT_EQ(made({{1, kRed}}, ColorsBetween::exact).at(2), kNothing);
}

TEST(ColorMap, TakesTheUpperStopHalfway) {
  const ColorMap map = made({{0, kRed}, {10, kGreen}}, ColorsBetween::nearest);
  EXPECT_EQ(map.at(4.99), kRed);
  EXPECT_EQ(map.at(5), kGreen);
  EXPECT_EQ(map.at(-100), kRed);
  EXPECT_EQ(map.at(100), kGreen);
}

TEST(ColorMap, RefusesNoStopsAndNoNumbers) {
  EXPECT_FALSE(ColorMap::make({}));
  EXPECT_FALSE(ColorMap::make({{std::nan(""), kRed}}));
}

TEST(ColorMap, MovesToAnotherRangeAndKeepsInfiniteEnds) {
  const ColorMap map = made({{-kInfinity, kBlue}, {0, kRed}, {1, kGreen}}).over(100, 300);
  EXPECT_EQ(map.low(), 100);
  EXPECT_EQ(map.high(), 300);
  EXPECT_EQ(map.at(200), (Rgba{128, 128, 0}));
  EXPECT_EQ(map.stops().front().value, -kInfinity);
  EXPECT_EQ(made({{5, kRed}}).over(7, 9).at(1000), kRed);
  EXPECT_EQ(map.withNodata(kRed).at(std::nan("")), kRed);
}

TEST(ColorMap, MovesItsStopsToAGrainInTheirOrder) {
  const ColorMap map = made({{-kInfinity, kBlue},
                             {0, kRed},
                             {std::nextafter(0.0f, 1.0f), kGreen},
                             {0.3, kGreen},
                             {0.3, kBlue},
                             {7, kRed}})
                           .onGrain(0.25);
  EXPECT_EQ(map.stops().front().value, -kInfinity);
  EXPECT_EQ(map.at(0), kRed);
  EXPECT_EQ(map.at(0.25), kGreen) << "the next float is one grain on";
  EXPECT_EQ(map.at(0.5), kBlue) << "a step stays one";
  EXPECT_EQ(map.at(7), kRed);
}

TEST(ColorMap, KeepsFiniteColoursBetweenTheLargestFloats) {
  const ColorMap map = made({{-3e38, kRed}, {3e38, kGreen}});
  EXPECT_EQ(map.at(0), (Rgba{128, 128, 0}));
  EXPECT_EQ(map.at(1e300), kGreen);
}

/// What a map says, by a walk over all stops in double precision: the colours that are right, since a
/// rounding may fall either way.
bool agrees(const ColorMap& map, double asked, Rgba got) {
  const double v = float(asked);
  const auto& stops = map.stops();
  const ColorStop *last = nullptr, *next = nullptr;
  for (const ColorStop& stop : stops) {
    if (stop.value <= v) last = &stop;
    if (stop.value > v && !next) next = &stop;
  }
  if (last && last->value == v) return got == last->color;
  switch (map.between()) {
    case ColorsBetween::exact:
      return got == kNothing;
    case ColorsBetween::discrete:
      return got == (next ? next->color : kNothing);
    case ColorsBetween::nearest:
      if (!last || !next) return got == (last ? last : next)->color;
      return got == (v - last->value < next->value - v ? last : next)->color;
    case ColorsBetween::linear:
      break;
  }
  if (!last || !next) return got == (last ? last : next)->color;
  const double part = (v - last->value) / (next->value - last->value);
  const auto isNear = [&](int a, int b, int c) { return std::abs(a + (b - a) * part - c) <= 0.51; };
  const Rgba a = last->color, b = next->color;
  return isNear(a.r, b.r, got.r) && isNear(a.g, b.g, got.g) && isNear(a.b, b.b, got.b) &&
         isNear(a.a, b.a, got.a);
}

TEST(ColorMap, AgreesWithAWalkOverItsStops) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto byte = [&] { return std::uint8_t((random.next() % 256)); };
    std::vector<ColorStop> stops;
    for (std::uint64_t i = 0, n = 1 + (random.next() % 12); i < n; ++i)
      stops.push_back({random.between(-1000, 1000), {byte(), byte(), byte(), byte()}});
    for (const auto between :
         {ColorsBetween::linear, ColorsBetween::discrete, ColorsBetween::nearest, ColorsBetween::exact}) {
      const ColorMap map = made(stops, between);
      for (int i = 0; i < 300; ++i) {
        const double v = random.between(-1200, 1200);
        EXPECT_TRUE(agrees(map, v, map.at(v))) << v;
      }
      for (const ColorStop& stop : map.stops()) EXPECT_EQ(map.at(stop.value), stop.color);
    }
  }
}

}  // namespace
}  // namespace arete
