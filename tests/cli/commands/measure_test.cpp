// SPDX-License-Identifier: GPL-3.0-or-later
// arete measure: promises that are broken, and meshes elsewhere.
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "cli/arguments_fixture.h"

namespace arete::cli_test {
namespace {

using MeasureCommand = Arguments;

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

}  // namespace
}  // namespace arete::cli_test
