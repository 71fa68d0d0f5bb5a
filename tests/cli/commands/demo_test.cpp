// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "cli/cli_fixture.h"

namespace arete::cli_test {
namespace {

class DemoCommand : public Cli {};

TEST_F(DemoCommand, PrintsATableAndTheFilesItWrote) {
  makeRaster("dem.tif", rasterFamilies().front().name, 80, 60);
  const Outcome outcome = run({"demo", "dem.tif", "-o", "out", "--max-error", "1,5"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.err.empty()) << outcome.err;
  std::istringstream lines(outcome.out);
  int tableRows = 0, files = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    double tolerance = 0, triangles = 0, percent = 0, most = 0, rms = 0, uncovered = 0, seconds = 0;
    if (words >> tolerance >> triangles >> percent >> most >> rms >> uncovered >> seconds) {
      ++tableRows;
      EXPECT_LE(most, tolerance * 1.001);
      EXPECT_EQ(uncovered, 0);
    }
    if (line.rfind("  out/", 0) == 0) {
      ++files;
      EXPECT_TRUE(exists(line.substr(2))) << line;
    }
  }
  EXPECT_EQ(tableRows, 2);
  EXPECT_GE(files, 7);
}

TEST_F(DemoCommand, TakesTolerancesInPercentOfTheRelief) {
  makeRaster("dem.tif", "fractal", 24, 20);
  const Json json = run({"demo", "dem.tif", "-o", "out", "--json", "--max-error", "10%,30%"}).json();
  ASSERT_EQ(json["results"].size(), 2u);
  const double relief = json["relief"].get<double>();
  for (const auto& [row, percent] : {std::pair{0, 10.0}, {1, 30.0}}) {
    const Json& result = json["results"][std::size_t(row)];
    EXPECT_NEAR(result["maxErrorPercent"].get<double>(), percent, 1e-9);
    EXPECT_NEAR(result["maxError"].get<double>(), percent / 100 * relief, 1e-9 * relief);
    EXPECT_TRUE(result["kept"].get<bool>());
  }
}

TEST_F(DemoCommand, AnswersAsJson) {
  makeRaster("dem.tif", rasterFamilies().front().name, 80, 60);
  const Outcome outcome = run({"demo", "dem.tif", "-o", "out", "--json", "--shape", "fidelity"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = outcome.json();
  ASSERT_TRUE(json.contains("results")) << outcome.out;
  EXPECT_EQ(json.at("columns"), 80);
  EXPECT_FALSE(json.at("files").empty());
  for (const Json& result : json.at("results")) EXPECT_TRUE(result.at("kept").get<bool>());
}

TEST_F(DemoCommand, RefusesWhatMakesNoSense) {
  makeRaster("dem.tif", rasterFamilies().front().name, 20, 20);
  EXPECT_EQ(run({"demo", "dem.tif"}).code, 2);
  EXPECT_EQ(run({"demo", "dem.tif", "-o", "out", "--max-error", "-1"}).code, 2);
  EXPECT_EQ(run({"demo", "missing.tif", "-o", "out"}).code, 3);
}

}  // namespace
}  // namespace arete::cli_test
