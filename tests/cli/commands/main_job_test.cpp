// SPDX-License-Identifier: GPL-3.0-or-later
// The main job: a DEM in, one multitriangulation, any tolerance out, with proof.
#include <fmt/format.h>

#include <cmath>

#include "cli/cli_fixture.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

using MainJob = Cli;

TEST_F(MainJob, BuildsExtractsAndKeepsThePromise) {
  makeRaster("dem.tif", "fractal", 90, 70);
  const Outcome built = run({"build", "dem.tif", "-o", "dem.amt"});
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_NE(built.out.find("6 300"), std::string::npos) << built.out;
  EXPECT_EQ(built.err, "");

  const Outcome extracted = run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "5"});
  ASSERT_EQ(extracted.code, 0) << extracted.err;
  const Outcome measured = run({"measure", "tin.ply", "dem.tif", "--expect", "5"});
  EXPECT_EQ(measured.code, 0) << measured.err;
  EXPECT_NE(measured.out.find("kept"), std::string::npos) << measured.out;
  EXPECT_EQ(files(), (std::set<std::string>{"dem.amt", "dem.tif", "tin.ply"}));
}

TEST_F(MainJob, HoldsOnEveryFamilyBothShapesAndBothMethods) {
  const bool isFull = std::getenv("ARETE_FULL") != nullptr;
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    makeRaster("dem.tif", family.name, isFull ? 150 : 31, isFull ? 120 : 27);
    for (const std::string shape : {"delaunay", "fidelity"}) {
      SCOPED_TRACE(shape);
      const Outcome built = run({"build", "dem.tif", "-o", "dem.amt", "--shape", shape, "-q"});
      ASSERT_EQ(built.code, 0) << built.err;
      if (isFull) {
        const Outcome valid = run({"validate", "dem.amt", "--fronts", "20"});
        EXPECT_EQ(valid.code, 0) << valid.err;
      }
      for (const std::string method : {"minimal", "saturated"}) {
        SCOPED_TRACE(method);
        const Outcome extracted =
            run({"extract", "dem.amt", "-o", "tin_{}.ply", "--max-error", "0,0.5,7", "--method", method});
        ASSERT_EQ(extracted.code, 0) << extracted.err;
        for (const std::string error : {"0", "0.5", "7"}) {
          const Outcome measured = run({"measure", "tin_" + error + ".ply", "dem.tif", "--expect", error});
          EXPECT_EQ(measured.code, 0) << error << ": " << measured.err;
        }
      }
    }
  }
}

TEST_F(MainJob, LetsNoFileTalkToTheTerminal) {
  makeRaster("dem.tif", "fractal", 8, 8);
  write("tin.ply",
        "ply\nformat ascii 1.0\ncomment vertical_unit \x1b]0;title\x07\nelement vertex 3\nproperty double x\n"
        "property double y\nproperty double z\nelement face 1\nproperty list uchar uint vertex_indices\n"
        "end_header\n-900 -900 0\n900 -900 0\n0 900 0\n3 0 1 2\n");
  const Outcome measured = run({"measure", "tin.ply", "dem.tif"});
  const Outcome missing = run({"measure", "\x1b[2J.ply", "dem.tif"});
  EXPECT_EQ((measured.out + measured.err + missing.err).find('\x1b'), std::string::npos);
  EXPECT_NE(missing.err.find("?[2J.ply"), std::string::npos) << missing.err;
}

TEST_F(MainJob, SaysWhenStdoutTakesNothing) {
  makeRaster("dem.tif", "fractal", 30, 30);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
  const std::string command = std::string(ARETE_PROGRAM) + " height " + path("dem.amt") + " --points " +
                              write("places.csv",
                                    [] {
                                      std::string rows = "x,y\n";
                                      for (int i = 0; i < 20'000; ++i) rows += "3,-3\n";
                                      return rows;
                                    }()) +
                              " > /dev/full 2> " + path("said");
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_NE(read("said").find("stdout cannot be written to"), std::string::npos) << read("said");
}

}  // namespace
}  // namespace arete::cli_test
