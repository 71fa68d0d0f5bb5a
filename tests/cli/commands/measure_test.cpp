// SPDX-License-Identifier: GPL-3.0-or-later
// arete measure: promises that are broken, and meshes elsewhere.
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments_fixture.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

using MeasureCommand = Arguments;

TEST_F(MeasureCommand, TurnsHeightsIntoTheUnitOfTheDem) {
  ASSERT_EQ(run({"build", "dem.tif", "-o", "feet.amt", "--vertical-unit", "ft", "-q"}).code, 0);
  ASSERT_EQ(run({"extract", "feet.amt", "-o", "feet.ply", "--max-error", "0", "-q"}).code, 0);
  const Outcome same = run({"measure", "feet.ply", "dem.tif", "--vertical-unit", "ft", "--json"});
  EXPECT_EQ(same.json()["error"]["maximum"].get<double>(), 0);
  const Outcome outcome = run({"measure", "feet.ply", "dem.tif", "--vertical-unit", "m", "--json"});
  EXPECT_NE(outcome.err.find("turned into that of the DEM"), std::string::npos) << outcome.err;
  double highest = 0;
  const RasterHeightfield field = readRaster(path("dem.tif"))->heightfield;
  for (const double height : field.heights)
    if (!std::isnan(height)) highest = std::max(highest, std::abs(height));
  EXPECT_NEAR(outcome.json()["error"]["maximum"].get<double>(), (1 - 0.3048) * highest, 1e-9 * highest);
}

TEST_F(MeasureCommand, TellsABrokenPromise) {
  const Outcome outcome = run({"measure", "tin.ply", "dem.tif", "--expect", "0.001"});
  EXPECT_EQ(outcome.code, 5);
  EXPECT_NE(outcome.err.find("tin.ply: the largest error is"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("maximum error"), std::string::npos) << outcome.out;
  const Json json = run({"measure", "tin.ply", "dem.tif", "--expect", "0.001", "--json"}).json();
  EXPECT_EQ(json["kept"], false);
  EXPECT_EQ(run({"measure", "tin.ply", "dem.tif"}).code, 0);
}

TEST_F(MeasureCommand, LooksInAnotherCrsWhereItIsAndWarnsOfATinElsewhere) {
  makeRaster("other.tif", "geographic", 30, 30);
  ASSERT_EQ(run({"build", "other.tif", "-o", "other.amt"}).code, 0);
  ASSERT_EQ(run({"extract", "other.amt", "-o", "other.ply", "--max-error", "5"}).code, 0);
  const Outcome outcome = run({"measure", "other.ply", "dem.tif", "--crs", "EPSG:32611"});
  EXPECT_NE(outcome.out.find(", where each sample is"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("covers no sample"), std::string::npos) << outcome.err;
}

TEST_F(MeasureCommand, KeepsAPromiseAndSaysSo) {
  const Outcome kept = run({"measure", "tin.ply", "dem.tif", "--expect", "5", "--json"});
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_EQ(kept.json()["kept"], true);
  EXPECT_EQ(kept.json()["expect"], 5);
}

TEST_F(MeasureCommand, WritesTheErrorsAsARaster) {
  EXPECT_EQ(run({"measure", "tin.ply", "dem.tif", "--error-raster", "errors.tif", "-q"}).code, 0);
  EXPECT_TRUE(exists("errors.tif"));
  const Outcome refused = run({"measure", "tin.ply", "dem.tif", "--error-raster", "errors.png"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--error-raster errors.png: "), std::string::npos) << refused.err;
}

TEST_F(MeasureCommand, NamesEveryBrokenPromiseAndTheErrorFirst) {
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "part.obj", "--max-error", "20", "-q"}).code, 0);
  // Without its last triangle.
  std::string obj = read("part.obj");
  const std::size_t last = obj.rfind("\nf ");
  obj.erase(last, obj.find('\n', last + 1) - last);
  write("part.obj", obj);
  const Outcome outcome = run({"measure", "part.obj", "dem.tif", "--expect", "0.001"});
  EXPECT_EQ(outcome.code, 5);
  const std::size_t error = outcome.err.find("the largest error is"),
                    hole = outcome.err.find("in no triangle");
  ASSERT_NE(error, std::string::npos) << outcome.err;
  ASSERT_NE(hole, std::string::npos) << outcome.err;
  EXPECT_LT(error, hole);
}

TEST_F(MeasureCommand, SaysWhereBothLieInsteadOfFiguresOfNothing) {
  ASSERT_EQ(run({"convert", "tin.ply", "-o", "tin.obj", "-q"}).code, 0);
  std::istringstream lines(read("tin.obj"));
  std::string local, upright, kind;
  for (std::string line; std::getline(lines, line);) {
    double x = 0, y = 0, z = 0;
    std::istringstream words(line);
    if (words >> kind >> x >> y >> z; kind == "v") {
      local += fmt::format("v {} {} {}\n", x - 500000, y - 5199000, z);
      upright += fmt::format("v {} {} {}\n", x, z, -y);
    } else {
      local += line + "\n";
      upright += line + "\n";
    }
  }
  write("local.obj", local);
  write("upright.obj", upright);
  for (const auto& [name, guess] :
       {std::pair{"local.obj", "local coordinates"}, {"upright.obj", "is its y up?"}}) {
    const Outcome outcome = run({"measure", name, "dem.tif"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_EQ(outcome.out.find("maximum error"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("the DEM            x "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.err.find("covers no sample of dem.tif"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(guess), std::string::npos) << outcome.err;
    const Outcome expected = run({"measure", name, "dem.tif", "--expect", "5", "--json"});
    EXPECT_EQ(expected.code, 5);
    EXPECT_TRUE(expected.json()["error"]["maximum"].is_null()) << expected.out;
    EXPECT_EQ(expected.json()["dem"]["extent"].size(), 4u);
  }
}

TEST_F(MeasureCommand, NamesTheDemOfAModel) {
  const Outcome outcome = run({"measure", "tin.ply", "dem.amt"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("the DEM that it was built from, dem.tif"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace arete::cli_test
