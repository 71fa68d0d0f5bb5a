// SPDX-License-Identifier: GPL-3.0-or-later
// The main job on DEMs that others measured.
#include "cli/cli_fixture.h"

namespace arete::cli_test {
namespace {

class RealData : public Cli {
 protected:
  /// Builds, extracts at the tolerances, and measures each.
  void keepsThePromise(const std::string& dem, const std::vector<std::string>& tolerances) const {
    const Outcome built = run({"build", dem, "-o", "dem.amt", "--quiet"});
    ASSERT_EQ(built.code, 0) << built.err;
    std::string all;
    for (const std::string& tolerance : tolerances) all += (all.empty() ? "" : ",") + tolerance;
    const Outcome extracted = run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", all, "--json"});
    ASSERT_EQ(extracted.code, 0) << extracted.err;
    const Json answer = extracted.json();  // outlives the loop over a part of it
    for (const Json& tin : answer["exports"]) {
      const std::string file = tin["file"], tolerance = tin["maxError"].dump();
      const Outcome measured = run({"measure", file, dem, "--expect", tolerance, "--json", "--quiet"});
      EXPECT_EQ(measured.code, 0) << file << ": " << measured.err;
      EXPECT_EQ(measured.json()["samples"]["uncovered"], 0);
      EXPECT_EQ(measured.json()["samples"]["nodataCovered"], 0);
    }
  }
};

TEST_F(RealData, BigTujungaAtFiveMetres) {
  const std::string dem = realData("dem/srtm1_bigtujunga_utm11.tif");
  if (dem.empty()) GTEST_SKIP() << "the Big Tujunga DEM is not here (set ARETE_DATA)";
  keepsThePromise(dem, {"5"});
}

TEST_F(RealData, AZippedSrtmTile) {
  const std::string dem = realData("dem/srtm3_N51E001_thames.hgt.zip");
  if (dem.empty()) GTEST_SKIP() << "the zipped SRTM tile is not here (set ARETE_DATA)";
  keepsThePromise(dem, {"2", "10"});
}

TEST_F(RealData, TheBerneseAlpsWithVoids) {
  const std::string dem = realData("dem/srtm3_N46E008_bernese_alps.tif");
  if (dem.empty()) GTEST_SKIP() << "the Bernese Alps are not here (set ARETE_DATA)";
  keepsThePromise(dem, {"20"});
  const Json info = run({"info", "dem.amt", "--at", "20", "--json"}).json();
  EXPECT_EQ(info["isolated"], 621);
}

}  // namespace
}  // namespace arete::cli_test
