// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of sight from the rows of a file: an answer or a reason for each.
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

using SightRowsOfFiles = SightCommands;

TEST_F(SightRowsOfFiles, AnswersEveryRowOfAFile) {
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

TEST_F(SightRowsOfFiles, TakesOneEndAndManyOthers) {
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

TEST_F(SightRowsOfFiles, TellsAnEndWithoutAPlace) {
  makeRaster("hills.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "hills.tif", "-o", "hills.amt", "-q"}).code, 0);
  write("pairs.csv", "x1,y1,h1,x2,y2,h2\n,,5,500100,5199900,5\n");
  const Outcome outcome = run({"los", "hills.amt", "--pairs", "pairs.csv"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("has no coordinates"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("cannot be expressed"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace arete::cli_test
