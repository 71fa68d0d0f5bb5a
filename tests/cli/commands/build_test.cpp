// SPDX-License-Identifier: GPL-3.0-or-later
// arete build: points, features, threads, terminals.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cli/cli_fixture.h"
#include "io/dem/raster_reader.h"

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
  EXPECT_NE(built.err.find("1 of 2 points lie outside"), std::string::npos) << built.err;
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

}  // namespace
}  // namespace arete::cli_test
