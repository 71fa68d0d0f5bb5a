// SPDX-License-Identifier: GPL-3.0-or-later
// arete info: the facts of a file, and its curve.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "cli/cli_fixture.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

using InfoCommand = Cli;

TEST_F(InfoCommand, TellsTheCurve) {
  makeRaster("dem.tif", "fractal", 70, 70);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const Json info = run({"info", "dem.amt", "--json"}).json();
  ASSERT_FALSE(info.is_discarded());
  EXPECT_EQ(info["samples"], 4900);
  EXPECT_EQ(info["finestTriangles"], 2 * 69 * 69);
  const Json curve = info["curve"];
  ASSERT_GT(curve.size(), 3u);
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_LE(curve[i]["minimal"], curve[i]["saturated"]);
    if (i == 0) continue;
    EXPECT_LE(curve[i]["minimal"], curve[i - 1]["minimal"]);
    EXPECT_GT(curve[i]["maxError"], curve[i - 1]["maxError"]);
  }
  const Json at = run({"info", "dem.amt", "--json", "--at", "4"}).json()["curve"];
  ASSERT_EQ(at.size(), 1u);
  for (const std::string method : {"minimal", "saturated"}) {
    const Json tin =
        run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "4", "--method", method, "--json"})
            .json()["exports"][0];
    EXPECT_EQ(tin["triangles"], at[0][method]) << method;
    if (method != "minimal") continue;
    const Json measured = run({"measure", "tin.ply", "dem.tif", "--json"}).json();
    EXPECT_NEAR(measured["error"]["mean"].get<double>(), at[0]["minimalMeanError"].get<double>(), 1e-9);
  }
  EXPECT_NE(run({"info", "dem.amt", "--at", "4"}).out.find("mean TIN minus DEM"), std::string::npos);
  EXPECT_FALSE(curve[0].contains("minimalMeanError"));
  EXPECT_NE(run({"info", "dem.amt"}).out.find("(finest)"), std::string::npos);
}

TEST_F(InfoCommand, CountsWhatTheBuildHasCounted) {
  makeRaster("dem.tif", "fractal", 40, 30);
  const Json built = run({"build", "dem.tif", "-o", "dem.amt", "--json"}).json();
  const Outcome text = run({"info", "dem.amt"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_EQ(text.err, "");
  const Json info = run({"info", "dem.amt", "--json"}).json();
  const std::string dump = info.dump();
  for (const char* key : {"triangles", "finestTriangles", "rootTriangles"})
    EXPECT_NE(dump.find(built[key].dump()), std::string::npos) << key << " " << dump;
}

TEST_F(InfoCommand, ListsTheColumnsOfTheFile) {
  makeRaster("dem.tif", "fractal", 20, 20);
  for (const bool isPacked : {false, true}) {
    std::vector<std::string> words = {"build", "dem.tif", "-o", "dem.amt", "-q"};
    if (isPacked) words.push_back("--packed");
    ASSERT_EQ(run(words).code, 0);
    const Json info = run({"info", "dem.amt", "--json"}).json();
    std::map<std::string, Json> byTag;
    std::uint64_t bytes = 0;
    for (const Json& column : info["columns"]) {
      byTag[column["tag"]] = column;
      bytes += column["bytes"].get<std::uint64_t>();
    }
    EXPECT_LT(bytes, info["bytes"].get<std::uint64_t>());
    if (!isPacked) {
      EXPECT_EQ(byTag.at("BLOW")["per"], "triangle");
      EXPECT_EQ(byTag.at("BLOW")["coding"], "outward");
      EXPECT_EQ(byTag.at("HGHT")["per"], "vertex");
      EXPECT_EQ(byTag.at("PSUM")["per"], "segment");
    } else {
      EXPECT_EQ(byTag.count("BLOW"), 0u);
      EXPECT_EQ(byTag.at("PNOD")["coding"], "packed");
    }
  }
}

TEST_F(InfoCommand, RefusesTwoWaysToStateACurve) {
  makeRaster("dem.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
  const Outcome both = run({"info", "dem.amt", "--curve", "3", "--at", "1"});
  EXPECT_EQ(both.code, 2);
  EXPECT_NE(both.err.find("excludes --"), std::string::npos) << both.err;
  EXPECT_EQ(run({"info", "dem.amt", "--at", "-1"}).code, 2);
  EXPECT_EQ(run({"info", "dem.amt", "--curve", "x"}).code, 2);
}

}  // namespace
}  // namespace arete::cli_test
