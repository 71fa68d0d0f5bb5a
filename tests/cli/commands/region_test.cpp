// SPDX-License-Identifier: GPL-3.0-or-later
//
// What --region says of extract and measure: boxes, files of polygons and lines.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "cli/cli_fixture.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

using Regions = Cli;

TEST_F(Regions, RefinesARegionOnRotatedSouthUpAndNorthUpGrids) {
  for (const char* family : {"fractal", "rotated", "south up"}) {
    SCOPED_TRACE(family);
    makeRaster("dem.tif", family, 80, 80);
    ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
    const auto raster = readRaster(path("dem.tif"));
    ASSERT_TRUE(raster);
    const Vec2 centre = raster->heightfield.georeference.toSource(40, 40);
    const Vec2 step = groundStep(raster->heightfield.georeference, 40, 40);
    const std::string box = fmt::format("{},{},{},{}", centre.x - 8 * step.x, centre.y - 8 * step.y,
                                        centre.x + 8 * step.x, centre.y + 8 * step.y);
    const Outcome outcome = run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "0.5", "--region", box,
                                 "--outside-error", "30", "--certificate", "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json tin = outcome.json()["exports"][0];
    EXPECT_EQ(tin["kept"], true);
    EXPECT_GT(tin["measuredInside"]["samples"]["valid"], 100);
    EXPECT_LE(tin["measuredInside"]["error"]["maximum"], 0.5 + 1e-6);
    EXPECT_LE(tin["measured"]["error"]["maximum"], 30 + 1e-6);
    EXPECT_GT(tin["measured"]["error"]["maximum"], 0.5);
    EXPECT_EQ(run({"measure", "tin.ply", "dem.tif", "--expect", "0.5", "--region", box}).code, 0);
    EXPECT_EQ(run({"measure", "tin.ply", "dem.tif", "--expect", "0.5"}).code, 5);
  }
}

TEST_F(Regions, ReadsARegionFromAFile) {
  makeRaster("dem.tif", "geographic", 60, 60);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const auto raster = readRaster(path("dem.tif"));
  ASSERT_TRUE(raster);
  const auto corner = [&](double c, double r) {
    const Vec2 p = raster->heightfield.georeference.toSource(c, r);
    return fmt::format("[{},{}]", p.x, p.y);
  };
  write("park.geojson", R"({"type":"Polygon","coordinates":[[)" + corner(20, 20) + "," + corner(40, 22) +
                            "," + corner(30, 40) + "," + corner(20, 20) + "]]}");
  const Outcome outcome = run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "0.5", "--region",
                               "park.geojson", "--certificate"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(run({"measure", "tin.ply", "dem.tif", "--expect", "0.5", "--region", "park.geojson"}).code, 0);
}

TEST_F(Regions, AreFoundWholeTurnsOfLongitudeAway) {
  makeRaster("dem.tif", "geographic", 60, 60);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const auto raster = readRaster(path("dem.tif"));
  ASSERT_TRUE(raster);
  const Georeference& georeference = raster->heightfield.georeference;
  const Vec2 northWest = georeference.toSource(18.3, 20.4), southEast = georeference.toSource(40.2, 42.3);
  std::vector<std::string> tins;
  for (const double turn : {0.0, 360.0, -720.0}) {
    const std::string box = fmt::format("{:.12f},{:.12f},{:.12f},{:.12f}", northWest.x + turn, southEast.y,
                                        southEast.x + turn, northWest.y);
    const Outcome outcome =
        run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "0.5", "--region=" + box});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(run({"measure", "tin.ply", "dem.tif", "--expect", "0.5", "--region=" + box}).code, 0);
    const std::string tin = read("tin.ply");
    tins.push_back(tin.substr(tin.find("end_header")));  // a comment before it tells the box as it was said
  }
  EXPECT_TRUE(tins[0] == tins[1]);
  EXPECT_TRUE(tins[0] == tins[2]);
  // Half a turn away is another place.
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "0.5", "--region=190,59,191,61"}).code,
            2);
}

TEST_F(Regions, IsFineAlongALineAndSaysSo) {
  makeRaster("dem.tif", "fractal", 90, 70);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const RasterHeightfield field = readRaster(path("dem.tif"))->heightfield;
  const Vec2 a = field.georeference.toSource(10, 60), b = field.georeference.toSource(80, 5);
  // GeoJSON would say longitude and latitude; CSV says nothing, as the raster does.
  write("road.csv", fmt::format("id,WKT\n1,\"LINESTRING ({} {},{} {})\"\n", a.x, a.y, b.x, b.y));
  const double step = std::abs(field.georeference.geoTransform[1]);
  const std::string distance = fmt::format("{}", 3 * step);
  const Outcome without =
      run({"extract", "dem.amt", "-o", "r.ply", "--max-error", "0.5", "--region", "road.csv"});
  EXPECT_EQ(without.code, 2);
  EXPECT_NE(without.err.find("--distance"), std::string::npos) << without.err;
  const Outcome extracted = run({"extract", "dem.amt", "-o", "r.ply", "--max-error", "0.5", "--region",
                                 "road.csv", "--distance", distance, "--certificate", "c.json"});
  ASSERT_EQ(extracted.code, 0) << extracted.err;
  const Outcome measured =
      run({"measure", "r.ply", "dem.tif", "--region", "road.csv", "--distance", distance, "--expect", "0.5"});
  EXPECT_EQ(measured.code, 0) << measured.err;
  EXPECT_EQ(run({"measure", "r.ply", "dem.tif", "--expect", "0.5"}).code, 5) << "coarse elsewhere";
  EXPECT_TRUE(readJson("c.json")["promise"]["kept"]);
  EXPECT_EQ(readJson("c.json")["criterion"]["distance"], 3 * step);
}

}  // namespace
}  // namespace arete::cli_test
