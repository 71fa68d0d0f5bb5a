// SPDX-License-Identifier: GPL-3.0-or-later
// arete build: points, features, threads, terminals.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "cli/cli_fixture.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

using BuildCommand = Cli;

TEST_F(BuildCommand, TakesScatteredPoints) {
  std::string text = "x,y,z\n";
  const PointHeightfield points = pointFamilies().front().make(400, 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{},{},{}\n", points.positions[i].x, points.positions[i].y, points.heights[i]);
  write("points.csv", text);
  const Outcome built = run({"build", "points.csv", "-o", "p.amt", "--crs", "EPSG:32611"});
  ASSERT_EQ(built.code, 0) << built.err;
  ASSERT_EQ(run({"extract", "p.amt", "-o", "p.ply", "--max-error", "1", "--certificate"}).code, 0);
  const Outcome measured =
      run({"measure", "p.ply", "points.csv", "--crs", "EPSG:32611", "--expect", "1", "--json"});
  ASSERT_EQ(measured.code, 0) << measured.err;
  const Json found = measured.json()["error"],
             certified = readJson("p.certificate.json")["measured"]["error"];
  EXPECT_EQ(found["maximum"], certified["maximum"]);
  EXPECT_EQ(found["worst"]["x"], certified["worst"]["x"]);
  EXPECT_FALSE(certified["worst"].contains("point")) << "a model numbers its points in its own way";
  const Outcome noGrid = run({"extract", "p.amt", "-o", "p.tif", "--max-error", "1"});
  EXPECT_EQ(noGrid.code, 2);
  EXPECT_NE(noGrid.err.find("scattered points"), std::string::npos) << noGrid.err;
}

TEST_F(BuildCommand, GivesAPlaceOneHeightByTheRuleStatedAndMeasuresByIt) {
  std::string text = "x,y,z\n";
  for (int i = 0; i < 40; ++i)
    text += std::to_string(i * 7 % 23) + "," + std::to_string(i * 11 % 29) + "," + std::to_string(i) + "\n";
  write("points.csv", text + "0,0,100\n7,11,50\n");
  const Outcome refused = run({"build", "points.csv", "-o", "a.amt"});
  EXPECT_EQ(refused.code, 4);
  EXPECT_NE(refused.err.find("--same-place"), std::string::npos) << refused.err;
  for (const std::string rule : {"min", "max", "mean", "first"}) {
    const Outcome built = run({"build", "points.csv", "-o", rule + ".amt", "--same-place", rule});
    ASSERT_EQ(built.code, 0) << built.err;
    EXPECT_NE(built.err.find("2 places have several heights"), std::string::npos) << built.err;
    ASSERT_EQ(run({"extract", rule + ".amt", "-o", rule + ".ply", "--max-error", "1", "--certificate"}).code,
              0);
    const std::string check = readJson(rule + ".certificate.json")["check"].get<std::string>();
    EXPECT_NE(check.find("--same-place " + rule), std::string::npos) << check;
    EXPECT_EQ(run({"measure", rule + ".ply", "points.csv", "--same-place", rule, "--expect", "1"}).code, 0);
  }
  EXPECT_EQ(run({"measure", "min.ply", "points.csv", "--same-place", "max", "--expect", "1"}).code, 5);
  EXPECT_EQ(run({"build", "points.csv", "-o", "a.amt", "--same-place", "median"}).code, 2);
}

TEST_F(BuildCommand, ReadsPointsFromStdinByTheirNames) {
  write("points.csv", "id,northing,easting,height\na,0,0,1\nb,1,5,2\nc,7,1,3\nd,9,9,4\n");
  ASSERT_EQ(run({"build", "points.csv", "-o", "file.amt"}).code, 0);
  for (const char* name : {"-", "/vsistdin/"}) {
    const std::string command = "cd '" + path("") + "' && cat points.csv | '" ARETE_PROGRAM "' build " +
                                std::string(name) + " -o stdin.amt > said 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << read("said");
    EXPECT_EQ(run({"height", "stdin.amt", "--at", "5,1"}).out, "5,1,2\n");
  }
  // More than GDAL keeps of stdin by itself.
  std::string many = "x,y,z\n";
  for (int i = 0; i < 90'000; ++i) many += fmt::format("{},{},{}\n", i % 300, i / 300, 1000 + i % 7);
  write("many.csv", many);
  const std::string whole =
      "cd '" + path("") + "' && cat many.csv | '" ARETE_PROGRAM "' build - -o many.amt --json > said 2>&1";
  ASSERT_EQ(std::system(whole.c_str()), 0) << read("said");
  EXPECT_NE(read("said").find("\"samples\": 90000"), std::string::npos) << read("said");
  const std::string pairs = "cd '" + path("") +
                            "' && printf 'x1,y1,h1,x2,y2,h2\\n0,0,9,5,1,9\\n' | '" ARETE_PROGRAM
                            "' los file.amt --pairs - > said 2>&1";
  EXPECT_EQ(std::system(pairs.c_str()), 0) << read("said");
  const std::string places = "cd '" + path("") +
                             "' && printf 'x,y\\n5,1\\n' | '" ARETE_PROGRAM
                             "' height file.amt --points - > said 2>&1";
  EXPECT_EQ(std::system(places.c_str()), 0) << read("said");
}

TEST_F(BuildCommand, KeepsFeaturesAndFixedPointsInTheRoot) {
  makeRaster("dem.tif", "fractal", 60, 60);
  const auto raster = readRaster(path("dem.tif"));
  ASSERT_TRUE(raster);
  const Vec2 p = raster->heightfield.georeference.toSource(17.3, 22.8);
  write("fixed.csv", fmt::format("x,y\n{},{}\n{},{}\n", p.x, p.y, p.x + 1e7, p.y));
  const Outcome built = run(
      {"build", "dem.tif", "-o", "dem.amt", "--no-features", "--fixed", "fixed.csv", "--json", "--progress"});
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_EQ(built.json()["features"], 0);
  EXPECT_EQ(built.json()["given"], 1);
  EXPECT_EQ(built.json()["fixedVertices"], 1);
  EXPECT_NE(built.err.find("1 of 2 points lies outside"), std::string::npos) << built.err;
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "root.obj", "--max-error", "inf"}).code, 0);
  const Vec2 snapped = raster->heightfield.georeference.toSource(17, 23);
  EXPECT_NE(read("root.obj").find(fmt::format("v {} {} ", snapped.x, snapped.y)), std::string::npos);

  EXPECT_EQ(run({"build", "dem.tif", "-o", "a.amt", "--features", "10", "--json"}).json()["features"], 10);
  const Json creased = run({"build", "dem.tif", "-o", "a.amt", "--crease-angle", "10", "--json"}).json();
  EXPECT_GT(creased["creaseVertices"], 0);
  EXPECT_GE(creased["rootVertices"], creased["fixedVertices"]);
}

TEST_F(BuildCommand, GivesTheSameBytesForAnyNumberOfThreads) {
  makeRaster("dem.tif", "nodata holes", 120, 100);
  for (const std::string threads : {"1", "2", "4"})
    ASSERT_EQ(run({"build", "dem.tif", "-o", threads + ".amt", "--threads", threads}).code, 0);
  EXPECT_EQ(read("1.amt"), read("2.amt"));
  EXPECT_EQ(read("1.amt"), read("4.amt"));
}

TEST_F(BuildCommand, RefusesAShapesOptionWithoutTheShape) {
  makeRaster("dem.tif", "fractal", 20, 20);
  const Outcome refused = run({"build", "dem.tif", "-o", "dem.amt", "--min-aspect", "0.1"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--min-aspect: requires --shape fidelity"), std::string::npos) << refused.err;
  EXPECT_EQ(files(), std::set<std::string>{"dem.tif"});
  EXPECT_EQ(
      run({"build", "dem.tif", "-o", "dem.amt", "--shape", "fidelity", "--min-aspect", "0.1", "-q"}).code, 0);
}

TEST_F(BuildCommand, WritesAFileThatRemembersItsOptions) {
  makeRaster("dem.tif", "fractal", 25, 20);
  const Outcome built = run({"build", "dem.tif", "-o", "dem.amt", "--shape", "fidelity", "--json"});
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_EQ(built.json()["shape"], "fidelity");
  EXPECT_EQ(built.json()["samples"], 500);
  EXPECT_NE(run({"info", "dem.amt", "--json"}).out.find("fidelity"), std::string::npos);
}

TEST_F(BuildCommand, WarnsOfHeightsThatStandAloneAndNamesTheRemedy) {
  RasterHeightfield field = rasterFamilies()[0].make(60, 50, 1);
  for (std::size_t i = 0; i < field.heights.size(); ++i)
    field.heights[i] = std::nearbyint(300 * std::sin(double(i % 60) / 9) * std::cos(double(i / 60) / 7));
  for (const double mark : {-9999.0, -32768.0, 1e20}) {
    SCOPED_TRACE(mark);
    for (const std::size_t at : {100u, 101u, 1500u}) field.heights[at] = mark;
    GeoTiffOptions options;
    options.sample = GeoTiffOptions::Sample::float64;
    ASSERT_TRUE(writeGeoTiff(path("dem.tif"), 60, 50, field.heights, field.georeference, options));
    const Outcome plain = run({"build", "dem.tif", "-o", "dem.amt"});
    EXPECT_EQ(plain.code, 0) << plain.err;
    const std::string value = fmt::format("{}", mark);
    EXPECT_NE(plain.err.find("warning"), std::string::npos) << plain.err;
    EXPECT_NE(plain.err.find("the value " + value + " occurs 3 times"), std::string::npos) << plain.err;
    EXPECT_NE(plain.err.find("--nodata " + value), std::string::npos) << plain.err;
    const Outcome stated = run({"build", "dem.tif", "-o", "stated.amt", "--nodata", value});
    EXPECT_EQ(stated.code, 0) << stated.err;
    EXPECT_EQ(stated.err.find("stand"), std::string::npos) << stated.err;
    EXPECT_EQ(stated.err.find("occurs"), std::string::npos) << stated.err;
  }
}

TEST_F(BuildCommand, SaysBeforehandHowLargeTheFileWillBe) {
  makeRaster("dem.tif", "fractal", 120, 120);
  for (const bool isPacked : {false, true}) {
    std::vector<std::string> words = {"build", "dem.tif", "-o", "dem.amt"};
    if (isPacked) words.emplace_back("--packed");
    const Outcome text = run(words);
    ASSERT_EQ(text.code, 0) << text.err;
    EXPECT_NE(text.err.find("arete: dem.amt will be about "), std::string::npos) << text.err;
    EXPECT_NE(text.err.find(isPacked ? "without --packed about" : "with --packed about"), std::string::npos);
    words.emplace_back("--json");
    const Outcome json = run(words);
    EXPECT_EQ(json.err, "");
    const double bytes = json.json()["bytes"];
    const double expected = json.json()["expectedBytes"][isPacked ? "packed" : "plain"];
    EXPECT_NEAR(expected / bytes, 1, isPacked ? 0.33 : 0.1);
  }
  EXPECT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).err, "");
  makeRaster("small.tif", "fractal", 30, 30);
  EXPECT_EQ(run({"build", "small.tif", "-o", "small.amt"}).err, "") << "small files surprise by nothing";
}

}  // namespace
}  // namespace arete::cli_test
