// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/mesh_fixture.h"

namespace arete::cli_test {
namespace {

class MeshPlace : public Meshes {
 protected:
  void SetUp() override {
    Meshes::SetUp();
    write("part.obj",
          "v 0 0 0\nv 2 0 0\nv 0 4 0\nv 0 0 6\nvn 0 1 0\nf 1//1 3//1 2//1\nf 1//1 2//1 4//1\n"
          "f 2//1 3//1 4//1\nf 3//1 1//1 4//1\n");
  }
  Json boxOf(const std::string& file) { return run({"mesh", "info", file, "--json"}).json()["box"]; }
  Json placed(std::vector<std::string> options) {
    std::vector<std::string> words = {"mesh", "place", "part.obj", "-o", "placed.obj"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return boxOf("placed.obj");
  }
};

TEST_F(MeshPlace, ScalesTurnsAndMovesInThisOrder) {
  Json box = placed({"--move", "10,20,30", "--turn", "90,0,0", "--scale", "2"});
  EXPECT_EQ(box["low"], (Json{10.0, 16.0, 30.0}));
  EXPECT_EQ(box["high"], (Json{18.0, 20.0, 42.0}));
  box = placed({"--turn", "180,0,0", "--about", "middle"});
  EXPECT_EQ(box, boxOf("part.obj"));
  box = placed({"--scale", "3", "--about", "base"});
  EXPECT_EQ(box["low"], (Json{-2.0, -4.0, 0.0}));
  EXPECT_EQ(box["high"], (Json{4.0, 8.0, 18.0}));
  box = placed({"--turn=0,90,0", "--about=0,4,0"});
  EXPECT_EQ(box["low"], (Json{0.0, -2.0, -4.0}));
  EXPECT_EQ(box["high"], (Json{2.0, 4.0, 0.0}));
}

TEST_F(MeshPlace, TurnsNormalsAndHeadsAboutTheAxisThatIsUp) {
  placed({"--turn", "90,0,0"});
  EXPECT_NE(read("placed.obj").find("vn 1 0 0"), std::string::npos) << read("placed.obj");
  // Of which y is up: an OBJ has z up then, and the heading was about y.
  const Json box = placed({"--turn", "90,0,0", "--up", "y"});
  EXPECT_EQ(box["low"], (Json{-6.0, -2.0, 0.0}));
  EXPECT_EQ(box["high"], (Json{0.0, 0.0, 4.0}));
}

TEST_F(MeshPlace, SaysWhatIsWrong) {
  for (const auto& [option, value, sentence] : {std::tuple{"--turn", "1,2", "three numbers, not 2"},
                                                {"--turn", "a,0,0", "'a' is not a number"},
                                                {"--move", "1,2,nan", "is not a number"},
                                                {"--scale", "0", "--scale"},
                                                {"--scale", "-1", "--scale"},
                                                {"--about", "there", "--about there"},
                                                {"--move", "inf,0,0", "--move"}}) {
    const Outcome outcome = run({"mesh", "place", "part.obj", "-o", "placed.obj", option, value});
    EXPECT_EQ(outcome.code, 2) << option << " " << value;
    EXPECT_TRUE(says(outcome, sentence)) << outcome.err;
    EXPECT_FALSE(exists("placed.obj"));
  }
  EXPECT_EQ(run({"mesh", "place", "part.obj", "-o", "part.obj"}).code, 2) << "over its input";
}

}  // namespace
}  // namespace arete::cli_test
