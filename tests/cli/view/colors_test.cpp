// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of arete view: ramps by name and from files, over ranges and seas.
#include "cli/view/colors.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cli/cli_fixture.h"
#include "terrain/builder/build.h"

namespace arete::cli_test {
namespace {

class ColorOptions : public Cli {
 protected:
  /// The colours that the command's options make, or why not.
  Result<TerrainColors> of(std::vector<std::string> words, const std::string& coloring = "") {
    CLI::App app;
    OptionKinds kinds("", "");
    ColorArguments arguments;
    arguments.addTo(app, "", kinds);
    std::ranges::reverse(words);
    try {
      app.parse(words);
    } catch (const CLI::Error& e) {
      return failure(ErrorCode::usage, e.what());
    }
    warnings_.clear();
    return arguments.of(coloring, model_, warnings_);
  }
  std::string refusal(std::vector<std::string> words, const std::string& coloring = "") {
    const auto made = of(std::move(words), coloring);
    return made ? "taken" : made.error().describe();
  }
  void SetUp() override {
    Cli::SetUp();
    RasterHeightfield field;
    field.columns = 30;
    field.rows = 20;
    for (int i = 0; i < 600; ++i) field.heights.push_back(-50 + i % 30 * 10);
    model_ = build(field).value();  // heights from -50 to 240
  }

  TerrainModel model_;
  Warnings warnings_;
};

TEST_F(ColorOptions, AreTheTablesOverTheHeightsWithoutAny) {
  EXPECT_EQ(*of({}), TerrainColors::over(-50, 240));
  EXPECT_EQ(of({"--ramp", "height"})->heights, heightColors(-50, 240));
  EXPECT_EQ(of({"--ramp", "grey"})->heights, colorTable("grey").over(-50, 240));
  EXPECT_EQ(of({"--range", "0,100"})->heights, colorTable("height").over(0, 100));
  EXPECT_EQ(of({"--range", "0,30"}, "slope")->slopes, colorTable("slope").over(0, 30));
  EXPECT_EQ(of({"--ramp", "grey"}, "slope")->slopes, colorTable("grey").over(0, 60));
  EXPECT_EQ(of({"--ramp-mode", "nearest"})->heights.at(-50), colorTable("height").at(0));
}

TEST_F(ColorOptions, OfASeaAreWaterAtAndBelowItsLevel) {
  const ColorMap map = of({"--sea-level", "0"})->heights;
  EXPECT_EQ(map, heightColors(-50, 240, 0));
  EXPECT_EQ(map.at(0), colorTable("depth").at(1));
  EXPECT_EQ(of({"--sea-level", "-10.5", "--ramp", "grey"})->heights.at(-10),
            colorTable("grey").at(0.5 / 250.5));
}

TEST_F(ColorOptions, AreRecalledWhereMuchIsAtExactlyZero) {
  const ColorArguments none;
  EXPECT_EQ(none.wordOfSea("", model_), "") << "one height of thirty is 0";
  RasterHeightfield field;
  field.columns = 30;
  field.rows = 20;
  for (int i = 0; i < 600; ++i) field.heights.push_back(std::max(0, i % 30 - 9));
  const TerrainModel coast = build(field).value();
  EXPECT_EQ(none.wordOfSea("height", coast),
            "33 % of the heights are exactly 0, perhaps a sea: --sea-level 0 gives them colours of water");
  EXPECT_EQ(none.wordOfSea("slope", coast), "");
  ColorArguments stated;
  stated.ramp = "grey";
  EXPECT_EQ(stated.wordOfSea("", coast), "");
  for (double& height : field.heights) height = 0;
  EXPECT_EQ(none.wordOfSea("", build(field).value()), "") << "all of it";
}

TEST_F(ColorOptions, OfAFileAreItsOwnAndPerCentIsOfTheHeightsOrTheRange) {
  const std::string ramp = write("ramp.txt", "0% red\n100% blue\nnv 1 2 3\n");
  EXPECT_EQ(of({"--ramp", ramp})->heights.at(-50), (Rgba{255, 0, 0}));
  EXPECT_EQ(of({"--ramp", ramp})->heights.at(240), (Rgba{0, 0, 255}));
  EXPECT_EQ(of({"--ramp", ramp, "--range", "0,10"})->heights.at(5), (Rgba{128, 0, 128}));
  EXPECT_EQ(of({"--ramp", ramp}, "slope")->slopes.at(90), (Rgba{0, 0, 255}));
  const std::string values = write("values.txt", "10 red\n20 blue\n");
  EXPECT_EQ(of({"--ramp", values, "--ramp-mode", "discrete"})->heights.at(11), (Rgba{0, 0, 255}));
  const std::string alike = write("alike.txt", "INTERPOLATION:DISCRETE\n10,1,1,1,255,\n20,2,1,1,255,\n");
  ASSERT_TRUE(of({"--ramp", alike}));
  EXPECT_EQ(warnings_.size(), 1u);
}

TEST_F(ColorOptions, ThatWouldSayNothingAreRefusedByName) {
  const std::string values = write("values.txt", "10 red\n20 blue\n");
  EXPECT_NE(refusal({"--ramp", "viridi"}).find("--ramp viridi: is neither a file nor one of height, depth"),
            std::string::npos);
  EXPECT_NE(refusal({"--ramp", path("missing.txt")}).find("missing.txt"), std::string::npos);
  EXPECT_NE(
      refusal({"--ramp", values, "--range", "0,5"}).find("--range 0,5: is for named ramps and per cent"),
      std::string::npos);
  EXPECT_NE(refusal({"--ramp", values, "--sea-level", "0"}).find("--sea-level: is for named ramps"),
            std::string::npos);
  EXPECT_NE(refusal({"--range", "5,5"}).find("must be LOW,HIGH"), std::string::npos);
  EXPECT_NE(refusal({"--range", "5"}).find("--range"), std::string::npos);
  EXPECT_NE(refusal({"--range", "inf,nan"}).find("--range"), std::string::npos);
  EXPECT_NE(refusal({"--ramp-mode", "exact"}).find("--ramp-mode exact: requires --ramp FILE"),
            std::string::npos);
  EXPECT_NE(refusal({"--sea-level", "0", "--ramp-mode", "nearest"}).find("does not go with"),
            std::string::npos);
  EXPECT_NE(refusal({"--sea-level", "0"}, "slope").find("is for heights"), std::string::npos);
  EXPECT_NE(refusal({"--range", "0,9"}, "aspect").find("run from 0 to 360"), std::string::npos);
  EXPECT_NE(refusal({"--ramp", "grey"}, "plain").find("--color plain shows none"), std::string::npos);
  EXPECT_NE(refusal({"--sea-level", "0"}, "error").find("--color error shows none"), std::string::npos);
}

}  // namespace
}  // namespace arete::cli_test
