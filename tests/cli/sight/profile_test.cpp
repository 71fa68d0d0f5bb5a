// SPDX-License-Identifier: GPL-3.0-or-later
// arete profile over a plain with a wall.
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

using Profiles = SightCommands;

TEST_F(Profiles, HasAVertexForEveryEdge) {
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

TEST_F(Profiles, RefusesNodataWhereNothingLooksAlongIt) {
  makeRaster("hills.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "hills.tif", "-o", "hills.amt", "-q"}).code, 0);
  const std::vector<std::string> along = {"profile", "hills.amt", "--along", "500100,5199900:500200,5199800",
                                          "--earth", "plane"};
  auto withNodata = along;
  withNodata.insert(withNodata.end(), {"--nodata", "clear"});
  const Outcome refused = run(withNodata);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--nodata: requires a line of sight"), std::string::npos) << refused.err;
  auto asJson = along;
  asJson.push_back("--json");
  EXPECT_TRUE(run(asJson).json()["refraction"].is_null()) << "lines over a plane do not bend";
}

TEST_F(Profiles, DrawsTheLineOfSight) {
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
  refused({"profile", "dem.amt", "--along", "1,1:2,2"}, 4, "has no terrain along the line");
  refused({"profile", "dem.amt", "--along", "1105,1895,2:1505,1895"}, 2, "heights are for a line of sight");
  refused({"profile", "dem.amt", "--along", "1105,1895:1505,1895", "--frequency", "9"}, 2,
          "requires a line of sight");
}

TEST_F(Profiles, StatesWhatIsAssumedWhereThereIsNoData) {
  makeModel();
  // Through the hole at the southern end of the wall.
  const auto of = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"profile", "dem.amt", "--along", "1105,1615,40:1505,1615,40",
                                      "--png",   "p.png",   "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json();
  };
  const Json unknown = of({});
  EXPECT_EQ(unknown["nodata"], "unknown");
  EXPECT_EQ(unknown["lines"][0]["verdict"], "unknown");
  const std::string drawn = read("p.png");
  const Json clear = of({"--nodata", "clear"});
  EXPECT_EQ(clear["nodata"], "clear");
  EXPECT_EQ(clear["lines"][0]["verdict"], "visible");
  EXPECT_NE(read("p.png"), drawn);
}

TEST_F(Profiles, DrawsTheGroundBelowALineOfSightAtFullResolution) {
  makeModel();
  const auto draw = [&](const std::string& line, const std::string& error) {
    const Outcome outcome =
        run({"profile", "dem.amt", "--along", line, "--max-error", error, "--png", "p.png", "-q"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read("p.png");
  };
  const std::string sight = "1105,1895,20:1505,1895,20", plain = "1105,1895:1505,1895";
  EXPECT_EQ(draw(sight, "50"), draw(sight, "0"));
  EXPECT_NE(draw(plain, "50"), draw(plain, "0"));
  refused({"profile", "dem.amt", "--along", "1105,1895,10:1105,1895,20", "--png", "q.png"}, 4,
          "--along 1105,1895,10:1105,1895,20: has no length");
  EXPECT_FALSE(exists("q.png"));
}

TEST_F(Profiles, SaysWhatItWroteAndWhatHasNoTerrain) {
  makeModel();
  const Outcome whole = run({"profile", "dem.amt", "--along", "1105,1895:1205,1895", "--png", "p.png"});
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(whole.err, "");
  EXPECT_EQ(linesOf(whole.out)[0], "p.png: a profile of 0.1 km");
  // The DEM ends at x 1605.
  const Outcome part = run({"profile", "dem.amt", "--along", "1505,1895:1705,1895", "--png", "p.png"});
  ASSERT_EQ(part.code, 0) << part.err;
  EXPECT_NE(part.err.find("100 of 200 m have no terrain below"), std::string::npos) << part.err;
  refused({"profile", "dem.amt", "--along", "1105,1895:1205,1895", "-o", "x.png"}, 2,
          "--output x.png: a profile is written as .csv; --png draws it as a picture");
}

TEST_F(Profiles, TakesTheOnlyLayerWithLines) {
  makeModel("EPSG:32632");
  // GPX has a layer for routes and one for tracks; both exist whenever it is opened.
  write("track.gpx",
        R"(<gpx version="1.1" creator="x" xmlns="http://www.topografix.com/GPX/1/1"><trk><trkseg>)"
        R"(<trkpt lat="46.9525" lon="9.001"/><trkpt lat="46.951" lon="9.006"/></trkseg></trk></gpx>)");
  const Outcome one = run({"profile", "dem.amt", "--along", "track.gpx", "-o", "t.csv"});
  EXPECT_EQ(one.code, 0) << one.err;
  write("both.gpx",
        R"(<gpx version="1.1" creator="x" xmlns="http://www.topografix.com/GPX/1/1"><rte>)"
        R"(<rtept lat="46.9525" lon="9.001"/><rtept lat="46.951" lon="9.006"/></rte><trk><trkseg>)"
        R"(<trkpt lat="46.9525" lon="9.001"/><trkpt lat="46.951" lon="9.006"/></trkseg></trk></gpx>)");
  refused({"profile", "dem.amt", "--along", "both.gpx"}, 3, "--layer");
  EXPECT_EQ(run({"profile", "dem.amt", "--along", "both.gpx", "--layer", "routes", "-q"}).code, 0);
}

TEST_F(Profiles, TakesTheRowsOfATextForTheVerticesOfALine) {
  makeModel("EPSG:32632");
  const Outcome typed =
      run({"profile", "dem.amt", "--along", "500105,5199895:500205,5199895:500205,5199800"});
  ASSERT_EQ(typed.code, 0) << typed.err;
  write("way.csv", "x,y\n500105,5199895\n500205,5199895\n500205,5199800\n");
  write("way.xyz", "500105 5199895\n500205 5199895\n500205 5199800\n");
  for (const char* name : {"way.csv", "way.xyz"}) {
    const Outcome rows = run({"profile", "dem.amt", "--along", name});
    EXPECT_EQ(rows.code, 0) << rows.err;
    EXPECT_EQ(rows.out, typed.out) << name;
    EXPECT_NE(rows.err.find("its 3 rows are the vertices of one line"), std::string::npos) << rows.err;
  }
  write("degrees.csv", "lon,lat\n9.001,46.9525\n9.006,46.951\n");
  refused({"profile", "dem.amt", "--along", "degrees.csv"}, 4, "longitude,latitude? add --lonlat");
  EXPECT_EQ(run({"profile", "dem.amt", "--along", "degrees.csv", "--lonlat", "-q"}).code, 0);
  write("one.csv", "x,y\n500105,5199895\n");
  refused({"profile", "dem.amt", "--along", "one.csv"}, 4, "one.csv: holds no line");
  write("hole.csv", "x,y\n500105,5199895\n,5199895\n");
  refused({"profile", "dem.amt", "--along", "hole.csv"}, 4, "hole.csv, row 2: has no place");
}

TEST_F(Profiles, AsksWhetherAFrequencyIsInMegahertz) {
  makeModel();
  refused({"profile", "dem.amt", "--along", "1105,1895,1:1205,1895,1", "--frequency", "2.4GHz"}, 2,
          "'2.4GHz' is not a number of MHz");
  refused({"los", "dem.amt", "--from", "1105,1895,1", "--to", "1205,1895,1", "--frequency", "2.4GHz"}, 2,
          "'2.4GHz' is not a number of MHz");
}

}  // namespace
}  // namespace arete::cli_test
