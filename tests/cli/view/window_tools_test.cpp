// SPDX-License-Identifier: GPL-3.0-or-later
//
// A script works in the real window under Xvfb; what it leaves has the bytes of the commands.
#include <set>

#include "cli/mesh_fixture.h"

namespace arete::cli_test {
namespace {

class WindowTools : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    if (std::system("command -v xvfb-run > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "xvfb-run, under which a window opens, is missing (Debian: xvfb)";
    std::string obj;
    constexpr int kSide = 40;
    for (int y = 0; y <= kSide; ++y)
      for (int x = 0; x <= kSide; ++x)
        obj += "v " + std::to_string(600000 + x) + " " + std::to_string(200000 + y) + " " +
               std::to_string((x * 7919 + y * 104729) % 97 / 20.0) + "\n";
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const int a = y * (kSide + 1) + x + 1, b = a + 1, c = a + kSide + 1, d = c + 1;
        obj += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(d) + "\nf " +
               std::to_string(a) + " " + std::to_string(d) + " " + std::to_string(c) + "\n";
      }
    write("scan.obj", obj);
  }
  /// Saves a cut by the camera.
  void check(const std::string& more);
  /// What the window has said, on stdout and stderr; its exit code.
  Outcome inWindow(const std::string& file, const std::string& script, const std::string& more = {}) {
    write("script.txt", script);
    const std::string command = "cd '" + (folder_ / "here").string() +
                                "' && LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s '-screen 0 800x600x24' "
                                "timeout 100 '" ARETE_PROGRAM "' view '" +
                                file + "' --size 640x480 --window-script script.txt " + more +
                                " > said.txt 2>&1 < /dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("said.txt"), {}};
  }
};

TEST_F(WindowTools, TheMenuOfColoursHasTheInksOfTheSurfaceAndSaysWhatItLacks) {
  std::string obj;
  for (int y = 0; y <= 20; ++y)
    for (int x = 0; x <= 20; ++x)
      obj += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\nvt " + std::to_string(x * x / 400.0) +
             " " + std::to_string((x * y) % 7 / 7.0) + "\n";
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      obj += "f";
      for (const int i : {y * 21 + x + 1, y * 21 + x + 2, y * 21 + x + 23, y * 21 + x + 22})
        obj += " " + std::to_string(i) + "/" + std::to_string(i);
      obj += "\n";
    }
  write("painted.obj", obj);
  ASSERT_EQ(run({"build", "painted.obj", "-o", "painted.amt", "--attributes"}).code, 0);
  std::set<std::string> pictures;
  for (const std::string color : {"stretch", "error:uv", "charts"}) {
    const Outcome window =
        inWindow("painted.amt", "color " + color + "\nframes 3\n", "--window-screenshot menu.png");
    ASSERT_EQ(window.code, 0) << window.out;
    EXPECT_EQ(window.out.find("the surface has no seams") != std::string::npos, color == "charts")
        << window.out;
    pictures.insert(read("menu.png"));
  }
  EXPECT_EQ(pictures.size(), 3u);
}

TEST_F(WindowTools, AnObjIsHalvedSavedCroppedAndDecimatedWithTheBytesOfTheCommands) {
  const Outcome window = inWindow("scan.obj",
                                  "triangles 1600\nhalve\nsave half.ply\nerror 0.5\nsave near.obj\n"
                                  "box 600005,200005.5,-1,600030,200020,9\ncrop part.obj\n"
                                  "decimate qem 25% small.ply\n");
  ASSERT_EQ(window.code, 0) << window.out;
  ASSERT_EQ(run({"build", "scan.obj", "-o", "scan.amt"}).code, 0);
  const std::vector<std::pair<std::string, std::vector<std::string>>> made = {
      {"half.ply", {"extract", "scan.amt", "--max-triangles", "800"}},
      {"near.obj", {"extract", "scan.amt", "--max-error", "0.5"}},
      {"part.obj", {"mesh", "crop", "scan.obj", "--box", "600005,200005.5,-1,600030,200020,9"}},
      {"small.ply", {"mesh", "decimate", "scan.obj", "--max-triangles", "25%", "--operator", "qem"}}};
  for (auto [name, command] : made) {
    ASSERT_TRUE(exists(name)) << name << "\n" << window.out;
    const std::string bytes = read(name);
    fs::remove(path(name));
    command.insert(command.end(), {"-o", name});
    const Outcome done = run(command);
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_EQ(bytes, read(name)) << name << "\n" << window.out;
  }
}

TEST_F(WindowTools, ACutByTheCameraIsThatOfTheCommandThatTheWindowSays) {
  check("--pixel-error 6");
  check("--pixel-error 6 --parallel");
  check("--pixel-error 1.5");
}

TEST_F(WindowTools, ACutThatABudgetEndsIsRefusedAsNoCommandHasIt) {
  const Outcome window = inWindow("scan.obj", "frames 30\nsave seen.ply\n", "--max-triangles 700");
  ASSERT_EQ(window.code, 0) << window.out;
  EXPECT_FALSE(exists("seen.ply"));
  EXPECT_NE(window.out.find("level by hand"), std::string::npos) << window.out;
}

void WindowTools::check(const std::string& more) {
  ASSERT_EQ(run({"build", "scan.obj", "-o", "scan.amt"}).code, 0);
  const Outcome window = inWindow("scan.amt", "frames 30\nsave seen.ply\nyes\n", more);
  ASSERT_EQ(window.code, 0) << window.out;
  const std::size_t at = window.out.find("arete extract scan.amt -o seen.ply --camera=");
  ASSERT_NE(at, std::string::npos) << window.out;
  ASSERT_TRUE(exists("seen.ply")) << window.out;
  const std::string bytes = read("seen.ply");
  const std::string line = window.out.substr(at + 6, window.out.find('\n', at) - at - 6);
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; stream >> word;) words.push_back(word);
  fs::remove(path("seen.ply"));
  words.push_back("--json");
  const Outcome done = run(words);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(bytes, read("seen.ply"));
  const std::string triangles = done.json()["exports"][0]["triangles"].dump();
  EXPECT_NE(window.out.find("drawn: " + triangles + " triangles"), std::string::npos)
      << triangles << window.out;
}

TEST_F(WindowTools, OfASceneTheSelectedObjectIsSavedAtItsLevelInItsFilesCoordinates) {
  write("scene.json",
        R"({"objects": [{"name": "left", "file": "scan.obj", "turn": [30, 0, 0], "level": {"triangles": 500}},
                       {"name": "right", "file": "scan.obj", "at": [600100, 200000]}]})");
  const Outcome window = inWindow("scene.json", "save left.ply\nselect 1\nsave right.ply\n");
  ASSERT_EQ(window.code, 0) << window.out;
  EXPECT_FALSE(exists("right.ply")) << "an object without a level by hand is not saved";
  EXPECT_NE(window.out.find("level by hand"), std::string::npos) << window.out;
  ASSERT_TRUE(exists("left.ply")) << window.out;
  const std::string bytes = read("left.ply");
  ASSERT_EQ(run({"build", "scan.obj", "-o", "scan.amt"}).code, 0);
  ASSERT_EQ(run({"extract", "scan.amt", "-o", "left.ply", "--max-triangles", "500"}).code, 0);
  EXPECT_EQ(bytes, read("left.ply"));
}

TEST_F(WindowTools, OfAModelACropIsOfItsFinestMesh) {
  ASSERT_EQ(run({"build", "scan.obj", "-o", "scan.amt"}).code, 0);
  const Outcome window = inWindow("scan.amt", "box 600005,200005.5,-1,600030,200020,9\ncrop part.ply\n");
  ASSERT_TRUE(exists("part.ply")) << window.out;
  const std::string bytes = read("part.ply");
  ASSERT_EQ(run({"extract", "scan.amt", "-o", "scan.ply", "--max-error", "0"}).code, 0);
  ASSERT_EQ(
      run({"mesh", "crop", "scan.ply", "-o", "part.ply", "--box", "600005,200005.5,-1,600030,200020,9"}).code,
      0);
  EXPECT_EQ(bytes, read("part.ply"));
}

TEST_F(WindowTools, NothingIsOverwrittenUnaskedAndTheInputNever) {
  write("kept.ply", "precious");
  Outcome window = inWindow("scan.obj", "triangles 500\nsave kept.ply\nno\nsave scan.obj\nyes\n");
  ASSERT_EQ(window.code, 0) << window.out;
  EXPECT_EQ(read("kept.ply"), "precious");
  EXPECT_TRUE(read("scan.obj").starts_with("v 600000 ")) << window.out;
  EXPECT_EQ(std::ranges::count(read("scan.obj"), '\n'), 41 * 41 + 2 * 40 * 40) << window.out;
  window = inWindow("scan.obj", "triangles 500\nsave kept.ply\nyes\n");
  EXPECT_TRUE(read("kept.ply").starts_with("ply")) << window.out;
}

TEST_F(WindowTools, ADroppedFileIsShownNextAndABadOneLeavesWhatIsThere) {
  makeRaster("dem.tif", "fractal", 20, 20);
  write("bad.obj", "f 1 2 3\n");
  fs::copy_file(path("scan.obj"), path("ümlaut.obj"));
  const Outcome window =
      inWindow("scan.obj", "open bad.obj\nopen dem.tif\nopen ümlaut.obj\ntriangles 900\nsave after.ply\n",
               "--log log.jsonl");
  ASSERT_EQ(window.code, 0) << window.out;
  EXPECT_TRUE(exists("after.ply")) << window.out;
  EXPECT_NE(window.out.find("bad.obj"), std::string::npos) << window.out;
  const std::string log = read("log.jsonl");
  for (const char* said : {"opened dem.tif", "opened ümlaut.obj", "arete extract 'ümlaut.amt' -o after.ply"})
    EXPECT_NE(log.find(said), std::string::npos) << said << "\n" << log;
}

}  // namespace
}  // namespace arete::cli_test
