// SPDX-License-Identifier: GPL-3.0-or-later
// arete viewshed --png.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "cli/sight_fixture.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

class ViewshedPng : public SightCommands {
 protected:
  std::vector<std::string> with(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"viewshed", "dem.amt", "--observer", observer_, "--target-height", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// Width and height, which stand behind the first chunk's name.
  std::pair<std::uint32_t, std::uint32_t> sizeOf(const std::string& name) const {
    const std::string bytes = read(name);
    EXPECT_EQ(bytes.substr(1, 3), "PNG") << name;
    const auto number = [&](std::size_t at) {
      std::uint32_t value = 0;
      for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::uint8_t(bytes.at(at + i));
      return value;
    };
    return {number(16), number(20)};
  }

  std::string observer_ = "500105,5199895,20";
};

TEST_F(ViewshedPng, IsDrawnAloneAndWithTheRaster) {
  makeModel("EPSG:32632");
  const Outcome alone = run(with({"--png", "seen.png", "--json"}));
  ASSERT_EQ(alone.code, 0) << alone.err;
  EXPECT_EQ(alone.json()["picture"], "seen.png");
  EXPECT_FALSE(alone.json().contains("file"));
  EXPECT_GT(sizeOf("seen.png").first, 600u);
  const Outcome both =
      run(with({"--png", "again.png", "-o", "seen.tif", "--polygons", "seen.gpkg", "--json"}));
  ASSERT_EQ(both.code, 0) << both.err;
  EXPECT_EQ(read("again.png"), read("seen.png"));
  for (const char* key : {"seen", "hidden", "unknown", "outside"})
    EXPECT_EQ(both.json()[key], alone.json()[key]) << key;
  const Outcome text = run(with({"--png", "seen.png"}));
  EXPECT_NE(text.out.find("seen.png"), std::string::npos) << text.out;
}

TEST_F(ViewshedPng, MayBeWithoutDecorations) {
  makeModel("EPSG:32632");
  ASSERT_EQ(run(with({"--png", "whole.png", "-q"})).code, 0);
  ASSERT_EQ(run(with({"--png", "plain.png", "--no-decorations", "-q"})).code, 0);
  EXPECT_NE(read("whole.png"), read("plain.png"));
  refused(with({"--no-decorations", "-o", "seen.tif"}), 2, "--png");
}

TEST_F(ViewshedPng, IsOfEveryModeAndOfManyObservers) {
  makeModel("EPSG:32632");
  std::set<std::string> pictures;
  for (const char* mode : {"seen", "height", "horizon", "count", "server"}) {
    const Outcome outcome = run(with({"--mode", mode, "--png", "v.png", "-q"}));
    ASSERT_EQ(outcome.code, 0) << mode << ": " << outcome.err;
    EXPECT_TRUE(pictures.insert(read("v.png")).second) << mode;
  }
  for (const char* mode : {"seen", "count", "server"}) {
    const Outcome outcome =
        run(with({"--observer", "500405,5199695,5", "--mode", mode, "--png", "v.png", "-q"}));
    ASSERT_EQ(outcome.code, 0) << mode << ": " << outcome.err;
    EXPECT_TRUE(pictures.insert(read("v.png")).second) << mode;
  }
}

TEST_F(ViewshedPng, CountsHeightsThatNobodyKnowsAsUnknown) {
  makeModel("EPSG:32632");
  observer_ = "500105,5199615,5";  // the hole and the wall are in the way
  const Outcome seen = run(with({"--png", "v.png", "--json"}));
  const Outcome height = run(with({"--mode", "height", "--png", "v.png", "-o", "v.tif", "--json"}));
  ASSERT_EQ(seen.code + height.code, 0) << seen.err << height.err;
  const auto read = readRaster(path("v.tif"));
  ASSERT_TRUE(read);
  std::uint64_t none = 0;
  for (const double value : read->heightfield.heights) none += std::isnan(value) ? 1 : 0;
  const Json json = height.json();
  EXPECT_GT(json["unknown"].get<std::uint64_t>(), 0u);
  EXPECT_EQ(json["unknown"].get<std::uint64_t>() + json["outside"].get<std::uint64_t>(), none);
  EXPECT_EQ(json["outside"], seen.json()["outside"]);
}

TEST_F(ViewshedPng, NamesItselfWhereNothingIsInRange) {
  makeModel("EPSG:32632");
  observer_ = "500108,5199898,20";  // between the samples
  const Outcome outcome = run(with({"--radius", "2", "--png", "near.png"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: near.png: no sample is within the radius"), std::string::npos)
      << outcome.err;
}

TEST_F(ViewshedPng, StatesItsFieldOfViewAndItsObservers) {
  makeModel("EPSG:32632");
  std::set<std::string> pictures;
  // All of the terrain is in these fields, so that the answers are those without them.
  for (const std::vector<std::string>& field : {std::vector<std::string>{},
                                                {"--radius", "90000"},
                                                {"--elevation", "-89,90"},
                                                {"--radius", "80000"}}) {
    std::vector<std::string> words = with({"--png", "v.png", "-q"});
    words.insert(words.end(), field.begin(), field.end());
    ASSERT_EQ(run(words).code, 0);
    EXPECT_TRUE(pictures.insert(read("v.png")).second) << field.size();
  }
  const Json json =
      run(with({"--radius", "300", "--azimuth", "350,20", "--png", "v.png", "--mode", "count", "--json"}))
          .json();
  EXPECT_EQ(json["mode"], "count");
  const Json site = json["sites"][0];
  EXPECT_EQ(site["x"], 500105);
  EXPECT_EQ(site["y"], 5199895);
  EXPECT_EQ(site["height"], 120);
  EXPECT_EQ(site["radius"], 300);
  EXPECT_EQ(site["fromAzimuth"], 350);
  EXPECT_EQ(site["azimuthSpan"], 30);
}

TEST_F(ViewshedPng, HasTheGridOfAnotherRaster) {
  makeModel("EPSG:32632");
  ASSERT_EQ(run(with({"-o", "seen.tif", "-q"})).code, 0);
  const Outcome outcome = run(with({"--like", "seen.tif", "--png", "like.png", "-q"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_EQ(run(with({"--png", "own.png", "-q"})).code, 0);
  EXPECT_EQ(sizeOf("like.png"), sizeOf("own.png"));
}

TEST_F(ViewshedPng, IsDrawnWithoutACrs) {
  makeModel();
  observer_ = "1105,1895,20";
  const Outcome outcome = run(with({"--radius", "150", "--png", "seen.png", "-q"}));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(ViewshedPng, LeavesNothingBehindAfterAnError) {
  makeModel("EPSG:32632");
  refused(with({"--png", "seen.jpg"}), 2, "ends in .png");
  refused(with({"-o", "seen.png"}), 2, "--png");
  refused(with({"--png", "dem.tif"}), 2, "ends in .png");
  write("seen.gpkg", "no GeoPackage");
  EXPECT_NE(run(with({"--png", "seen.png", "--polygons", "seen.gpkg"})).code, 0);
  EXPECT_FALSE(exists("seen.png"));
}

}  // namespace
}  // namespace arete::cli_test
