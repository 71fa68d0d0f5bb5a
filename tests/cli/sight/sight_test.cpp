// SPDX-License-Identifier: GPL-3.0-or-later
//
// arete los, profile and viewshed, as a user meets them: over a plain with a wall, where answers are known.
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "cli/cli_fixture.h"
#include "io/dem/raster_reader.h"
#include "io/dem/raster_writer.h"

namespace arete::cli_test {
namespace {

/// 61 x 41 samples, 10 m apart, the first at (1005, 1995); 100 high but for a wall of 130 along x = 1305 with
/// a hole in the terrain at its southern end.
class SightCommands : public Cli {
 protected:
  void makeModel(const std::string& crs = {}) const {
    constexpr std::uint32_t kColumns = 61, kRows = 41;
    std::vector<double> heights(kColumns * kRows, 100);
    for (std::uint32_t row = 0; row < kRows; ++row) heights[row * kColumns + 30] = 130;
    for (std::uint32_t row = 32; row < kRows; ++row)
      for (std::uint32_t column = 28; column < 33; ++column) heights[row * kColumns + column] = std::nan("");
    Georeference georeference;
    georeference.geoTransform = {1000, 10, 0, 2000, 0, -10};
    georeference.hasGeoTransform = true;
    georeference.crsWkt = crs;
    georeference.verticalUnit = std::string("m");
    if (!crs.empty()) georeference.geoTransform = {500000, 10, 0, 5200000, 0, -10};
    ASSERT_TRUE(writeGeoTiff(path("dem.tif"), kColumns, kRows, heights, georeference));
    const Outcome built = run({"build", "dem.tif", "-o", "dem.amt", "-q"});
    ASSERT_EQ(built.code, 0) << built.err;
  }

  void refused(const std::vector<std::string>& arguments, int code, const std::string& sentence) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }

  static std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
};

TEST_F(SightCommands, LosTellsWhatIsInTheWay) {
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

TEST_F(SightCommands, LosMarksAnObstructionOfApproximateTerrain) {
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

TEST_F(SightCommands, LosTakesNodataAsItIsTold) {
  makeModel();
  const auto verdict = [&](const char* nodata) {
    return run({"los", "dem.amt", "--from", "1205,1615,20", "--to", "1405,1615,20", "--nodata", nodata,
                "--json"})
        .json();
  };
  EXPECT_EQ(verdict("unknown")["verdict"], "unknown");
  EXPECT_NEAR(verdict("unknown")["gap"].get<double>(), 60, 1e-6);
  EXPECT_EQ(verdict("clear")["verdict"], "visible");
  const Json blocked = verdict("blocked");
  EXPECT_EQ(blocked["verdict"], "blocked");
  EXPECT_NEAR(blocked["obstruction"]["distance"].get<double>(), 70, 1e-6);
  EXPECT_TRUE(blocked["obstruction"]["terrainHeight"].is_null());
}

TEST_F(SightCommands, LosTellsRadioPlannersOfFresnelZonesAndClutter) {
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

TEST_F(SightCommands, LosAnswersEveryRowOfAFile) {
  makeModel();
  write("pairs.csv",
        "name,x1,y1,h1,x2,y2,h2\n"
        "low,1105,1895,20,1505,1895,20agl\n"
        "high,1105,1895,140msl,1505,1895,40\n"
        "off,1105,1895,20,1,1,20\n"
        "hole,1205,1615,20,1405,1615,20\n");
  const Outcome csv = run({"los", "dem.amt", "--pairs", "pairs.csv"});
  ASSERT_EQ(csv.code, 0) << csv.err;
  EXPECT_NE(csv.err.find("1 of 4 lines have no answer"), std::string::npos) << csv.err;
  const auto lines = linesOf(csv.out);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(
      lines[0],
      "name,h1,h2,x1,y1,height1,x2,y2,height2,verdict,distance,azimuth,elevation,clearance,"
      "clearance_within,obstruction_x,obstruction_y,obstruction_height,obstruction_distance,gap,visited,"
      "error");
  EXPECT_EQ(lines[1].rfind("low,20,20agl,1105,1895,120,1505,1895,120,blocked,400,90,0,-10,0,1301.6666666", 0),
            0u)
      << lines[1];
  EXPECT_EQ(lines[2].rfind("high,140msl,40,1105,1895,140,1505,1895,140,visible,400,90,0,10,0,,,,,0,", 0), 0u)
      << lines[2];
  EXPECT_NE(lines[3].find("has no terrain below it"), std::string::npos) << lines[3];
  EXPECT_NE(lines[4].find(",unknown,200,90,0,"), std::string::npos) << lines[4];

  ASSERT_EQ(run({"los", "dem.amt", "--pairs", "pairs.csv", "-o", "a.csv", "--threads", "1"}).code, 0);
  EXPECT_EQ(read("a.csv"), csv.out);
  const Outcome gpkg = run({"los", "dem.amt", "--pairs", "pairs.csv", "-o", "a.gpkg", "--json"});
  ASSERT_EQ(gpkg.code, 0) << gpkg.err;
  EXPECT_EQ(gpkg.json()["visible"], 1);
  EXPECT_EQ(gpkg.json()["failed"], 1);
  // What was written can be asked about again, as lines.
  const Outcome again =
      run({"los", "dem.amt", "--pairs", "a.gpkg", "-q", "--json", "--observer-height", "20"});
  EXPECT_EQ(again.json()["lines"], 4);
  EXPECT_EQ(again.json()["answers"][1]["verdict"], "visible") << again.err;
  ASSERT_EQ(run({"los", "dem.amt", "--pairs", "pairs.csv", "-o", "a.json", "-q"}).code, 0);
  EXPECT_EQ(readJson("a.json")["answers"][0]["verdict"], "blocked");
}

TEST_F(SightCommands, LosTakesOneEndAndManyOthers) {
  makeModel();
  write("sites.csv", "x;y;h\n1505;1895;20\n1205;1895;2\n1505;1995;80\n");
  const Json json =
      run({"los", "dem.amt", "--from", "1105,1895,20", "--points", "sites.csv", "--json"}).json();
  EXPECT_EQ(json["lines"], 3);
  EXPECT_EQ(json["blocked"], 1);
  EXPECT_EQ(json["answers"][1]["to"], Json::parse("[1205.0, 1895.0]"));
  const Json back = run({"los", "dem.amt", "--to", "1105,1895,20", "--points", "sites.csv", "--json"}).json();
  EXPECT_EQ(back["blocked"], 1);
  EXPECT_NEAR(back["answers"][0]["azimuth"].get<double>(), 270, 1e-9);
  write("rays.csv", "x1,y1,azimuth,range\n1105,1895,90,400\n1105,1895,0,50\n");
  const Json rays = run({"los", "dem.amt", "--pairs", "rays.csv", "--observer-height", "20",
                         "--target-height", "20", "--json"})
                        .json();
  EXPECT_EQ(rays["answers"][0]["verdict"], "blocked");
  EXPECT_EQ(rays["answers"][1]["verdict"], "visible");
  EXPECT_NEAR(rays["answers"][1]["to"][1].get<double>(), 1945, 1e-9);
}

TEST_F(SightCommands, LosGoesOverTheEllipsoidWhereThereIsACrs) {
  makeModel("EPSG:32632");
  const std::vector<std::string> arguments = {"los",  "dem.amt",           "--from", "500105,5199895,20",
                                              "--to", "500505,5199895,20", "--json"};
  const Json curved = run(arguments).json();
  EXPECT_EQ(curved["earth"], "ellipsoid");
  EXPECT_NEAR(curved["distance"].get<double>(), 400 / 0.9996, 1e-3);
  std::vector<std::string> flat = arguments;
  flat.insert(flat.end(), {"--earth", "plane"});
  EXPECT_NEAR(run(flat).json()["distance"].get<double>(), 400, 1e-9);
  const Json lonLat = run({"los", "dem.amt", "--lonlat", "--from", "9.0013,46.9528,20", "--to",
                           "9.0066,46.9528,20", "--json"})
                          .json();
  EXPECT_EQ(lonLat["verdict"], "blocked") << lonLat;
  EXPECT_NEAR(lonLat["azimuth"].get<double>(), 90, 0.01);
}

TEST_F(SightCommands, LosRefusesWhatMakesNoSense) {
  makeModel();
  write("pairs.csv", "x1,y1,x2,y2\n1105,1895,1505,1895\n");
  write("none.csv", "a,b\n1,2\n");
  refused({"los", "dem.amt"}, 2, "--from and --to say where");
  refused({"los", "dem.amt", "--from", "1,1,1"}, 2, "--from and --to say where");
  refused({"los", "dem.amt", "--from", "1,1,1", "--pairs", "pairs.csv"}, 2, "have no place");
  refused({"los", "dem.amt", "--points", "pairs.csv"}, 2, "needs either --from or --to");
  refused({"los", "dem.amt", "--from", "1,1,1", "--to", "1105,1895,2"}, 4, "has no terrain below it");
  refused({"los", "dem.amt", "--from", "1,1", "--to", "1105,1895,2"}, 2, "a position is X,Y,H");
  refused({"los", "dem.amt", "--pairs", "none.csv"}, 4, "has no columns x1 and y1");
  refused({"los", "dem.amt", "--pairs", "nowhere.csv"}, 3, "there is no such file");
  refused({"los", "dem.amt", "--pairs", "pairs.csv", "-o", "a.txt"}, 2, "ends in .csv, .gpkg or .json");
  refused({"los", "dem.amt", "--pairs", "pairs.csv", "-o", "pairs.csv"}, 2, "is the input");
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
  line("--observer-height", "5", "--observer-height: is of ends from a file");
  line("--target-height", "5", "--target-height: is of ends from a file");
  refused({"profile", "dem.amt", "--along", "1105,1895,2:1205,1895,2", "--fresnel", "0.5"}, 2,
          "--fresnel requires --frequency");
  refused({"profile", "dem.amt", "--along", "1105,1895:1205,1895", "--layer", "roads"}, 2,
          "--layer: means something only with --along FILE");
  line("--refraction", "0.25", "--refraction: bends lines over an ellipsoid");
  write("road.csv", "WKT\n\"LINESTRING (1105 1895,1205 1895)\"\n");
  refused({"profile", "dem.amt", "--along", "road.csv", "--lonlat"}, 2, "--lonlat: ");
  const Outcome heightless = run({"los", "dem.amt", "--pairs", "pairs.csv"});
  EXPECT_EQ(heightless.code, 4);
  EXPECT_NE(heightless.err.find("has no height; --observer-height says one"), std::string::npos);
}

TEST_F(SightCommands, MethodsThatCannotAnswerAreRefusedByName) {
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
           "--method sweep: has no tolerance, so --max-error has no place");
  for (const char* mode : {"height", "horizon"})
    viewshed({"--observer", at, "--method", "sweep", "--mode", mode}, "--method sweep: over an ellipsoid");
  viewshed({"--observer", at, "--method", "sweep", "--like", "dem.tif"}, "--method sweep: is for the grid");
  std::string points = "x,y,z\n";
  for (int i = 0; i < 40; ++i) points += fmt::format("{},{},{}\n", i * 37 % 40, i * 17 % 40, i % 7);
  write("points.csv", points);
  const Outcome built = run({"build", "points.csv", "-o", "points.amt", "-q"});
  ASSERT_EQ(built.code, 0) << built.err;
  viewshed({"--observer", "20,20,20"}, "points.amt: a viewshed is for rasters", "points.amt");
  for (const char* method : {"pyramid", "scan", "embree"})
    refused({"los", "points.amt", "--from", "20,20,5", "--to", "10,20,5", "--method", method}, 2,
            std::string("--method ") + method + ": is for rasters");
  EXPECT_EQ(run({"los", "points.amt", "--from", "20,20,5", "--to", "10,20,5"}).code, 0);
}

TEST_F(SightCommands, ProfileHasAVertexForEveryEdge) {
  makeModel();
  const Outcome outcome = run({"profile", "dem.amt", "--along", "1285,1895:1325,1895"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "line,part,distance,x,y,height\n1,1,0,1285,1895,100\n1,1,10,1295,1895,100\n1,1,20,1305,1895,130\n"
            "1,1,30,1315,1895,100\n1,1,40,1325,1895,100\n");
  const Json corner =
      run({"profile", "dem.amt", "--along", "1105,1895:1205,1895:1205,1795", "--json"}).json();
  EXPECT_NEAR(corner["lines"][0]["length"].get<double>(), 200, 1e-9);
  EXPECT_EQ(corner["lines"][0]["vertices"].back()["y"], 1795);
  const Json hole = run({"profile", "dem.amt", "--along", "1205,1615:1405,1615", "--json"}).json();
  EXPECT_NEAR(hole["lines"][0]["gap"].get<double>(), 60, 1e-9);
  const Json coarse =
      run({"profile", "dem.amt", "--along", "1105,1895:1505,1895", "--max-error", "40", "--json"}).json();
  EXPECT_LT(coarse["lines"][0]["vertices"].size(), 41u);
}

TEST_F(SightCommands, ProfileRefusesNodataWhereNothingLooksAlongIt) {
  makeRaster("hills.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "hills.tif", "-o", "hills.amt", "-q"}).code, 0);
  const std::vector<std::string> along = {"profile", "hills.amt", "--along", "500100,5199900:500200,5199800",
                                          "--earth", "plane"};
  auto withNodata = along;
  withNodata.insert(withNodata.end(), {"--nodata", "clear"});
  const Outcome refused = run(withNodata);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--nodata: is for a line of sight"), std::string::npos) << refused.err;
  auto asJson = along;
  asJson.push_back("--json");
  EXPECT_TRUE(run(asJson).json()["refraction"].is_null()) << "lines over a plane do not bend";
}

TEST_F(SightCommands, LosTellsAnEndWithoutAPlace) {
  makeRaster("hills.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "hills.tif", "-o", "hills.amt", "-q"}).code, 0);
  write("pairs.csv", "x1,y1,h1,x2,y2,h2\n,,5,500100,5199900,5\n");
  const Outcome outcome = run({"los", "hills.amt", "--pairs", "pairs.csv"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("has no place"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("CRS can tell"), std::string::npos) << outcome.err;
}

TEST_F(SightCommands, ProfileDrawsTheLineOfSight) {
  makeModel();
  const Outcome outcome = run({"profile", "dem.amt", "--along", "1105,1895,20:1505,1895,20", "--frequency",
                               "900", "--png", "p.png", "-o", "p.csv", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json line = outcome.json()["lines"][0];
  EXPECT_EQ(line["verdict"], "blocked");
  EXPECT_NEAR(line["obstructionDistance"].get<double>(), 200 - 10.0 / 3, 1e-6);
  EXPECT_LT(line["fresnel"].get<double>(), 0);
  EXPECT_EQ(read("p.png").substr(1, 3), "PNG");
  EXPECT_EQ(linesOf(read("p.csv"))[0], "line,part,distance,x,y,height,line_height,clearance,fresnel_radius");
  write("a.geojson",
        R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":
           {"type":"LineString","coordinates":[[1105,1895],[1505,1895]]}}]})");
  refused({"profile", "dem.amt", "--along", "nowhere.gpkg"}, 2, "is no file and no line");
  refused({"profile", "dem.amt", "--along", "1,1:2,2"}, 4, "has no terrain there");
  refused({"profile", "dem.amt", "--along", "1105,1895,2:1505,1895"}, 2, "heights make a line of sight");
  refused({"profile", "dem.amt", "--along", "1105,1895:1505,1895", "--frequency", "9"}, 2,
          "needs a line of sight");
}

TEST_F(SightCommands, ViewshedHasTheAnswersOfLos) {
  makeModel();
  const Outcome outcome = run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--target-height", "2",
                               "-o", "seen.tif", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto seen = readRaster(path("seen.tif"));
  ASSERT_TRUE(seen);
  const RasterHeightfield& field = seen->heightfield;
  ASSERT_EQ(field.columns, 61u);
  std::string sites = "x,y,h\n";
  std::vector<double> expected;
  for (std::uint32_t row = 0; row < field.rows; row += 3)
    for (std::uint32_t column = 0; column < field.columns; column += 3) {
      const Vec2 xy = field.georeference.toSource(column, row);
      if (std::isnan(field.at(column, row))) continue;
      sites += fmt::format("{},{},2\n", xy.x, xy.y);
      expected.push_back(field.at(column, row));
    }
  write("sites.csv", sites);
  const Json los =
      run({"los", "dem.amt", "--from", "1105,1895,20", "--points", "sites.csv", "--json"}).json();
  ASSERT_EQ(los["answers"].size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::string verdict = los["answers"][i]["verdict"];
    EXPECT_EQ(expected[i], verdict == "visible" ? 255 : verdict == "blocked" ? 0 : 100) << los["answers"][i];
  }
}

TEST_F(SightCommands, ViewshedTakesTheGridOfAnotherRaster) {
  makeModel();
  ASSERT_EQ(run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "-o", "seen.tif", "-q"}).code, 0);
  ASSERT_EQ(
      run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--like", "seen.tif", "-o", "like.tif", "-q"})
          .code,
      0);
  const auto seen = readRaster(path("seen.tif")), like = readRaster(path("like.tif"));
  ASSERT_TRUE(seen && like);
  ASSERT_EQ(like->heightfield.size(), seen->heightfield.size());
  for (std::size_t i = 0; i < seen->heightfield.size(); ++i) {
    const double a = seen->heightfield.heights[i], b = like->heightfield.heights[i];
    EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << i;
  }
  // Twice as coarse: every other sample.
  RasterHeightfield half;
  half.georeference = seen->heightfield.georeference;
  half.columns = (seen->heightfield.columns + 1) / 2;
  half.rows = (seen->heightfield.rows + 1) / 2;
  half.heights.assign(std::size_t{half.columns} * half.rows, 1);
  auto& g = half.georeference.geoTransform;
  g = {g[0] - g[1] / 2, 2 * g[1], 0, g[3] - g[5] / 2, 0, 2 * g[5]};
  ASSERT_TRUE(writeGeoTiff(path("half.tif"), half.columns, half.rows, half.heights, half.georeference));
  ASSERT_EQ(
      run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--like", "half.tif", "-o", "half_seen.tif"})
          .code,
      0);
  const auto coarse = readRaster(path("half_seen.tif"));
  ASSERT_TRUE(coarse);
  ASSERT_EQ(coarse->heightfield.columns, half.columns);
  for (std::uint32_t row = 0; row < half.rows; ++row)
    for (std::uint32_t column = 0; column < half.columns; ++column) {
      const double a = seen->heightfield.at(2 * column, 2 * row), b = coarse->heightfield.at(column, row);
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << column << ", " << row;
    }
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--observer", "1205,1895,20", "--like",
           "half.tif", "-o", "v.tif"},
          2, "is for one observer");
  // Somewhere else.
  g[0] += 5000;
  ASSERT_TRUE(writeGeoTiff(path("far.tif"), half.columns, half.rows, half.heights, half.georeference));
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--like", "far.tif", "-o", "v.tif"}, 2,
          "--like far.tif: has no sample within the DEM");
  EXPECT_FALSE(exists("v.tif"));
}

TEST_F(SightCommands, ViewshedTakesTheGridOfAPicture) {
  makeModel();
  write("photo.ppm", "P6\n3 2\n255\n" + std::string(18, 'x'));
  write("photo.wld", "200\n0\n0\n-50\n1105\n1895\n");
  const Outcome made = run(
      {"viewshed", "dem.amt", "--observer", "1105,1895,20", "--like", "photo.ppm", "-o", "seen.tif", "-q"});
  ASSERT_EQ(made.code, 0) << made.err;
  const auto seen = readRaster(path("seen.tif"));
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->heightfield.heights, (std::vector<double>{255, 255, 0, 255, 255, 0}));  // behind the wall
}

TEST_F(SightCommands, ViewshedOfManyCountsAndNamesTheNearest) {
  makeModel();
  write("masts.csv", "x,y\n1105,1895\n1505,1895\n1515,1895\n");
  const auto valueAt = [&](const std::string& file, double x, double y) {
    const auto read = readRaster(path(file));
    EXPECT_TRUE(read);
    const Vec2 at = read->heightfield.georeference.toGrid(x, y);
    return read->heightfield.at(std::uint32_t(std::lround(at.x)), std::uint32_t(std::lround(at.y)));
  };
  const auto make = [&](const char* mode) {
    const Outcome outcome = run({"viewshed", "dem.amt", "--observers", "masts.csv", "--observer-height", "20",
                                 "--mode", mode, "-o", "v.tif", "-q"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  };
  make("count");
  EXPECT_EQ(valueAt("v.tif", 1205, 1895), 1);
  EXPECT_EQ(valueAt("v.tif", 1405, 1895), 2);
  EXPECT_EQ(valueAt("v.tif", 1305, 1895), 3);
  make("server");
  EXPECT_EQ(valueAt("v.tif", 1205, 1895), 1);
  EXPECT_EQ(valueAt("v.tif", 1405, 1895), 2);
  EXPECT_EQ(valueAt("v.tif", 1575, 1895), 3);
  make("seen");
  EXPECT_EQ(valueAt("v.tif", 1205, 1895), 255);
  ASSERT_EQ(
      run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--mode", "height", "-o", "v.tif", "-q"})
          .code,
      0);
  // Over the wall at 200 m, 10 above the observer, the line has risen by 20 at 400 m: 140 over a plain of
  // 100.
  EXPECT_NEAR(valueAt("v.tif", 1505, 1895), 40, 1e-4);
  ASSERT_EQ(
      run({"viewshed", "dem.amt", "--observer", "1105,1895,20", "--mode", "horizon", "-o", "v.tif", "-q"})
          .code,
      0);
  EXPECT_NEAR(valueAt("v.tif", 1505, 1895), std::atan(10.0 / 200) * 180 / 3.14159265358979, 1e-4);
}

TEST_F(SightCommands, ViewshedOfManyTakesNobodyForBlindWhoMaySee) {
  makeModel();
  const auto valuesOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"viewshed", "dem.amt", "--observer", "1205,1615,20",
                                          "-o",       "v.tif",   "--observer", "1105,1615,20",
                                          "-q",       "--nodata"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    auto read = readRaster(path("v.tif"));
    EXPECT_TRUE(read);
    return read ? std::move(read->heightfield.heights) : std::vector<double>();
  };
  // Behind the hole neither is known to see anything, before it both do.
  const std::size_t behind = 38 * 61 + 40, before = 38 * 61 + 22;
  for (const char* mode : {"count", "server"}) {
    const auto unknown = valuesOf({"unknown", "--mode", mode});
    EXPECT_EQ(unknown[behind], 65533) << mode;
    EXPECT_EQ(unknown[before], mode == std::string("count") ? 2 : 1);
    EXPECT_LT(valuesOf({"clear", "--mode", mode})[behind], 3) << mode;
    const auto exact = valuesOf({"clear", "--mode", mode}),
               within = valuesOf({"clear", "--mode", mode, "--max-error", "40"});
    std::size_t undecided = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      if (within[i] == 65534) {
        ++undecided;
      } else {
        EXPECT_TRUE(within[i] == exact[i] || std::isnan(exact[i])) << mode << " " << i;
      }
    }
    EXPECT_GT(undecided, 0u) << mode;
  }
}

TEST_F(SightCommands, ViewshedTellsNoHeightBehindNodata) {
  makeModel();
  const auto valuesOf = [&](const char* mode, const char* nodata) {
    const Outcome outcome = run({"viewshed", "dem.amt", "--observer", "1205,1615,20", "--mode", mode,
                                 "--nodata", nodata, "-o", "v.tif", "-q"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    auto read = readRaster(path("v.tif"));
    EXPECT_TRUE(read);
    return read ? std::move(read->heightfield.heights) : std::vector<double>();
  };
  const std::size_t behind = 38 * 61 + 40, before = 38 * 61 + 22;
  for (const char* nodata : {"unknown", "clear", "blocked"})
    EXPECT_EQ(valuesOf("height", nodata)[before], 0) << nodata;
  EXPECT_TRUE(std::isnan(valuesOf("height", "unknown")[behind]));
  EXPECT_EQ(valuesOf("height", "clear")[behind], 0);
  // Infinite, which a reader of heights takes for NODATA.
  EXPECT_FALSE(std::isfinite(valuesOf("height", "blocked")[behind]));
  EXPECT_EQ(valuesOf("horizon", "blocked")[behind], 90);
  // Beside the hole and behind the wall a height is known.
  EXPECT_GT(valuesOf("height", "unknown")[2 * 61 + 40], 0);
}

TEST_F(SightCommands, ViewshedRefusesWhatMakesNoSense) {
  makeModel();
  write("masts.csv", "x,y\n1105,1895\n");
  refused({"viewshed", "dem.amt", "-o", "v.tif"}, 2, "says from where");
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "--observer-height", "5", "-o", "v.tif"}, 2,
          "--observer-height: is of --observers");
  refused({"viewshed", "dem.amt", "--observer", "1,1,2", "-o", "v.tif"}, 4, "has no terrain below it");
  refused({"viewshed", "dem.amt", "--observers", "masts.csv", "-o", "v.tif"}, 2, "has no height");
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "--observer", "1205,1895,2", "--mode",
           "height", "-o", "v.tif"},
          2, "is of one observer");
  for (const char* output : {"v.png", "v.csv", "v", "v.tif.gz"}) {
    refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "-o", output}, 2,
            std::string("--output ") + output + ": a viewshed is a GeoTIFF and ends in .tif or .tiff");
    EXPECT_FALSE(exists(output));
  }
  EXPECT_EQ(run({"viewshed", "dem.amt", "--observer", "1105,1895,2", "-o", "V.TIFF", "-q"}).code, 0);
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "--azimuth", "3", "-o", "v.tif"}, 2,
          "is two numbers");
  for (const char* nothing : {"10,10", "370,-350"})
    refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "--azimuth", nothing, "-o", "v.tif"}, 2,
            std::string("--azimuth ") + nothing + ": is no field of view");
  refused({"viewshed", "dem.amt", "--observer", "1105,1895,2", "--radius", "100", "--min-distance", "200",
           "-o", "v.tif"},
          2, "--min-distance 200: is beyond --radius 100");
  write("sectors.csv", "x,y,h,range\n1105,1895,2,300\n1105,1895,2,150\n");
  refused({"viewshed", "dem.amt", "--observers", "sectors.csv", "--min-distance", "200", "-o", "v.tif"}, 4,
          "sectors.csv, row 2: has a range below --min-distance 200");
  EXPECT_FALSE(exists("v.tif"));
}

}  // namespace
}  // namespace arete::cli_test
