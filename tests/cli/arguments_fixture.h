// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small model and a TIN of it, and refusals that leave no file behind.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cli/cli_fixture.h"

namespace arete::cli_test {

class Arguments : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    makeRaster("dem.tif", "fractal", 30, 30);
    ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
    ASSERT_EQ(run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "5", "-q"}).code, 0);
    before_ = files();
  }

  /// The code and a sentence, and no file more than before.
  void expectRefusal(const std::vector<std::string>& arguments, int code, const std::string& sentence) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << sentence << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << sentence << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.rfind("arete: ", 0), 0u) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files(), before_);
  }

  /// "X,Y" of the middle of the DEM.
  std::string middle() const {
    const Json grid = run({"info", "dem.amt", "--json"}).json()["grid"];
    const Json& g = grid["geoTransform"];
    return std::to_string(g[0].get<double>() + g[1].get<double>() * 15) + "," +
           std::to_string(g[3].get<double>() + g[5].get<double>() * 15);
  }

  std::set<std::string> before_;

  /// The error object, where nothing else was asked for.
  static void expectErrorObject(const Outcome& outcome, int code) {
    EXPECT_EQ(outcome.code, code);
    const Json json = outcome.json();
    ASSERT_TRUE(json.is_object()) << outcome.out;
    EXPECT_EQ(json["error"]["exitCode"], code);
    EXPECT_NE(json["error"]["message"], "");
  }
};

}  // namespace arete::cli_test
