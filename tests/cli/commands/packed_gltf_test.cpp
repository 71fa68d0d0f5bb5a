// SPDX-License-Identifier: GPL-3.0-or-later
// Small glTF files of every command that writes meshes, and levels of detail in one.
#include <filesystem>
#include <fstream>

#include "cli/mesh_fixture.h"
#include "io/formats/exchange/mesh_formats.h"

namespace arete::cli_test {
namespace {

class PackedGltfFiles : public Meshes {
 protected:
  /// A sheet of waves with texture coordinates.
  void writeSheet(const std::string& name, int side) {
    std::string text;
    for (int r = 0; r <= side; ++r)
      for (int c = 0; c <= side; ++c)
        text += fmt::format("v {} {} {}\nvt {} {}\n", c * 0.1, std::sin(c * 0.4) * std::cos(r * 0.3), r * 0.1,
                            c / double(side), r / double(side));
    for (int r = 0; r < side; ++r)
      for (int c = 0; c < side; ++c) {
        const int a = r * (side + 1) + c + 1, b = a + 1, d = a + side + 1, e = d + 1;
        text += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\nf {0}/{0} {2}/{2} {3}/{3}\n", a, e, b, d);
      }
    std::ofstream(path(name)) << text;
  }
  std::uintmax_t size(const std::string& name) const { return std::filesystem::file_size(path(name)); }
};

TEST_F(PackedGltfFiles, OfCutsKeepTheErrorThatIsStated) {
  writeSheet("sheet.obj", 30);
  ASSERT_EQ(run({"build", "sheet.obj", "-o", "sheet.amt"}).code, 0);
  for (const char* const bits : {"8", "10", "14", "16"}) {
    SCOPED_TRACE(bits);
    const Outcome cut = run({"extract", "sheet.amt", "-o", "cut.glb", "--max-error", "1%", "--packed",
                             "--position-bits", bits, "--certificate", "--json"});
    ASSERT_EQ(cut.code, 0) << cut.err;
    const auto cutJson = cut.json()["exports"][0];
    EXPECT_TRUE(cutJson["kept"]);
    const std::string error = fmt::format("{}", cutJson["error"].get<double>());
    EXPECT_GT(cutJson["movedByGrid"].get<double>(), 0);
    EXPECT_EQ(run({"measure", "cut.glb", "sheet.obj", "--expect", error}).code, 0);
    const bool isCoarse = std::string(bits) == "8";
    EXPECT_TRUE(isCoarse || cutJson["error"].get<double>() <= cutJson["maxError"].get<double>());
  }
}

TEST_F(PackedGltfFiles, OfTerrainKeepTheErrorThatIsStated) {
  makeRaster("dem.tif", "fractal", 60, 50);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  for (const char* const asked : {"--max-error", "--max-triangles"})
    for (const char* const bits : {"12", "16"}) {
      const Outcome cut = run({"extract", "dem.amt", "-o", "tin.glb", asked,
                               std::string(asked) == "--max-error" ? "8" : "500", "--packed",
                               "--position-bits", bits, "--certificate", "--json"});
      ASSERT_EQ(cut.code, 0) << cut.err;
      const std::string error = fmt::format("{}", cut.json()["exports"][0]["promisedError"].get<double>());
      EXPECT_EQ(run({"measure", "tin.glb", "dem.tif", "--expect", error}).code, 0) << error;
    }
  const Outcome coarse =
      run({"extract", "dem.amt", "-o", "tin.glb", "--max-error", "8", "--packed", "--position-bits", "8"});
  EXPECT_TRUE(says(coarse, "moves the rim of the terrain")) << coarse.err;
  EXPECT_TRUE(says(coarse, "--position-bits states more"));
}

TEST_F(PackedGltfFiles, AreMadeByEveryCommandThatWritesMeshes) {
  writeSheet("sheet.obj", 20);
  ASSERT_EQ(run({"convert", "sheet.obj", "-o", "plain.glb"}).code, 0);
  const std::vector<std::vector<std::string>> commands = {
      {"convert", "sheet.obj"},
      {"mesh", "repair", "sheet.obj"},
      {"mesh", "place", "sheet.obj", "--scale", "2"},
      {"mesh", "crop", "sheet.obj", "--box", "0,-9,0,9,9,9"},
      {"mesh", "decimate", "sheet.obj", "--max-triangles", "90%"}};
  for (std::vector<std::string> command : commands) {
    SCOPED_TRACE(command[command.size() > 2 ? 1 : 0]);
    command.insert(command.end(), {"-o", "small.glb", "--packed"});
    const Outcome written = run(command);
    ASSERT_EQ(written.code, 0) << written.err;
    EXPECT_LT(3 * size("small.glb"), 2 * size("plain.glb"));
    EXPECT_TRUE(readMesh(path("small.glb")));
  }
}

TEST_F(PackedGltfFiles, HoldTheLevelsOfAList) {
  writeSheet("sheet.obj", 20);
  ASSERT_EQ(run({"build", "sheet.obj", "-o", "sheet.amt"}).code, 0);
  for (const char* const name : {"levels.glb", "levels.gltf"}) {
    const Outcome levels =
        run({"extract", "sheet.amt", "-o", name, "--max-triangles", "50%,10%,3%", "--levels", "--packed"});
    ASSERT_EQ(levels.code, 0) << levels.err;
    EXPECT_TRUE(says(levels, "3 levels of detail"));
    EXPECT_FALSE(says(levels, "arete-levels")) << "no file of the user's: " << levels.out << levels.err;
    const Result<MeshFile> file = readMesh(path(name));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_NEAR(double(file->mesh.triangles.size()), 400, 4);
  }
  makeRaster("dem.tif", "fractal", 30, 30);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const Outcome terrain = run({"extract", "dem.amt", "-o", "dem.glb", "--max-error", "2,20", "--levels"});
  EXPECT_EQ(terrain.code, 0) << terrain.err;
  EXPECT_EQ(run({"measure", "dem.glb", "dem.tif", "--expect", "2.01"}).code, 0);
}

TEST_F(PackedGltfFiles, AreRefusedWhereTheyCannotBe) {
  writeSheet("sheet.obj", 4);
  ASSERT_EQ(run({"build", "sheet.obj", "-o", "sheet.amt"}).code, 0);
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused = {
      {{"convert", "sheet.obj", "-o", "a.ply", "--packed"}, "--packed"},
      {{"convert", "sheet.obj", "-o", "a.glb", "--position-bits", "12"}, "--position-bits 12"},
      {{"convert", "sheet.obj", "-o", "a.glb", "--packed", "--position-bits", "17"}, "--position-bits 17"},
      {{"extract", "sheet.amt", "-o", "a.glb", "--max-error", "1%", "--packed", "--map", "m.csv"}, "--map"},
      {{"extract", "sheet.amt", "-o", "a.ply", "--max-error", "1%,2%", "--levels"}, "--levels"},
      {{"extract", "sheet.amt", "-o", "a.glb", "--max-error", "1%", "--levels"}, "--levels"},
      {{"mesh", "decimate", "sheet.obj", "-o", "a.glb", "--max-triangles", "9", "--packed", "--map", "m.csv"},
       "--map"}};
  for (const auto& [command, culprit] : refused) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(says(outcome, culprit)) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(path(command[3])));
  }
}

TEST_F(PackedGltfFiles, HaveTheirTexturesTurnedOver) {
  writeSheet("sheet.obj", 4);
  ASSERT_EQ(run({"convert", "sheet.obj", "-o", "once.ply", "--flip-v"}).code, 0);
  ASSERT_EQ(run({"convert", "once.ply", "-o", "twice.obj", "--flip-v"}).code, 0);
  const Result<MeshFile> before = readMesh(path("sheet.obj")), once = readMesh(path("once.ply")),
                         twice = readMesh(path("twice.obj"));
  ASSERT_TRUE(before && once && twice);
  const auto coords = [](const MeshFile& file) {
    const MeshAttributes& mesh = file.mesh;
    return mesh.vertexAttributes.empty() ? mesh.wedgeAttributes.at(0) : mesh.vertexAttributes.at(0);
  };
  const Attribute a = coords(*before), b = coords(*once), c = coords(*twice);
  ASSERT_EQ(a.elementCount(), b.elementCount());
  for (std::size_t i = 0; i < a.elementCount(); ++i) {
    EXPECT_EQ(b.numbers(i)[0], a.numbers(i)[0]);
    EXPECT_NEAR(b.numbers(i)[1], 1 - a.numbers(i)[1], 1e-7);
    EXPECT_NEAR(c.numbers(i)[1], a.numbers(i)[1], 1e-7);
  }
  std::ofstream(path("bare.obj")) << kTetrahedron;
  const Outcome bare = run({"convert", "bare.obj", "-o", "a.ply", "--flip-v"});
  EXPECT_EQ(bare.code, 2);
  EXPECT_TRUE(says(bare, "--flip-v: the mesh has no texture coordinates")) << bare.err;
}

}  // namespace
}  // namespace arete::cli_test
