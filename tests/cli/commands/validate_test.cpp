// SPDX-License-Identifier: GPL-3.0-or-later
// arete validate: laws that hold, and files that are broken.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cli/cli_fixture.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

using ValidateCommand = Cli;

TEST_F(ValidateCommand, ValidatesAndNamesWhatIsBroken) {
  makeRaster("dem.tif", "fractal", 40, 40);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const Outcome valid = run({"validate", "dem.amt"});
  EXPECT_EQ(valid.code, 0) << valid.err;
  EXPECT_NE(valid.out.find("law 9  holds"), std::string::npos) << valid.out;
  EXPECT_EQ(run({"validate", "dem.amt", "--json"}).json()["holds"], true);

  std::string bytes = read("dem.amt");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
  write("altered.amt", bytes);
  EXPECT_EQ(run({"validate", "altered.amt"}).code, 4);
  write("short.amt", bytes.substr(0, bytes.size() / 2));
  for (const char* command : {"validate", "info"}) {
    const Outcome cut = run({command, "short.amt"});
    EXPECT_TRUE(cut.code == 3 || cut.code == 4) << cut.code;
    EXPECT_NE(cut.err.find("short.amt"), std::string::npos) << cut.err;
  }
}

TEST_F(ValidateCommand, ClaimsLawNineForTheDelaunayShapeOnly) {
  makeRaster("dem.tif", "fractal", 30, 30);
  for (const char* shape : {"delaunay", "fidelity"}) {
    ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "--shape", shape, "-q"}).code, 0);
    const Json json = run({"validate", "dem.amt", "--fronts", "2", "--seed", "5", "--json"}).json();
    EXPECT_EQ(json["holds"], true);
    EXPECT_EQ(json["randomFronts"], 2);
    EXPECT_EQ(json["seed"], 5);
    bool claimed = false;
    for (const Json& law : json["laws"])
      if (law["law"] == 9) claimed = law["claimed"];
    EXPECT_EQ(claimed, std::string(shape) == "delaunay") << json;
  }
}

TEST_F(ValidateCommand, SaysWhatItCompared) {
  makeRaster("dem.tif", "fractal", 40, 30);
  makeRaster("other.tif", "ramp", 40, 30);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
  const Outcome alone = run({"validate", "dem.amt"});
  EXPECT_NE(alone.out.find("law 10  holds"), std::string::npos) << alone.out;
  EXPECT_NE(alone.out.find("(all "), std::string::npos) << alone.out;
  EXPECT_NE(alone.out.find("not compared"), std::string::npos) << alone.out;
  EXPECT_EQ(run({"validate", "dem.amt", "--json"}).json()["heightsCompared"], "not compared");

  const Outcome same = run({"validate", "dem.amt", "--full", "--against", "dem.tif"});
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_NE(same.out.find("all 1200 are those of dem.tif"), std::string::npos) << same.out;
  EXPECT_EQ(same.out.find("not compared"), std::string::npos);
  const Outcome other = run({"validate", "dem.amt", "--against", "other.tif"});
  EXPECT_EQ(other.code, 5) << other.out;
  EXPECT_NE(other.err.find("of 1200 heights differ from the source"), std::string::npos) << other.err;
  EXPECT_EQ(run({"validate", "dem.amt", "--against", "missing.tif"}).code, 3);
}

TEST_F(ValidateCommand, ReadsTheSourceAsTheBuildDid) {
  write("points.csv", "x,y,low,top\n0,0,1,5\n10,0,2,6\n0,10,3,7\n11,12,4,9\n5,5,2,6\n");
  ASSERT_EQ(run({"build", "points.csv", "-o", "p.amt", "--z-field", "top", "--nodata", "9", "-q"}).code, 0);
  const Outcome same = run({"validate", "p.amt", "--against", "points.csv"});
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_EQ(run({"validate", "p.amt", "--against", "points.csv", "--z-field", "low"}).code, 5);
}

}  // namespace
}  // namespace arete::cli_test
