// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/2dm/2dm.h"

#include <gtest/gtest.h>

#include <random>

#include "io/mesh_fixture.h"
#include "sentences_of.h"

namespace arete {
namespace {

using namespace test;

const std::string kWkt = R"(GEOGCRS["WGS 84",ID["EPSG",4326]])";
const std::string kNodes = "ND 1 0 0 1\nND 2 1 0 2\nND 3 0 1 3\nND 4 1 1 4\n";

/// By triangle; empty: the mesh has none.
std::vector<double> materialsOf(const MeshFile& file) {
  std::vector<double> materials;
  for (const Attribute& attribute : file.mesh.triangleAttributes)
    if (attribute.name == k2dmMaterialName)
      for (std::size_t t = 0; t < attribute.elementCount(); ++t)
        materials.push_back(attribute.numbers(t).front());
  return materials;
}

TEST(TwoDmRead, RoundTripsEveryFamilyToTheBit) {
  const TemporaryFolder folder;
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    const TriangleMesh mesh = gridMesh(family.make(31, 22, 5));
    const std::string path = folder.file("a.2dm");
    ASSERT_TRUE(writeMesh(mesh, path, {.crsWkt = kWkt, .verticalUnit = "ft", .notes = {"a\nnote"}}));
    const Result<MeshFile> file = readMesh(path);
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->mesh.positions, mesh.positions);
    EXPECT_EQ(file->mesh.triangles, mesh.triangles);
    EXPECT_EQ(file->crsWkt, kWkt);
    EXPECT_EQ(file->verticalUnit, "ft");
    EXPECT_EQ(file->frame.rounding, Vec3{});
  }
}

TEST(TwoDmRead, ReadsForeignFilesUnderAnyNumbers) {
  const TemporaryFolder folder;
  const std::string quads =
      "MESH2D\nMESHNAME \"a mesh\"\nNUM_MATERIALS_PER_ELEM 2\n  E4Q 7 10 20 40 30 1 0.5\nE2L 9 10 20 1\nE3T "
      "8 10 20 "
      "40\n\nND 40 1 1 4\nND 10 0 0 1.0e0\nND 30 0 1 3 extra\nND 20 1 0 +2\nNS 10 20 -30\nBEGPARAMDEF\nGM "
      "\"x\"\n";
  std::string crlf;
  for (const char c : quads) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& text : {quads, crlf, "\xEF\xBB\xBF" + quads}) {
    const Result<MeshFile> file = readMesh(folder.write("a.2dm", text));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->mesh.positions, (std::vector<Vec3>{{1, 1, 4}, {0, 0, 1}, {0, 1, 3}, {1, 0, 2}}));
    EXPECT_EQ(file->mesh.triangles,
              (std::vector<std::array<std::uint32_t, 3>>{{1, 3, 0}, {1, 0, 2}, {1, 3, 0}}));
    EXPECT_EQ(materialsOf(*file), (std::vector<double>{1, 1, 0}));
    EXPECT_EQ(test::sentencesOf(file->warnings),
              (std::vector<std::string>{
                  "1 of its 2 elements has values that are no number of a material; these are left out",
                  "its cards \"BEGPARAMDEF\" (1), \"E2L\" (1), \"MESHNAME\" (1), \"NS\" (1) are left out"}));
  }
}

TEST(TwoDmRead, KeepsTheNumbersOfMaterialsFromFileToFile) {
  const TemporaryFolder folder;
  const std::string mixed = "E3T 1 1 2 3 1\nE4Q 2 1 2 4 3 -7\nE3T 3 2 4 3\nE3T 4 2 4 3 2147483647\n";
  const Result<MeshFile> file = readMesh(folder.write("a.2dm", "MESH2D\n" + mixed + kNodes));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_TRUE(file->warnings.empty());
  const std::vector<double> expected{1, -7, -7, 0, 2147483647};
  EXPECT_EQ(materialsOf(*file), expected);
  for (const char* name : {"b.2dm", "b.ply"}) {
    const Result<MeshWriteReport> report = writeMesh(file->mesh, folder.file(name));
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->lost.empty()) << name;
    const Result<MeshFile> again = readMesh(folder.file(name));
    ASSERT_TRUE(again) << again.error().describe();
    EXPECT_EQ(materialsOf(*again), expected) << name;
  }
  const Result<MeshWriteReport> report = writeMesh(file->mesh, folder.file("b.off"));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->lost, std::vector<std::string>{"\"material\" of faces"});
}

TEST(TwoDmRead, HasNoAttributeWhereAllMaterialsAreTheUsualOneOrMissing) {
  const TemporaryFolder folder;
  for (const std::string material : {" 1", "", " "}) {
    const Result<MeshFile> file = readMesh(
        folder.write("a.2dm", "MESH2D\nE3T 1 1 2 3" + material + "\nE3T 2 2 4 3" + material + "\n" + kNodes));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_TRUE(file->mesh.triangleAttributes.empty());
    EXPECT_TRUE(file->warnings.empty());
  }
}

TEST(TwoDmWrite, NamesWhatIsNoNumberOfAMaterial) {
  const TemporaryFolder folder;
  SurfaceMesh mesh({{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}, {{0, 1, 2}}});
  Attribute material{.name = "material", .type = ScalarType::float32};
  material.append(std::vector<double>{1.5});
  mesh.triangleAttributes.push_back(material);
  const Result<MeshWriteReport> report = writeMesh(mesh, folder.file("a.2dm"));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->lost, std::vector<std::string>{"\"material\" of faces"});
}

TEST(TwoDmRead, NamesWhatIsWrong) {
  const TemporaryFolder folder;
  ASSERT_TRUE(readMesh(folder.write("a.2dm", "MESH2D\nE3T 1 1 2 3 1\n" + kNodes)));
  for (const char* line :
       {"E3T 1 1 2", "E3T", "E3T 1 1 2 x 1", "E3T 1 1 2 -3 1", "E3T 1 1 2 3.5 1", "E3T 1 1 2 4294967296 1",
        "E4Q 1 1 2 3", "ND 5 0 0", "ND", "ND x 0 0 0", "ND 5 0 0 nan", "ND 5 0 inf 0", "ND 5 0 0 1e999",
        "ND 5 0 0 z", "{\"json\": 1}", "<xml/>"}) {
    const Error error =
        refusal(folder.write("a.2dm", std::string("MESH2D\n") + line + "\nE3T 1 1 2 3 1\n" + kNodes));
    EXPECT_EQ(error.code, ErrorCode::corrupt) << line;
    EXPECT_NE(error.message.find("line 2"), std::string::npos) << error.message;
  }
  for (const char* line : {"E3T 1 1 2 5 1", "E3T 1 0 1 2 1"}) {
    EXPECT_EQ(refusal(folder.write("a.2dm", std::string("MESH2D\n") + line + "\n" + kNodes)).code,
              ErrorCode::corrupt);
    EXPECT_EQ(
        refusal(folder.write("a.2dm", std::string("MESH2D\n") + line + "\n" + kNodes + "ND 99 0 0 0\n")).code,
        ErrorCode::corrupt);
  }
  EXPECT_NE(refusal(folder.write("a.2dm", "MESH2D\nE3T 1 1 2 3 1\n" + kNodes + "ND 2 0 0 0\n"))
                .message.find("two nodes 2"),
            std::string::npos);
  EXPECT_EQ(refusal(folder.write("a.2dm", "MESH2D\nE6T 1 1 2 3 4 1 2 1\n" + kNodes)).code,
            ErrorCode::unsupported);
  EXPECT_EQ(refusal(folder.write("a.2dm", "MESH2D\n" + kNodes)).code, ErrorCode::unsupported);
  for (const std::string& text :
       {std::string(), std::string("\n\n"), std::string("ply\n"), kNodes, std::string("\0\0", 2)})
    EXPECT_EQ(refusal(folder.write("a.2dm", text)).code, ErrorCode::corrupt);
}

TEST(TwoDmRead, NamesTheCardsThatItLeavesOutAndSkipsTheirLines) {
  const TemporaryFolder folder;
  const std::string element = "E3T 1 1 2 3 1\n";
  for (const std::string& rest :
       {std::string("BEGCURVE Version: 1\nXYS 1 4 \"Curve\"\n0.0 0.02\n6000.0 0.053\n12000.0 0.0365\n18000.0 "
                    "0.02\nENDCURVE\n"),
        std::string("XY1 1 3 0 0 0 0 \"series\"\n0 1\n-1.5e3 2\n.5 3\n+2 4\n"),
        std::string("XYS 2 2\n 1 2\n\n 3 4\nXYS 3 1\n5 6\n"), std::string("GM \"Mesh\"\n\"a second line\"\n"),
        std::string("NS 1 2 3 -4\nNS 1 2\n")}) {
    for (const std::string& text :
         {"MESH2D\n" + element + kNodes + rest, "MESH2D\n" + rest + kNodes + element,
          "MESH2D\n" + kNodes + rest + element}) {
      const Result<MeshFile> file = readMesh(folder.write("a.2dm", text));
      ASSERT_TRUE(file) << text << file.error().describe();
      EXPECT_EQ(file->mesh.triangles.size(), 1u) << text;
      const std::string card = rest.substr(0, rest.find(' '));
      ASSERT_EQ(file->warnings.size(), 1u) << text;
      EXPECT_TRUE(file->warnings[0].sentence.starts_with("its cards \"" + card))
          << file->warnings[0].sentence;
    }
  }
  // Numbers behind a node or an element are no lines of another card: the file is damaged.
  for (const std::string& text :
       {"MESH2D\n" + kNodes + "1 2 3\n" + element, "MESH2D\n" + kNodes + element + "0.5 1\n"})
    EXPECT_EQ(refusal(folder.write("a.2dm", text)).code, ErrorCode::corrupt) << text;
}

TEST(TwoDmRead, NoticesThatAFileOfOursIsCutShort) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = {{{0.1, 0, 1}, {1, 0, 2}, {0, 1, -1e-7}}, {{0, 1, 2}}};
  ASSERT_TRUE(writeMesh(mesh, folder.file("a.2dm"), {.crsWkt = kWkt}));
  const std::string whole = bytesOf(folder.file("a.2dm"));
  for (std::size_t length = 0; length < whole.find("arete") + 5; ++length)
    refusal(folder.write("b.2dm", whole.substr(0, length)));
  for (std::size_t length = whole.find("arete") + 5; length + 1 < whole.size(); ++length)
    EXPECT_EQ(refusal(folder.write("b.2dm", whole.substr(0, length))).code, ErrorCode::corrupt) << length;
}

TEST(TwoDmRead, SurvivesAnyDamagedByte) {
  const TemporaryFolder folder;
  const std::string whole = "MESH2D\n# crs X\nE3T 1 1 2 3 1\nE4Q 2 1 2 4 3 1\n" + kNodes;
  std::mt19937 random(4);
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const int flip : {0x01, 0x94}) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      if (random() % 4 == 0) damaged[random() % damaged.size()] = static_cast<char>(random());
      const Result<MeshFile> file = readMesh(folder.write("a.2dm", damaged));
      EXPECT_TRUE(!file || file->mesh.validate());
    }
}

}  // namespace
}  // namespace arete
