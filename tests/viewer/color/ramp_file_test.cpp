// SPDX-License-Identifier: GPL-3.0-or-later
// Colour maps of other programs: what gdaldem and QGIS make of them, and what is refused by its line.
#include "viewer/color/ramp_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <cmath>
#include <fstream>
#include <limits>

#include "datasets/random.h"
#include "viewer/color_oracle.h"
#include "viewer/picture_fixture.h"

namespace arete {
namespace {

constexpr double kUnending = std::numeric_limits<double>::infinity();
const Rgba kTransparent{0, 0, 0, 0};

struct Read {
  ColorMap map;
  Warnings warnings;
};

Read mapOf(const std::string& text, double low = 0, double high = 1,
           std::optional<ColorsBetween> between = {}) {
  const auto file = parseRamp(text, "ramp.txt");
  EXPECT_TRUE(file) << file.error().describe();
  Read read;
  const auto map = file->map(low, high, between, read.warnings);
  EXPECT_TRUE(map) << map.error().describe();
  read.map = *map;
  return read;
}

std::string refusalOf(const std::string& text) {
  const auto file = parseRamp(text, "ramp.txt");
  return file ? "was read" : file.error().describe();
}

TEST(RampFile, OfGdaldemsPageIsReadAsGdaldemReadsIt) {
  const auto [map, warnings] = mapOf(
      "# heights\n"
      "3500   white\n"
      "2500   235:220:175\n"
      "50%   190 185 135\n"
      "700,240,250,150\n"
      "\n"
      "0\t50\t 180  50\n"
      "nv     0   0   0   0\n",
      -100, 2100);
  EXPECT_EQ(map.at(3500), (Rgba{255, 255, 255}));
  EXPECT_EQ(map.at(2500), (Rgba{235, 220, 175}));
  EXPECT_EQ(map.at(1000), (Rgba{190, 185, 135})) << "half of -100 to 2100";
  EXPECT_EQ(map.at(700), (Rgba{240, 250, 150}));
  EXPECT_EQ(map.at(-5), (Rgba{50, 180, 50}));
  EXPECT_EQ(map.at(std::nan("")), kTransparent);
  EXPECT_EQ(map.at(3000), (Rgba{245, 238, 215}));
  EXPECT_TRUE(warnings.empty());
}

TEST(RampFile, HasTheNamesOfGdal) {
  const ColorMap map =
      mapOf(
          "0 white\n1 black\n2 red\n3 green\n4 blue\n5 yellow\n6 magenta\n7 cyan\n8 aqua\n9 grey\n10 orange\n"
          "11 brown\n12 Purple\n13 violet\n14 indigo\n15 GRAY\n16 #0a141e\n17 #0a141e80\n")
          .map;
  // What gdaldem 3.6 wrote.
  const Rgba expected[] = {{255, 255, 255}, {0, 0, 0},      {255, 0, 0},      {0, 255, 0},   {0, 0, 255},
                           {255, 255, 0},   {255, 0, 255},  {0, 255, 255},    {0, 191, 191}, {191, 191, 191},
                           {255, 127, 0},   {191, 127, 63}, {127, 0, 255},    {127, 0, 255}, {0, 127, 255},
                           {191, 191, 191}, {10, 20, 30},   {10, 20, 30, 128}};
  for (int i = 0; i < 18; ++i) EXPECT_EQ(map.at(i), expected[i]) << i;
}

TEST(RampFile, OfQgisKeepsLabelsWithCommasAndInfiniteEnds) {
  const auto [map, warnings] = mapOf(
      "# QGIS Generated Color Map Export File\r\n"
      "INTERPOLATION:DISCRETE\r\n"
      "1000,0,97,0,255,< $1,000\r\n"
      "5000,51,129,0,255,$1,000 to $5,000\r\n"
      "inf,200,60,10,128,1000 - 9000\r\n");
  EXPECT_EQ(map.between(), ColorsBetween::discrete);
  EXPECT_EQ(map.at(-1e9), (Rgba{0, 97, 0}));
  EXPECT_EQ(map.at(1000), (Rgba{0, 97, 0}));
  EXPECT_EQ(map.at(1001), (Rgba{51, 129, 0}));
  EXPECT_EQ(map.at(5001), (Rgba{200, 60, 10, 128}));
  EXPECT_EQ(map.at(kUnending), (Rgba{200, 60, 10, 128}));
  EXPECT_EQ(map.stops()[0].label, "< $1,000");
  EXPECT_EQ(map.stops()[1].label, "$1,000 to $5,000");
  EXPECT_EQ(map.stops()[2].label, "1000 - 9000");
  EXPECT_EQ(mapOf("INTERPOLATION:EXACT\n7,1,2,3,255,\n").map.at(7.5), kTransparent);
  EXPECT_EQ(mapOf("INTERPOLATION:INTERPOLATED\n0,0,0,0,255,0\n2,100,0,0,255,2\n").map.at(1),
            (Rgba{50, 0, 0}));
}

TEST(RampFile, OfGrassHasRulesOfPerCentAndADefault) {
  const auto [map, warnings] =
      mapOf("0% blue\n33.3333% cyan\n100% 255:0:0\nnv white\ndefault grey\nend\n", 100, 400);
  EXPECT_EQ(map.at(100), (Rgba{0, 0, 255}));
  EXPECT_EQ(map.at(400), (Rgba{255, 0, 0}));
  EXPECT_NEAR(map.at(200).g, 255, 1);
  EXPECT_EQ(map.at(std::nan("")), (Rgba{255, 255, 255}));
  EXPECT_EQ(map.at(99), (Rgba{191, 191, 191}));
  EXPECT_EQ(map.at(401), (Rgba{191, 191, 191}));
  EXPECT_TRUE(parseRamp("10% red", "r")->usesPercent());
  EXPECT_FALSE(parseRamp("10 red", "r")->usesPercent());
}

TEST(RampFile, IsDrawnByAnotherRuleOnDemand) {
  const std::string text = "0 255 0 0\n10 0 255 0\n20 0 0 255\n";
  EXPECT_EQ(mapOf(text, 0, 1, ColorsBetween::nearest).map.at(4), (Rgba{255, 0, 0}));
  EXPECT_EQ(mapOf(text, 0, 1, ColorsBetween::nearest).map.at(5), (Rgba{0, 255, 0}));
  EXPECT_EQ(mapOf(text, 0, 1, ColorsBetween::exact).map.at(10), (Rgba{0, 255, 0}));
  EXPECT_EQ(mapOf(text, 0, 1, ColorsBetween::exact).map.at(10.5), kTransparent);
  EXPECT_EQ(mapOf(text, 0, 1, ColorsBetween::discrete).map.at(4), (Rgba{0, 255, 0}));
}

TEST(RampFile, NamesTheLineThatIsWrong) {
  EXPECT_EQ(refusalOf("0 red\n\n10 rot\n"),
            "ramp.txt: line 3 has the colour \"rot\", which has no meaning here");
  EXPECT_EQ(refusalOf("0 red\n10 1 2 300\n"),
            "ramp.txt: line 2 has \"300\" as part of a colour, which is not a whole number from 0 to 255");
  EXPECT_EQ(refusalOf("10 1 -2 3\n"),
            "ramp.txt: line 1 has \"-2\" as part of a colour, which is not a whole number from 0 to 255");
  EXPECT_NE(refusalOf("0 0.2 0.5 0.1\n").find("line 1 has \"0.2\""), std::string::npos);
  EXPECT_NE(refusalOf("10 1 2\n").find("line 1 has 2 of the three parts of a colour"), std::string::npos);
  EXPECT_NE(refusalOf("0 red\n10\n").find("line 2 has no colour"), std::string::npos);
  EXPECT_NE(refusalOf("high red\n").find("line 1 begins with \"high\""), std::string::npos);
  EXPECT_NE(refusalOf("nan% red\n").find("line 1"), std::string::npos);
  EXPECT_NE(refusalOf("120% red\n").find("not between 0 and 100 per cent"), std::string::npos);
  EXPECT_NE(refusalOf("0 1 2 3 255 12\n").find("line 1 has more numbers"), std::string::npos);
  EXPECT_NE(refusalOf("INTERPOLATION:CUBIC\n").find("line 1 states the interpolation \"CUBIC\""),
            std::string::npos);
  EXPECT_NE(refusalOf("nv red\nnv blue\n").find("line 2 states another colour for nv"), std::string::npos);
  EXPECT_NE(refusalOf("12,5 255 0 0\n").find("line 1 has a comma within its first number"),
            std::string::npos);
  EXPECT_NE(refusalOf("1 #12345\n").find("line 1"), std::string::npos);
}

TEST(RampFile, OfAnotherFormatIsRefusedByName) {
  EXPECT_NE(refusalOf("<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n").find(".qml"),
            std::string::npos);
  EXPECT_NE(refusalOf("\n  <StyledLayerDescriptor/>").find("SLD"), std::string::npos);
  EXPECT_NE(refusalOf("# COLOR_MODEL = RGB\n0 0 0 0 1 255 255 255\n").find("GMT"), std::string::npos);
  EXPECT_NE(refusalOf("0 0 0 0 100 255 255 255\n").find("GMT"), std::string::npos);
  EXPECT_NE(refusalOf("GIMP Palette\n").find("line 1"), std::string::npos);
  EXPECT_NE(refusalOf(std::string("0 red\n\0\0", 8)).find("line 2"), std::string::npos);
}

TEST(RampFile, WithoutAColourIsRefused) {
  for (const char* text : {"", "\n\n", "# nothing\n", "nv red\n", "INTERPOLATION:EXACT\n"})
    EXPECT_NE(refusalOf(text).find("has no colour"), std::string::npos) << text;
}

TEST(RampFile, OfTwoColoursForOneValueIsAStepOrRefused) {
  const std::string text = "0 red\n10 red\n20 blue\n10 green\n";
  const auto [map, warnings] = mapOf(text);
  EXPECT_EQ(map.at(9.999), (Rgba{255, 0, 0}));
  EXPECT_EQ(map.at(10), (Rgba{0, 255, 0}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].sentence.find("lines 2 and 4 state different colours for 10"), std::string::npos);
  for (const auto between : {ColorsBetween::exact, ColorsBetween::nearest, ColorsBetween::discrete}) {
    Warnings ignored;
    const auto refused = parseRamp(text, "r")->map(0, 1, between, ignored);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().describe().find("lines 2 and 4"), std::string::npos);
  }
  EXPECT_TRUE(mapOf("0 red\n0 red\n9 blue\n").warnings.empty()) << "the same line twice";
}

TEST(RampFile, WithNeighboursAlikeIsDrawnWithAWord) {
  const auto alike = mapOf("INTERPOLATION:DISCRETE\n1,10,10,10,255,a\n2,12,12,12,255,b\n3,250,0,0,255,c\n");
  ASSERT_EQ(alike.warnings.size(), 1u);
  EXPECT_EQ(alike.warnings[0].sentence, "the colours of 1 and 2 can hardly be told apart");
  EXPECT_EQ(alike.map.at(2), (Rgba{12, 12, 12})) << "as it is";
  EXPECT_EQ(mapOf("0 100 100 100\n50 100 100 100\n100 0 0 0\n").warnings.size(), 1u);
  std::string many;  // 256 greys: neighbours are alike, and a height is not
  for (int i = 0; i < 256; ++i) many += fmt::format("{} {} {} {}\n", i, i, i, i);
  EXPECT_TRUE(mapOf(many).warnings.empty());
}

TEST(RampFile, IsReadInAnyEncodingAndOrder) {
  const test::TemporaryFolder folder;
  const std::string text =
      "\xEF\xBB\xBF"
      "20 blue\r\n0 red\r\n";
  std::ofstream(folder / "bom.txt", std::ios::binary) << text;
  std::string wide = "\xFF\xFE";
  for (const char c : std::string("0 red\n20 blue\n")) wide += {c, '\0'};
  std::ofstream(folder / "wide.txt", std::ios::binary) << wide;
  for (const char* name : {"bom.txt", "wide.txt"}) {
    const auto file = readRampFile(folder / name);
    ASSERT_TRUE(file) << file.error().describe();
    Warnings warnings;
    EXPECT_EQ(file->map(0, 1, {}, warnings)->at(20), (Rgba{0, 0, 255}));
  }
  EXPECT_EQ(readRampFile(folder / "missing.txt").error().code, ErrorCode::notFound);
}

TEST(RampFile, IsReadOrRefusedHoweverItIsDamaged) {
  const std::string whole =
      "# QGIS Generated Color Map Export "
      "File\nINTERPOLATION:INTERPOLATED\n-inf,0,0,0,255,a,b\n10%,1,2,3,255,c\n"
      "nv 1 2 3\ndefault white\n7 aqua\n8 #ff00ff\n";
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Random random(seed);
    std::string text = whole;
    for (int i = 0; i < 3; ++i)
      text[random.next() % text.size()] = "0,:% \n-.ainf#\"\xff"[random.next() % 16];
    const auto file = parseRamp(text, "r");
    if (!file) {
      EXPECT_FALSE(file.error().message.empty()) << "seed " << seed;
      continue;
    }
    Warnings warnings;
    const auto map = file->map(-5, 5, {}, warnings);
    if (map) map->at(3);
  }
}

}  // namespace
}  // namespace arete
