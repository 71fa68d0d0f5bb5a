// SPDX-License-Identifier: GPL-3.0-or-later
// arete height, as a user meets it.
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "cli/cli_fixture.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

class HeightCommand : public Cli {
 protected:
  void makeModel(const std::string& family) const {
    makeRaster("dem.tif", family, 40, 30);
    const Outcome built = run({"build", "dem.tif", "-o", "dem.amt", "-q"});
    ASSERT_EQ(built.code, 0) << built.err;
  }
};

TEST_F(HeightCommand, AnswersALineForEachPlace) {
  makeModel("ramp");  // heights in sixteenths: no rounding
  const auto dem = readRaster(path("dem.tif"));
  ASSERT_TRUE(dem);
  const RasterHeightfield& field = dem->heightfield;
  const Vec2 sample = field.georeference.toSource(7, 11), between = field.georeference.toSource(7.5, 11);
  const Outcome outcome = run({"height", "dem.amt", "--at", fmt::format("{},{}", sample.x, sample.y), "--at",
                               fmt::format("{},{}", between.x, between.y)});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, fmt::format("{},{},{:.12g}\n{},{},{:.12g}\n", sample.x, sample.y, field.at(7, 11),
                                     between.x, between.y, (field.at(7, 11) + field.at(8, 11)) / 2));
  EXPECT_EQ(outcome.err, "");
}

TEST_F(HeightCommand, KeepsAToleranceAndSaysItsBound) {
  makeModel("fractal");
  const std::string place = "500333.5,5199666.25";
  const Json full = run({"height", "dem.amt", "--at", place, "--json"}).json();
  const Json coarse = run({"height", "dem.amt", "--at", place, "--json", "--max-error", "20"}).json();
  const Json &a = full["points"][0], &b = coarse["points"][0];
  EXPECT_EQ(a["below"], 0);
  EXPECT_EQ(coarse["maxError"], 20);
  EXPECT_LE(b["below"], 20);
  EXPECT_LE(b["above"], 20);
  EXPECT_LE(std::abs(a["height"].get<double>() - b["height"].get<double>()), 20);
  EXPECT_LT(b["nodesVisited"], a["nodesVisited"]);
}

TEST_F(HeightCommand, LosesNoRowOfAFileAndCountsThoseWithoutAHeight) {
  makeModel("flat");
  write("places.csv", "hut;x;y\nA;500100;5199900\nB;1;1\nC;500200;5199800\n");
  const Outcome outcome = run({"height", "dem.amt", "--points", "places.csv", "-o", "heights.csv"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("2 of 3 places have a height"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.err.find("1 of 3 places have no height"), std::string::npos) << outcome.err;
  std::istringstream lines(read("heights.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "hut,x,y,height,below,above");
  std::getline(lines, line);
  EXPECT_EQ(line.rfind("A,500100,5199900,", 0), 0u) << line;
  std::getline(lines, line);
  EXPECT_EQ(line, "B,1,1,,,");

  const Outcome printed = run({"height", "dem.amt", "--points", "places.csv"});
  EXPECT_EQ(printed.out, read("heights.csv"));
  ASSERT_EQ(run({"height", "dem.amt", "--points", "places.csv", "-o", "heights.gpkg"}).code, 0);
  const Outcome again = run({"height", "dem.amt", "--points", "heights.gpkg", "-q", "--json"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.json()["onTerrain"], 2);
}

TEST_F(HeightCommand, SaysWhereThereIsNoTerrainAtAll) {
  makeModel("flat");
  const Outcome one = run({"height", "dem.amt", "--at", "1,1"});
  EXPECT_EQ(one.code, 4);
  EXPECT_EQ(one.out, "1,1,\n") << "an answer all the same";
  EXPECT_NE(one.err.find("dem.amt: has no terrain at this place"), std::string::npos) << one.err;
  const Outcome two = run({"height", "dem.amt", "--at", "1,1", "--at", "-2,-2", "--json"});
  EXPECT_EQ(two.code, 4);
  EXPECT_EQ(two.json()["onTerrain"], 0);
  EXPECT_TRUE(two.json()["points"][1]["height"].is_null());
}

TEST_F(HeightCommand, RefusesWhatMakesNoSense) {
  makeModel("flat");
  write("places.csv", "x,y\n1,2\n");
  const auto refused = [&](const std::vector<std::string>& arguments, int code, const std::string& sentence) {
    std::vector<std::string> all = {"height", "dem.amt"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run(all);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  };
  refused({}, 2, "either --at or --points");
  refused({"--at", "1"}, 2, "--at 1: a place is two numbers");
  refused({"--at", "1,y"}, 2, "'y' is not a number");
  refused({"--at", "1,1", "--points", "places.csv"}, 2, "excludes");
  refused({"--at", "1,1", "--lonlat"}, 2, "--lonlat: the DEM has no CRS");
  refused({"--at", "1,1", "--max-error", "-3"}, 2, "cannot be below zero");
  refused({"--points", "nowhere.csv"}, 3, "there is no such file");
  refused({"--points", "dem.tif"}, 4, "cannot be read as a set of points");
  refused({"--points", "places.csv", "-o", "heights.txt"}, 2, "ends in .csv or .gpkg");
  refused({"--points", "places.csv", "-o", "places.csv"}, 2, "is an input");
  refused({"--at", "1,1", "--layer", "a"}, 2, "--layer: requires --points");
  EXPECT_EQ(files(), (std::set<std::string>{"dem.amt", "dem.tif", "places.csv"}));
}

TEST_F(HeightCommand, FindsALongitudeThatIsOffByAWholeTurn) {
  std::string points = "lon,lat,z\n";
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j) points += fmt::format("{},{},{}\n", 179 + i * 0.5, 10 + j * 0.5, 100 * i);
  write("dem.csv", points);
  ASSERT_EQ(run({"build", "dem.csv", "-o", "dem.amt", "--crs", "EPSG:4326", "-q"}).code, 0);
  for (const char* place : {"-179.5,11", "180.5,11"}) {
    const Outcome outcome = run({"height", "dem.amt", "--lonlat", "--at", place});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, std::string(place) + ",300\n");
  }
  write("places.csv", "lon,lat\n-179.5,11\n");
  EXPECT_EQ(run({"height", "dem.amt", "--lonlat", "--points", "places.csv", "--json"}).json()["onTerrain"],
            1);
  const Outcome seen = run({"los", "dem.amt", "--lonlat", "--from", "-179.5,11,50", "--to", "180.6,11,50"});
  EXPECT_EQ(seen.code, 0) << seen.err;
}

TEST_F(HeightCommand, ReadsALineBreakInQuotes) {
  makeModel("flat");
  write("places.csv", "hut,x,y\n\"The\nhut\",500100,5199900\n");
  const Outcome outcome = run({"height", "dem.amt", "--points", "places.csv"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.substr(0, outcome.out.find("500100")), "hut,x,y,height,below,above\n\"The\nhut\",");
}

TEST_F(HeightCommand, AsksForTheFileInAnArchive) {
  makeModel("flat");
  write("places.zip", std::string("PK\x05\x06") + std::string(18, '\0'));  // an archive of nothing
  const Outcome outcome = run({"height", "dem.amt", "--points", "places.zip"});
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(outcome.err.find("is an archive: name the set of points in it"), std::string::npos)
      << outcome.err;
}

TEST_F(HeightCommand, GivesEverySampleOfARealDem) {
  const std::string dem = realData("dem/srtm3_zion_cc0.tif");
  if (dem.empty()) GTEST_SKIP() << "the Zion DEM is not here (set ARETE_DATA)";
  const auto read = readRaster(dem);
  ASSERT_TRUE(read) << read.error().describe();
  const RasterHeightfield& field = read->heightfield;
  ASSERT_EQ(run({"build", dem, "-o", "dem.amt", "-q"}).code, 0);
  std::string places = "x,y,sample\n", expected;
  for (std::uint32_t i = 0; i < field.size(); ++i) {
    const Vec2 p = field.georeference.toSource(i % field.columns, i / field.columns);
    places += fmt::format("{},{},{}\n", p.x, p.y, field.heights[i]);
  }
  write("samples.csv", places);
  const Outcome outcome = run({"height", "dem.amt", "--points", "samples.csv", "-o", "heights.csv"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::istringstream lines(Cli::read("heights.csv"));
  std::string line;
  std::getline(lines, line);
  for (std::uint32_t i = 0; i < field.size(); ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    if (std::isnan(field.heights[i])) continue;
    const std::string tail = line.substr(line.rfind(',', line.rfind(',', line.rfind(',') - 1) - 1) + 1);
    ASSERT_NEAR(std::stod(tail), field.heights[i], 1e-6) << line;
  }
}

TEST_F(HeightCommand, WritesNoTableOfEmptyHeights) {
  makeModel("flat");
  write("away.csv", "x,y\n1,1\n2,2\n");
  const auto before = files();
  for (const char* output : {"h.csv", "h.gpkg"}) {
    const Outcome outcome = run({"height", "dem.amt", "--points", "away.csv", "-o", output});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files(), before) << output;
  }
}

TEST_F(HeightCommand, KeepsTheNamesOfTheColumns) {
  makeModel("flat");
  write("huts.csv", "easting,northing,height,hut\n500100,5199900,7,A\n");
  const Outcome outcome = run({"height", "dem.amt", "--points", "huts.csv"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.substr(0, outcome.out.find('\n')),
            "height_in,hut,easting,northing,height,below,above");
  EXPECT_NE(outcome.err.find("the column height of huts.csv is height_in in the answer"), std::string::npos)
      << outcome.err;
  write("upper.csv", "Y,X\n5199900,500100\n");
  const std::string upper = run({"height", "dem.amt", "--points", "upper.csv"}).out;
  EXPECT_EQ(upper.substr(0, upper.find('\n')), "X,Y,height,below,above");
}

TEST_F(HeightCommand, TakesTwoNumbersALineFromAPipe) {
  makeModel("flat");
  write("places.xyz", "500100 5199900\n500200 5199800\n");
  const Outcome ofFile = run({"height", "dem.amt", "--points", "places.xyz"});
  const std::string command = "cd '" + (folder_ / "here").string() +
                              "' && cat places.xyz | '" ARETE_PROGRAM
                              "' height dem.amt --points - > piped.csv";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read("piped.csv"), ofFile.out);
}

}  // namespace
}  // namespace arete::cli_test
