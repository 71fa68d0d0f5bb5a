// SPDX-License-Identifier: GPL-3.0-or-later
//
// Arete is installed into a folder, the examples are configured and built against that, and run. What they
// print is held against the DEM itself, read here, and against the installed program.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "io/geo/dem/raster_reader.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Library : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "arete-library-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  /// Runs a command in the folder; what it writes to stdout is in out_.
  void run(const std::string& command) {
    const std::string whole = fmt::format("cd '{}' && ({}) >out 2>err </dev/null", folder_.string(), command);
    const int status = std::system(whole.c_str());
    out_ = contentOf(folder_ / "out");
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << command << "\n"
                                                               << out_ << contentOf(folder_ / "err");
  }

  fs::path folder_;
  std::string out_;
};

/// A program that includes every installed header, the last one first.
std::string everyHeader(const fs::path& include) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(include))
    if (entry.is_regular_file()) names.push_back(fs::relative(entry.path(), include).string());
  std::sort(names.rbegin(), names.rend());
  EXPECT_GT(names.size(), 30u);
  std::string text;
  for (const std::string& name : names) text += fmt::format("#include <{}>\n", name);
  return text + "int main() { return arete::toString(arete::ErrorCode::usage).empty() ? 1 : 0; }\n";
}

/// The indented block of README.md that includes arete.h.
std::string firstProgram() {
  std::istringstream lines(contentOf(ARETE_README));
  std::string program;
  for (std::string line; std::getline(lines, line);) {
    const bool begins = line == "    #include <arete/arete.h>";
    if (program.empty() && !begins) continue;
    if (!line.starts_with("    ")) break;
    program += line.substr(4) + "\n";
  }
  return program;
}

TEST_F(Library, IsInstalledFoundBuiltAgainstAndAnswers) {
  run(fmt::format("'{}' --install '{}' --prefix prefix", ARETE_CMAKE, ARETE_BUILD_FOLDER));
  const fs::path prefix = folder_ / "prefix";

  // The examples, and beside them a project that includes all there is.
  run(fmt::format("'{}' -S '{}' -B examples {} -DCMAKE_PREFIX_PATH='{}'", ARETE_CMAKE, ARETE_EXAMPLES_FOLDER,
                  ARETE_CMAKE_ARGUMENTS, prefix.string()));
  run(fmt::format("'{}' --build examples", ARETE_CMAKE));
  fs::create_directory(folder_ / "all");
  std::ofstream(folder_ / "all" / "all.cpp") << everyHeader(prefix / "include");
  std::ofstream(folder_ / "all" / "CMakeLists.txt")
      << "cmake_minimum_required(VERSION 3.22)\nproject(all LANGUAGES CXX)\nfind_package(Arete REQUIRED)\n"
         "add_executable(everything all.cpp)\ntarget_link_libraries(everything PRIVATE Arete::io)\n"
         "target_compile_options(everything PRIVATE -Wall -Wextra -Werror)\n";
  run(fmt::format("'{}' -S all -B all/build {} -DCMAKE_PREFIX_PATH='{}'", ARETE_CMAKE, ARETE_CMAKE_ARGUMENTS,
                  prefix.string()));
  run(fmt::format("'{}' --build all/build", ARETE_CMAKE));
  run("all/build/everything");

  run("'" ARETE_DATASETS_PROGRAM "' generate --size 129 --no-lake --no-sea -o dem.tif -q");
  const auto dem = readRaster((folder_ / "dem.tif").string());
  ASSERT_TRUE(dem) << dem.error().describe();
  const RasterHeightfield& field = dem->heightfield;

  run("examples/build dem.tif dem.amt");
  EXPECT_EQ(out_.rfind("16641 vertices, ", 0), 0u) << out_;
  EXPECT_NE(out_.find(" to 32768 triangles"), std::string::npos) << out_;

  run("examples/cut dem.amt 5 tin.ply");
  EXPECT_NE(out_.find(" triangles within "), std::string::npos) << out_;
  const std::string triangles = out_.substr(0, out_.find(' '));
  EXPECT_GT(std::stoi(triangles), 100);
  EXPECT_LT(std::stoi(triangles), 32768);
  run("prefix/bin/arete measure tin.ply dem.tif --expect 5");
  EXPECT_NE(out_.find("kept"), std::string::npos) << out_;
  run("prefix/bin/arete extract dem.amt -o tin2.ply --max-error 5 --json");
  EXPECT_NE(out_.find(fmt::format("\"triangles\": {},", triangles)), std::string::npos) << out_;

  run("examples/first dem.amt 5 tin3.ply");
  EXPECT_EQ(out_.substr(0, out_.find(' ')), triangles) << out_;
  run("prefix/bin/arete measure tin3.ply dem.tif --expect 5");

  // The first program of the README, as it stands there.
  fs::create_directory(folder_ / "readme");
  const std::string program = firstProgram();
  ASSERT_EQ(std::count(program.begin(), program.end(), '\n'), 6) << program;
  std::ofstream(folder_ / "readme" / "main.cpp") << program;
  std::ofstream(folder_ / "readme" / "CMakeLists.txt")
      << "cmake_minimum_required(VERSION 3.22)\nproject(readme LANGUAGES CXX)\nfind_package(Arete REQUIRED)\n"
         "add_executable(first main.cpp)\ntarget_link_libraries(first PRIVATE Arete::arete)\n"
         "target_compile_options(first PRIVATE -Wall -Wextra -Werror)\n";
  run(fmt::format("'{}' -S readme -B readme/build {} -DCMAKE_PREFIX_PATH='{}'", ARETE_CMAKE,
                  ARETE_CMAKE_ARGUMENTS, prefix.string()));
  run(fmt::format("'{}' --build readme/build", ARETE_CMAKE));
  run("cp dem.amt alps.amt && readme/build/first");
  run("prefix/bin/arete measure alps.glb dem.tif --expect 5.01");
  EXPECT_NE(out_.find("kept"), std::string::npos) << out_;

  std::string places, expected;
  for (const std::uint32_t i : {0u, 5000u, 16640u}) {
    const Vec2 p = field.georeference.toSource(i % 129, i / 129);
    places += fmt::format("{:.12g} {:.12g} ", p.x, p.y);
    expected += fmt::format("{:.12g} {:.12g} {:.12g}\n", p.x, p.y, field.heights[i]);
  }
  run(fmt::format("echo '{}' -1 -1 | examples/heights dem.amt 0", places));
  EXPECT_EQ(out_, expected + "-1 -1 no terrain\n");

  run("examples/follow_camera dem.amt 5");
  EXPECT_EQ(std::count(out_.begin(), out_.end(), '\n'), 5) << out_;
  EXPECT_EQ(out_.rfind("frame 0: ", 0), 0u) << out_;

  // It fails by itself where the buffers that it kept by changes are not those of the mesh.
  run("examples/own_renderer dem.amt 20 last.pgm");
  EXPECT_EQ(std::count(out_.begin(), out_.end(), '\n'), 20) << out_;
  EXPECT_NE(out_.find(" triangles within 1 pixels, "), std::string::npos) << out_;
  const std::string picture = contentOf(folder_ / "last.pgm"), header = "P5\n640 360\n255\n";
  ASSERT_EQ(picture.size(), header.size() + 640 * 360);
  EXPECT_EQ(picture.rfind(header, 0), 0u);
  const auto black = std::count(picture.begin(), picture.end(), '\0');
  EXPECT_GT(black, 0);              // sky
  EXPECT_LT(black, 640 * 360 / 2);  // and ground
}

}  // namespace
}  // namespace arete
