// SPDX-License-Identifier: GPL-3.0-or-later
// What a file means to `arete build`: terrain, a surface or points.
#include "cli/cli_fixture.h"

namespace arete::cli_test {
namespace {

class BuildSource : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write("hill.obj",
          "v 0 0 1\nv 10 0 2\nv 10 10 3\nv 0 10 4\nv 5 5 9\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
    write("points.csv", "x,y,z\n0,0,1\n10,0,2\n10,10,3\n0,10,4\n5,5,9\n");
  }
  Outcome build(const std::string& input, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"build", input, "-o", "x.amt", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
};

TEST_F(BuildSource, OfAMeshWithFacesIsASurface) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--as", "surface"}}) {
    const Outcome built = build("hill.obj", more);
    ASSERT_EQ(built.code, 0) << built.err;
    EXPECT_EQ(built.json()["kind"], "surface");
    EXPECT_EQ(built.json()["finestTriangles"], 4);
  }
  // Options of terrain are refused by name.
  const Outcome refused = build("hill.obj", {"--features", "3"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--features"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--as terrain"), std::string::npos) << refused.err;
  EXPECT_EQ(build("points.csv", {"--keep-borders"}).code, 2);
}

TEST_F(BuildSource, TakesTheVerticesOfAMeshWhereStated) {
  const Json points = build("points.csv").json();
  for (const char* kind : {"terrain", "points"}) {
    const Outcome built = build("hill.obj", {"--as", kind});
    ASSERT_EQ(built.code, 0) << built.err;
    EXPECT_EQ(built.json()["sourceChecksum"], points["sourceChecksum"]);
  }
  // y is up in a glTF.
  ASSERT_EQ(run({"convert", "hill.obj", "-o", "hill.glb", "--up", "z"}).code, 0);
  const Outcome turned = build("hill.glb", {"--as", "terrain"});
  ASSERT_EQ(turned.code, 0) << turned.err;
  EXPECT_EQ(turned.json()["sourceChecksum"], points["sourceChecksum"]);
}

TEST_F(BuildSource, TakesAMeshWithoutFacesForPoints) {
  const Json points = build("points.csv").json();
  const std::string vertices = "0 0 1\n10 0 2\n10 10 3\n0 10 4\n5 5 9\n";
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n";
  write("cloud.ply", header + "end_header\n" + vertices);
  write("none.ply",
        header + "element face 0\nproperty list uchar int vertex_indices\nend_header\n" + vertices);
  write("cloud.obj", "v 0 0 1\nv 10 0 2\nv 10 10 3\nv 0 10 4\nv 5 5 9\n");
  for (const char* name : {"cloud.ply", "none.ply", "cloud.obj"})
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--as", "points"}}) {
      const Outcome built = build(name, more);
      ASSERT_EQ(built.code, 0) << name << built.err;
      EXPECT_EQ(built.json()["sourceChecksum"], points["sourceChecksum"]) << name;
    }
  EXPECT_EQ(build("cloud.ply", {"--as", "surface"}).code, 2);
  EXPECT_EQ(run({"mesh", "info", "cloud.ply"}).code, 3) << "no mesh";
}

TEST_F(BuildSource, RefusesAKindThatContradictsTheFile) {
  makeRaster("dem.tif", "fractal", 9, 9);
  EXPECT_EQ(build("dem.tif", {"--as", "terrain"}).code, 0);
  EXPECT_EQ(build("points.csv", {"--as", "points"}).code, 0);
  EXPECT_EQ(build("points.csv", {"--as", "terrain"}).code, 0);
  for (const auto& [file, kind] : {std::pair{"dem.tif", "surface"}, std::pair{"dem.tif", "points"},
                                   std::pair{"points.csv", "surface"}}) {
    const Outcome refused = build(file, {"--as", kind});
    EXPECT_EQ(refused.code, 2) << file << refused.err;
    EXPECT_NE(refused.err.find(std::string("--as ") + kind), std::string::npos) << refused.err;
  }
  const Outcome band = build("hill.obj", {"--as", "points", "--band", "2"});
  EXPECT_EQ(band.code, 2);
  EXPECT_NE(band.err.find("--band"), std::string::npos) << band.err;
  EXPECT_EQ(build("hill.obj", {"--as", "scan"}).code, 2);
}

TEST_F(BuildSource, TextThatFillsAGridStaysPointsWhereStated) {
  std::string text;
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x)
      if (x != 3 || y != 3)
        text += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(x * y) + "\n";
  write("grid.xyz", text);
  EXPECT_NE(build("grid.xyz").err.find("read as a raster"), std::string::npos);
  EXPECT_EQ(run({"info", "x.amt", "--json"}).json()["kind"], "raster");
  const Outcome points = build("grid.xyz", {"--as", "points"});
  ASSERT_EQ(points.code, 0) << points.err;
  EXPECT_EQ(points.err, "");
  EXPECT_EQ(points.json()["samples"], 35);
  EXPECT_EQ(run({"info", "x.amt", "--json"}).json()["kind"], "points");
  const Outcome valid = run({"validate", "x.amt", "--against", "grid.xyz"});
  EXPECT_EQ(valid.code, 0) << valid.err;
  // The command of a certificate reads the text as the build did: as a raster it has a hole.
  ASSERT_EQ(
      run({"extract", "x.amt", "-o", "t.ply", "--max-error", "0", "--certificate", "c.json", "-q"}).code, 0);
  EXPECT_NE(read("c.json").find("--as points"), std::string::npos);
  EXPECT_EQ(run({"measure", "t.ply", "grid.xyz", "--expect", "0", "--as", "points"}).code, 0);
  EXPECT_EQ(run({"measure", "t.ply", "grid.xyz", "--expect", "0"}).code, 5);
  makeRaster("dem.tif", "flat", 5, 5);
  EXPECT_NE(build("dem.tif", {"--as", "points"}).err.find("--as points: dem.tif is a raster"),
            std::string::npos);
}

TEST_F(BuildSource, AModelHasItsEnding) {
  const Outcome refused = run({"build", "points.csv", "-o", "maunga"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--output maunga: must end in .amt, as maunga.amt"), std::string::npos)
      << refused.err;
  EXPECT_FALSE(exists("maunga"));
}

TEST_F(BuildSource, SaysThatNoUnitOfHeightsIsStated) {
  const std::string without = run({"build", "points.csv", "-o", "x.amt"}).out;
  EXPECT_NE(without.find("no unit is stated: taken as metres"), std::string::npos) << without;
  const std::string with = run({"build", "points.csv", "-o", "x.amt", "--vertical-unit", "m"}).out;
  EXPECT_EQ(with.find("no unit is stated"), std::string::npos) << with;
}

}  // namespace
}  // namespace arete::cli_test
