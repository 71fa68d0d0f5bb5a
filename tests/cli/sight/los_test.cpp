// SPDX-License-Identifier: GPL-3.0-or-later
// arete los over a plain with a wall.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cli/sight_fixture.h"
#include "io/geo/dem/raster_reader.h"
#include "io/geo/dem/raster_writer.h"

namespace arete::cli_test {
namespace {

using Los = SightCommands;

TEST_F(Los, TellsWhatIsInTheWay) {
  makeModel();
  const std::vector<std::string> below = {"los", "dem.amt", "--from", "1105,1895,20", "--to", "1505,1895,20"};
  const Outcome text = run(below);
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_EQ(text.out.rfind("blocked\ndistance     400.000 m\nazimuth      90.000000 degrees\n", 0), 0u)
      << text.out;
  for (const char* method : {"auto", "descent", "pyramid", "scan"}) {
    std::vector<std::string> arguments = below;
    arguments.insert(arguments.end(), {"--json", "--method", method});
    const Json json = run(arguments).json();
    EXPECT_EQ(json["verdict"], "blocked");
    EXPECT_EQ(json["earth"], "plane");
    EXPECT_NEAR(json["clearance"].get<double>(), -10, 1e-9);
    // The wall rises by 30 within 10 m: it is 20 high a third before its top.
    EXPECT_NEAR(json["obstruction"]["distance"].get<double>(), 200 - 10.0 / 3, 1e-6);
    EXPECT_NEAR(json["obstruction"]["x"].get<double>(), 1305 - 10.0 / 3, 1e-6);
    EXPECT_NEAR(json["obstruction"]["terrainHeight"].get<double>(), 120, 1e-6);
    EXPECT_EQ(json["fromHeight"], 120);
  }
  const Json above =
      run({"los", "dem.amt", "--from", "1105,1895,40", "--to", "1505,1895,140msl", "--json"}).json();
  EXPECT_EQ(above["verdict"], "visible");
  EXPECT_NEAR(above["clearance"].get<double>(), 10, 1e-9);
  EXPECT_TRUE(above["obstruction"].is_null());
  const Json touching =
      run({"los", "dem.amt", "--from", "1105,1895,30", "--to", "1505,1895,30", "--json"}).json();
  EXPECT_EQ(touching["verdict"], "visible");
  EXPECT_EQ(touching["touching"], true);
}

TEST_F(Los, MarksAnObstructionOfApproximateTerrain) {
  // Hills, of which a coarse triangulation says where they hide something, but not to the metre.
  constexpr std::uint32_t kSide = 65;
  std::vector<double> heights;
  for (std::uint32_t row = 0; row < kSide; ++row)
    for (std::uint32_t column = 0; column < kSide; ++column)
      heights.push_back(100 + 40 * std::sin(column * 0.21) + 5 * std::sin(row * 0.8 + column));
  Georeference georeference;
  georeference.geoTransform = {1000, 10, 0, 2000, 0, -10};
  georeference.hasGeoTransform = true;
  georeference.verticalUnit = std::string("m");
  ASSERT_TRUE(writeGeoTiff(path("hills.tif"), kSide, kSide, heights, georeference));
  ASSERT_EQ(run({"build", "hills.tif", "-o", "hills.amt", "-q"}).code, 0);
  std::string pairs = "x1,y1,h1,x2,y2,h2\n";
  for (int i = 0; i < 60; ++i) pairs += fmt::format("1015,{0},1,1635,{0},1\n", 1375 + 10 * i);
  write("hills.csv", pairs);
  const auto ask = [&](const char* error) {
    return run({"los", "hills.amt", "--pairs", "hills.csv", "--max-error", error, "--json"}).json();
  };
  const Json exact = ask("0")["answers"], within = ask("6")["answers"];
  int approximate = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (exact[i]["verdict"] == "blocked") {
      EXPECT_EQ(exact[i]["obstruction"]["approximate"], false);
    }
    if (within[i]["verdict"] != "blocked") continue;
    ASSERT_EQ(exact[i]["verdict"], "blocked");
    const double first = exact[i]["obstruction"]["distance"], told = within[i]["obstruction"]["distance"];
    if (within[i]["obstruction"]["approximate"] == true) {
      ++approximate;
      EXPECT_LE(first, told + 1e-6) << i;
    } else {
      EXPECT_NEAR(first, told, 1e-6) << i;
    }
  }
  EXPECT_GT(approximate, 0);
  const auto lines = linesOf(run({"los", "hills.amt", "--pairs", "hills.csv", "--max-error", "6"}).out);
  EXPECT_NE(lines.at(0).find("obstruction_distance,gap,obstruction_approximate,visited"), std::string::npos);
  const Outcome text =
      run({"los", "hills.amt", "--from", "1015,1685,1", "--to", "1635,1685,1", "--max-error", "6"});
  EXPECT_NE(text.out.find("of the approximate terrain; the first is there or nearer"), std::string::npos)
      << text.out;
}

TEST_F(Los, TellsRadioPlannersOfFresnelZonesAndClutter) {
  makeModel();
  const auto ask = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"los",  "dem.amt",      "--from", "1105,1895,40",
                                          "--to", "1505,1895,40", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments).json();
  };
  const Json radio = ask({"--frequency", "299.792458"});
  EXPECT_NEAR(radio["fresnel"].get<double>(), 10 / std::sqrt(200.0 * 200 / 400), 1e-9);
  EXPECT_EQ(radio["fresnelClear"], true);
  EXPECT_EQ(ask({"--frequency", "299.792458", "--fresnel", "1.1"})["fresnelClear"], false);
  const Json wood = ask({"--clutter", "15", "--clutter-free", "50"});
  EXPECT_EQ(wood["verdict"], "blocked");
  EXPECT_NEAR(wood["clearance"].get<double>(), -5, 1e-9);
  EXPECT_EQ(ask({"--clutter", "45"})["verdict"], "blocked");
  EXPECT_EQ(ask({"--clutter", "45", "--clutter-free", "500"})["verdict"], "visible");
  // The same clutter as a raster.
  std::vector<double> heights(61 * 41, 15);
  Georeference georeference;
  georeference.geoTransform = {1000, 10, 0, 2000, 0, -10};
  georeference.hasGeoTransform = true;
  ASSERT_TRUE(writeGeoTiff(path("wood.tif"), 61, 41, heights, georeference));
  EXPECT_EQ(ask({"--clutter", "wood.tif", "--clutter-free", "50"})["clearance"], wood["clearance"]);
  georeference.geoTransform[0] += 5000;
  ASSERT_TRUE(writeGeoTiff(path("far.tif"), 61, 41, heights, georeference));
  refused({"los", "dem.amt", "--from", "1105,1895,40", "--to", "1505,1895,40", "--clutter", "far.tif"}, 2,
          "far.tif: lies nowhere over the DEM");
}

// `arete height` writes such a column, and there it is the height of the terrain.
TEST_F(Los, SaysThatAColumnNamedHeightIsAboveTheGround) {
  makeModel();
  write("huts.csv", "x,y\n1505,1895\n");
  ASSERT_EQ(run({"height", "dem.amt", "--points", "huts.csv", "-o", "huts_h.csv", "-q"}).code, 0);
  const auto said = [&](const std::string& points) {
    return run({"los", "dem.amt", "--from", "1105,1895,20", "--points", points, "--target-height", "2"}).err;
  };
  EXPECT_EQ(said("huts.csv").find("column height"), std::string::npos);
  EXPECT_NE(said("huts_h.csv").find("the column height is taken for heights above the ground"),
            std::string::npos);
  write("masts.csv", "x,y,h\n1505,1895,30\n");
  EXPECT_EQ(said("masts.csv"), "");
}

TEST_F(Los, RefusesAnEffectiveRadiusForTheCoefficientOfRefraction) {
  makeModel("EPSG:32632");
  const std::vector<std::string> line = {"los",  "dem.amt",           "--from",      "500105,5199895,20",
                                         "--to", "500505,5199895,20", "--refraction"};
  for (const char* k : {"1.333", "1", "4"}) {
    std::vector<std::string> words = line;
    words.push_back(k);
    refused(words, 2, "an effective Earth of 4/3 is 0.25");
  }
}

TEST_F(Los, ATargetWithoutAHeightIsOnTheGround) {
  makeModel();
  const auto ask = [&](const std::vector<std::string>& ends) {
    std::vector<std::string> command = {"los", "dem.amt", "--json"};
    command.insert(command.end(), ends.begin(), ends.end());
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json();
  };
  Json ground = ask({"--from", "1105,1895,2", "--to", "1205,1895"});
  EXPECT_EQ(ground["targetOnGround"], true);
  EXPECT_EQ(ground["toHeight"], 100);
  EXPECT_EQ(ground["verdict"], "visible");
  Json zero = ask({"--from", "1105,1895,2", "--to", "1205,1895,0"});
  EXPECT_EQ(zero["targetOnGround"], false) << "is stated";
  ground.erase("targetOnGround");
  zero.erase("targetOnGround");
  EXPECT_EQ(ground, zero);
  EXPECT_EQ(ask({"--from", "1105,1895,2", "--to", "1505,1895"})["verdict"], "blocked");
  const Outcome text = run({"los", "dem.amt", "--from", "1105,1895,2", "--to", "1205,1895"});
  EXPECT_NE(text.out.find("on the ground, as --to states no height"), std::string::npos) << text.out;
  // The options for heights that a file lacks are for a position without one, too.
  EXPECT_EQ(ask({"--from", "1105,1895,2", "--to", "1205,1895", "--target-height", "7"})["toHeight"], 107);
  const Json both = ask(
      {"--from", "1105,1895", "--to", "1205,1895", "--observer-height", "3", "--target-height", "107msl"});
  EXPECT_EQ(both["fromHeight"], 103);
  EXPECT_EQ(both["toHeight"], 107);
  write("sites.csv", "x,y,h\n1105,1895,2\n1505,1895,2\n");
  const Outcome sites = run({"los", "dem.amt", "--to", "1205,1895", "--points", "sites.csv"});
  EXPECT_EQ(sites.code, 0) << sites.err;
  EXPECT_NE(sites.err.find("the target is on the ground"), std::string::npos) << sites.err;
  refused({"los", "dem.amt", "--from", "1105,1895", "--to", "1205,1895,2"}, 2, "a position is X,Y,H");
  refused({"los", "dem.amt", "--from", "1105,1895,2", "--to", "1205"}, 2, "a position is X,Y,H");
}

TEST_F(Los, TakesTheNamesThatPythonHas) {
  makeModel();
  EXPECT_EQ(run({"los", "dem.amt", "--observer", "1105,1895,2", "--target", "1205,1895,2"}).out,
            run({"los", "dem.amt", "--from", "1105,1895,2", "--to", "1205,1895,2"}).out);
  EXPECT_EQ(run({"profile", "dem.amt", "--line", "1105,1895:1205,1895"}).out,
            run({"profile", "dem.amt", "--along", "1105,1895:1205,1895"}).out);
}

TEST_F(Los, RefusesWhatMakesNoSense) {
  makeModel();
  write("pairs.csv", "x1,y1,x2,y2\n1105,1895,1505,1895\n");
  write("none.csv", "a,b\n1,2\n");
  refused({"los", "dem.amt"}, 2, "--from and --to are required");
  refused({"los", "dem.amt", "--from", "1,1,1"}, 2, "--from and --to are required");
  refused({"los", "dem.amt", "--from", "1,1,1", "--pairs", "pairs.csv"}, 2,
          "--pairs: cannot be combined with --from, --to or --points");
  refused({"los", "dem.amt", "--points", "pairs.csv"}, 2, "requires either --from or --to");
  refused({"los", "dem.amt", "--from", "1,1,1", "--to", "1105,1895,2"}, 4, "has no terrain below it");
  refused({"los", "dem.amt", "--from", "1,1", "--to", "1105,1895,2"}, 2, "a position is X,Y,H");
  refused({"los", "dem.amt", "--pairs", "none.csv"}, 4, "has no columns x1 and y1");
  refused({"los", "dem.amt", "--pairs", "nowhere.csv"}, 3, "there is no such file");
  refused({"los", "dem.amt", "--pairs", "pairs.csv", "-o", "a.txt"}, 2, "ends in .csv, .gpkg or .json");
  refused({"los", "dem.amt", "--pairs", "pairs.csv", "-o", "pairs.csv"}, 2, "is an input");
  refused({"los", "dem.amt", "--from", "1105,1895,2", "--to", "1205,1895,2", "--earth", "ellipsoid"}, 2,
          "--earth ellipsoid: the DEM has no CRS");
  refused({"los", "dem.amt", "--from", "1105,1895,2", "--to", "1205,1895,2", "--clutter", "-3"}, 2,
          "--clutter -3: must be a height of at least 0");
  // Options that mean nothing without another one.
  const auto line = [&](const std::string& option, const std::string& value, const std::string& sentence) {
    refused({"los", "dem.amt", "--from", "1105,1895,2", "--to", "1205,1895,2", option, value}, 2, sentence);
  };
  line("--fresnel", "0.5", "--fresnel requires --frequency");
  line("--clutter-free", "50", "--clutter-free requires --clutter");
  line("--observer-height", "5", "--observer-height: requires --pairs or --points");
  line("--target-height", "5", "--target-height: requires --pairs or --points");
  refused({"profile", "dem.amt", "--along", "1105,1895,2:1205,1895,2", "--fresnel", "0.5"}, 2,
          "--fresnel requires --frequency");
  refused({"profile", "dem.amt", "--along", "1105,1895:1205,1895", "--layer", "roads"}, 2,
          "--layer: requires --along FILE");
  line("--refraction", "0.25", "--refraction: requires an ellipsoid");
  write("road.csv", "WKT\n\"LINESTRING (1105 1895,1205 1895)\"\n");
  refused({"profile", "dem.amt", "--along", "road.csv", "--lonlat"}, 2, "--lonlat: ");
  const Outcome heightless = run({"los", "dem.amt", "--pairs", "pairs.csv"});
  EXPECT_EQ(heightless.code, 4);
  EXPECT_NE(heightless.err.find("has no height; --observer-height sets one"), std::string::npos);
}

TEST_F(Los, MethodsThatCannotAnswerAreRefusedByName) {
  makeModel("EPSG:32632");
  const auto viewshed = [&](const std::vector<std::string>& more, const std::string& sentence,
                            const std::string& model = "dem.amt") {
    std::vector<std::string> arguments = {"viewshed", model, "-o", "v.tif"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    refused(arguments, 2, sentence);
    EXPECT_FALSE(exists("v.tif"));
  };
  const std::string at = "500105,5199895,20";
  viewshed({"--observer", at, "--method", "sweep", "--max-error", "5"},
           "--method sweep: cannot be combined with --max-error");
  for (const char* mode : {"height", "horizon"})
    viewshed({"--observer", at, "--method", "sweep", "--mode", mode},
             "--method sweep: the sweep is not possible: over an ellipsoid");
  viewshed({"--observer", at, "--method", "sweep", "--like", "dem.tif"},
           "--method sweep: the sweep is of the grid");
  std::string points = "x,y,z\n";
  for (int i = 0; i < 40; ++i) points += fmt::format("{},{},{}\n", i * 37 % 40, i * 17 % 40, i % 7);
  write("points.csv", points);
  const Outcome built = run({"build", "points.csv", "-o", "points.amt", "-q"});
  ASSERT_EQ(built.code, 0) << built.err;
  viewshed({"--observer", "20,20,20"}, "points.amt: a viewshed requires a raster", "points.amt");
  for (const char* method : {"pyramid", "scan", "embree"})
    refused({"los", "points.amt", "--from", "20,20,5", "--to", "10,20,5", "--method", method}, 2,
            std::string("--method ") + method + ": requires a raster");
  EXPECT_EQ(run({"los", "points.amt", "--from", "20,20,5", "--to", "10,20,5"}).code, 0);
}

TEST_F(Los, RemarksOnAnEndBelowTheGround) {
  makeModel();
  const Outcome buried = run({"los", "dem.amt", "--from", "1105,1895,10", "--to", "1205,1895,40msl"});
  ASSERT_EQ(buried.code, 0) << buried.err;
  EXPECT_NE(buried.err.find("the second end lies 60 m below the ground"), std::string::npos) << buried.err;
  EXPECT_EQ(buried.out.find("visited"), std::string::npos) << buried.out;
  EXPECT_EQ(run({"los", "dem.amt", "--from", "1105,1895,0", "--to", "1205,1895,100msl"}).err, "");
  write("sites.csv", "x,y,h\n1205,1895,-5\n1215,1895,-7\n1225,1895,1\n");
  const Outcome many = run({"los", "dem.amt", "--from", "1105,1895,10", "--points", "sites.csv"});
  EXPECT_NE(many.err.find("2 ends lie below the ground, by up to 7 m"), std::string::npos) << many.err;
}

}  // namespace
}  // namespace arete::cli_test
