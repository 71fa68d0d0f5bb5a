// SPDX-License-Identifier: GPL-3.0-or-later
// Every colour map of the table, sampled finely, as all eyes see it.
#include "viewer/color/color_tables.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

#include "viewer/color_oracle.h"

namespace arete {
namespace {

using test::Eyes;
using test::kAllEyes;
using test::lightness;
using test::seenBy;

constexpr int kSamples = 10'000;

Rgb sampled(const ColorMap& map, int i) {
  return map.at(map.low() + (map.high() - map.low()) * i / kSamples).opaque();
}

TEST(ColorTables, OfSequencesAreMonotoneInLightness) {
  int seen = 0;
  for (const ColorTable& table : colorTables()) {
    if (table.kind != ColorTableKind::sequential) continue;
    ++seen;
    const double way = lightness(sampled(table.map, kSamples)) - lightness(sampled(table.map, 0));
    EXPECT_GT(std::abs(way), 45) << table.name;
    double before = lightness(sampled(table.map, 0));
    for (int i = 1; i <= kSamples; ++i) {
      const double now = lightness(sampled(table.map, i));
      ASSERT_GE((now - before) * way, 0) << table.name << " at " << i;
      // As far along in lightness as in value.
      EXPECT_NEAR(now, lightness(sampled(table.map, 0)) + way * i / kSamples, 2.5)
          << table.name << " at " << i;
      before = now;
    }
  }
  EXPECT_EQ(seen, 5);
}

TEST(ColorTables, OfSequencesStayInOrderForTheColourBlind) {
  for (const ColorTable& table : colorTables()) {
    if (table.kind != ColorTableKind::sequential) continue;
    for (const Eyes eyes : kAllEyes) {
      const double way = lightness(seenBy(eyes, sampled(table.map, kSamples))) -
                         lightness(seenBy(eyes, sampled(table.map, 0)));
      EXPECT_GT(std::abs(way), 40) << table.name;
      for (int i = 0; i + 500 <= kSamples; i += 100) {
        const double a = lightness(seenBy(eyes, sampled(table.map, i))),
                     b = lightness(seenBy(eyes, sampled(table.map, i + 500)));
        EXPECT_GT((b - a) * way, 0) << table.name << " at " << i << ", eyes " << int(eyes);
      }
    }
  }
}

TEST(ColorTables, OfDifferencesAreLightestInTheMiddleAndAlikeDarkAtBothEnds) {
  const ColorMap& map = colorTable("difference");
  EXPECT_EQ(map.low(), -1);
  EXPECT_EQ(map.high(), 1);
  for (int i = 1; i <= kSamples; ++i) {
    const double step = lightness(sampled(map, i)) - lightness(sampled(map, i - 1));
    ASSERT_GE(i <= kSamples / 2 ? step : -step, 0) << i;
  }
  EXPECT_NEAR(lightness(sampled(map, 0)), lightness(sampled(map, kSamples)), 7);
  for (const Eyes eyes : kAllEyes)
    for (const double value : {0.3, 0.6, 1.0})
      EXPECT_GT(colorDifference(seenBy(eyes, map.at(value).opaque()), seenBy(eyes, map.at(-value).opaque())),
                10)
          << value << ", eyes " << int(eyes);
}

TEST(ColorTables, OfDirectionsHaveOneLightnessAndNoSeam) {
  const ColorMap& map = colorTable("aspect");
  EXPECT_EQ(map.at(0), map.at(360));
  for (int i = 0; i <= kSamples; ++i) {
    EXPECT_NEAR(lightness(sampled(map, i)), 68, 0.8) << i;
    if (i > 0) {
      EXPECT_LT(colorDifference(sampled(map, i), sampled(map, i - 1)), 1.5);
    }
  }
  EXPECT_NEAR(lightness(kNoAspectColor), 68, 0.5);
  // Hues go once round: opposite directions are far apart, and all directions are far from none.
  for (int degrees = 0; degrees < 360; ++degrees) {
    EXPECT_GT(colorDifference(map.at(degrees).opaque(), map.at((degrees + 180) % 360).opaque()), 25)
        << degrees;
    EXPECT_GT(colorDifference(map.at(degrees).opaque(), kNoAspectColor), 10) << degrees;
  }
  // North and south, which the sun makes matter, stay apart for all eyes.
  for (const Eyes eyes : {Eyes::all, Eyes::noRed, Eyes::noGreen})
    EXPECT_GT(colorDifference(seenBy(eyes, map.at(0).opaque()), seenBy(eyes, map.at(180).opaque())), 10);
}

TEST(ColorTables, HaveNoHeightThatLooksLikeForestSnowWaterOrNoData) {
  const ColorMap& map = colorTable("height");
  for (int i = 0; i <= kSamples; i += 10) {
    const Rgb c = sampled(map, i);
    const Lab lab = labOf(c);
    EXPECT_GT(lab.a, -8) << "no green at " << i;
    EXPECT_GT(lab.b, -12) << "no blue at " << i;
    EXPECT_GT(colorDifference(c, {255, 255, 255}), 10) << "no snow at " << i;
    EXPECT_GT(colorDifference(c, kNodataColor), 10) << i;
    for (int k = 0; k <= kSamples; k += 200)
      EXPECT_GT(colorDifference(c, sampled(colorTable("depth"), k)), 10) << "no water at " << i;
  }
  for (int k = 0; k <= kSamples; k += 10)
    EXPECT_GT(colorDifference(kNodataColor, sampled(colorTable("depth"), k)), 10)
        << "a void is unlike a lake";
}

TEST(ColorTables, ShowASeaAtItsLevelAsSeaAndTheNextFloatAsLand) {
  const ColorMap map = heightColors(-40, 250, 0);
  const ColorMap &depths = colorTable("depth"), &heights = colorTable("height");
  EXPECT_EQ(map.at(0), depths.at(1));
  EXPECT_EQ(map.at(-40), depths.at(0));
  EXPECT_EQ(map.at(-4000), depths.at(0));
  EXPECT_EQ(map.at(std::nextafter(0.0f, 1.0f)), heights.at(0));
  EXPECT_EQ(map.at(0.01), heights.at(0.01 / 250));
  EXPECT_EQ(map.at(250), heights.at(1));
  EXPECT_EQ(map.at(std::nan("")), Rgba(kNodataColor));
  EXPECT_EQ(heightColors(0, 2000, 0).at(0), depths.at(1));
  EXPECT_EQ(heightColors(0, 2000, 0).at(-900), depths.at(1)) << "no depth is known";
  EXPECT_EQ(heightColors(0, 2000, 0).at(2000), heights.at(1));
  // A level above all of the land, and one below it.
  EXPECT_EQ(heightColors(10, 20, 110).at(20), depths.at(0.1));
  EXPECT_EQ(heightColors(10, 20, -100).at(10), heights.at(0));
  EXPECT_EQ(heightColors(10, 20, -100).at(20), heights.at(1));
  EXPECT_EQ(heightColors(5, 5, 5).at(5), depths.at(1));
  EXPECT_EQ(heightColors(5, 5).at(5), heights.at(0.5));
}

TEST(ColorTables, OfClassesAreTenApartForAllEyes) {
  const auto colors = classColors();
  EXPECT_GE(colors.size(), 7u);
  for (const Eyes eyes : kAllEyes)
    for (std::size_t i = 0; i < colors.size(); ++i) {
      EXPECT_GE(colorDifference(seenBy(eyes, colors[i]), seenBy(eyes, kNodataColor)), 10) << i;
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GE(colorDifference(seenBy(eyes, colors[i]), seenBy(eyes, colors[k])), 10)
            << i << " and " << k << ", eyes " << int(eyes);
    }
}

TEST(ColorTables, AreFoundByTheirNamesOnly) {
  for (const ColorTable& table : colorTables()) EXPECT_EQ(findColorTable(table.name), &table);
  EXPECT_EQ(findColorTable("heigh"), nullptr);
  EXPECT_EQ(findColorTable(""), nullptr);
}

}  // namespace
}  // namespace arete
