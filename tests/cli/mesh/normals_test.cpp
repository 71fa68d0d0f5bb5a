// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "cli/mesh_fixture.h"

namespace arete::cli_test {
namespace {

/// A roof: two slopes that are turned by 60 degrees against each other.
class NormalsOption : public Meshes {
 protected:
  void SetUp() override {
    Meshes::SetUp();
    write("roof.obj",
          "v 0 0 0\nv 0 9 0\nv 0 0 0\nv 0 9 0\nv 8.66025 0 5\nv 8.66025 9 5\nv 17.3205 0 0\nv 17.3205 9 0\n"
          "f 1 5 6\nf 3 6 4\nf 5 7 8 6\n");
  }
  std::string normalsOf(std::vector<std::string> words) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string text = read("out.obj");
    std::string normals;
    for (std::size_t at = text.find("\nvn "); at != std::string::npos; at = text.find("\nvn ", at + 1))
      normals += text.substr(at + 1, text.find('\n', at + 1) - at);
    return normals;
  }
  static std::ptrdiff_t lines(const std::string& text) { return std::ranges::count(text, '\n'); }
};

TEST_F(NormalsOption, IsOfEveryCommandThatWritesAMesh) {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"convert"},
                                             {"mesh", "repair"},
                                             {"mesh", "place"},
                                             {"mesh", "crop", "--box", ",,,,,99"},
                                             {"mesh", "decimate", "--max-error", "0.001%"}}) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {"roof.obj", "-o", "out.obj", "--overwrite"});
    words.insert(words.end(), {"--normals", "smooth", "--crease-angle"});
    words.push_back("61");
    const std::string smooth = normalsOf(words);
    EXPECT_NE(smooth.find("vn 0 0 1"), std::string::npos) << command.back() << "\n" << smooth;
    if (command.size() > 1) continue;
    words.back() = "59";
    const std::string hard = normalsOf(words);
    EXPECT_EQ(hard.find("vn 0 0 1"), std::string::npos) << command.back() << "\n" << hard;
  }
}

TEST_F(NormalsOption, GivesEachTriangleItsOwn) {
  const std::string flat = normalsOf({"convert", "roof.obj", "-o", "out.obj", "--normals", "flat"});
  EXPECT_EQ(lines(flat), 2) << flat;
}

TEST_F(NormalsOption, OfACutAreItsFacesOwn) {
  EXPECT_EQ(run({"build", "roof.obj", "-o", "roof.amt"}).code, 0);
  const std::string smooth = normalsOf({"extract", "roof.amt", "-o", "out.obj", "--max-error", "0.001%",
                                        "--normals", "smooth", "--crease-angle", "61"});
  EXPECT_NE(smooth.find("vn 0 0 1"), std::string::npos) << smooth;
}

TEST_F(NormalsOption, SaysWhatIsWrong) {
  const std::vector<std::string> convert = {"convert", "roof.obj", "-o", "out.obj"};
  const auto refused = [&](std::vector<std::string> options, const std::string& sentence) {
    std::vector<std::string> words = convert;
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(says(outcome, sentence)) << outcome.err;
    EXPECT_FALSE(exists("out.obj"));
  };
  refused({"--normals", "round"}, "--normals");
  refused({"--normals", "smooth", "--crease-angle", "181"}, "--crease-angle");
  refused({"--normals", "smooth", "--crease-angle", "nan"}, "--crease-angle");
  refused({"--crease-angle", "30"}, "--normals");
  refused({"--normals", "smooth", "--crs", "EPSG:4326"}, "degrees");
}

}  // namespace
}  // namespace arete::cli_test
