// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/mesh_fixture.h"

namespace arete::cli_test {
namespace {

class MeshCrop : public Meshes {
 protected:
  void SetUp() override {
    Meshes::SetUp();
    write(
        "square.obj",
        "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  }
};

TEST_F(MeshCrop, CutsAtTheFacesOfTheBox) {
  const Outcome outcome = run({"mesh", "crop", "square.obj", "-o", "part.obj", "--box", "0.5,-1,-1,1.5,3,1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome, "2 triangles cut at the box")) << outcome.out;
  const Json json = run({"mesh", "info", "part.obj", "--json"}).json();
  EXPECT_EQ(json["box"]["low"], (Json{0.5, 0.0, 0.0}));
  EXPECT_EQ(json["box"]["high"], (Json{1.5, 2.0, 0.0}));
  EXPECT_NEAR(json["area"].get<double>(), 2, 1e-15);
  EXPECT_EQ(json["borders"].size(), 1u);
}

TEST_F(MeshCrop, TakesBoundsThatAreLeftOutOrInfinite) {
  for (const char* box : {",,,1,,", "-inf,-inf,-inf,1,inf,inf", "-1e9, -5,-1, 1,3,1"}) {
    const Outcome outcome = run({"mesh", "crop", "square.obj", "-o", "part.obj", "--box", box});
    ASSERT_EQ(outcome.code, 0) << box << outcome.err;
    EXPECT_EQ(run({"mesh", "info", "part.obj", "--json"}).json()["box"]["high"], (Json{1.0, 2.0, 0.0}));
  }
}

TEST_F(MeshCrop, KeepsTrianglesWholeWhereAskedTo) {
  const Outcome outcome =
      run({"mesh", "crop", "square.obj", "-o", "part.obj", "--box", "1.5,0,-1,2,0.2,1", "--whole", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["triangles"], 1);
  EXPECT_EQ(outcome.json()["cutTriangles"], 0);
  EXPECT_EQ(outcome.json()["vertices"], 3);
}

TEST_F(MeshCrop, SaysWhatIsWrongWithABox) {
  for (const auto& [box, sentence] :
       {std::pair{"1,2,3", "six numbers, not 3"}, std::pair{"0,0,0,0,1,1", "lower bound"},
        std::pair{"0,0,a,1,1,1", "'a' is not a number"}, std::pair{"nan,0,0,1,1,1", "is not a number"},
        std::pair{"5,5,5,6,6,6", "the mesh is from x 0 to 2, y 0 to 2, z 0 to 0"}}) {
    const Outcome outcome = run({"mesh", "crop", "square.obj", "-o", "part.obj", "--box", box});
    EXPECT_EQ(outcome.code, 2) << box;
    EXPECT_TRUE(says(outcome, sentence)) << outcome.err;
    EXPECT_TRUE(says(outcome, "--box")) << outcome.err;
    EXPECT_FALSE(exists("part.obj"));
  }
  EXPECT_EQ(run({"mesh", "crop", "square.obj", "-o", "part.obj"}).code, 2);
}

TEST_F(MeshCrop, CountsInTheCoordinatesOfTheInput) {
  ASSERT_EQ(
      run({"mesh", "crop", "square.obj", "-o", "part.obj", "--box", ",1,,,,", "--up", "y", "--unit", "km"})
          .code,
      0);
  const Json json = run({"mesh", "info", "part.obj", "--json"}).json();
  EXPECT_EQ(json["box"]["low"], (Json{0.0, 0.0, 1000.0}));
  EXPECT_EQ(json["box"]["high"], (Json{2000.0, 0.0, 2000.0}));
}

}  // namespace
}  // namespace arete::cli_test
