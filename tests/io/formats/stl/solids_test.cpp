// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an STL says of its facets beside their corners: solids, colours, normals.
#include <gtest/gtest.h>

#include <cstring>

#include "io/formats/stl/stl.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

constexpr std::uint32_t kNone = MeshAttributes::kNone;

class Stl : public MeshFileTest {
 protected:
  MeshFile read(const std::string& bytes) const {
    Result<MeshFile> file = readStl(put("a.stl", bytes));
    EXPECT_TRUE(file) << file.error().describe();
    if (!file) return {};
    EXPECT_TRUE(file->mesh.validate());
    return std::move(*file);
  }
  MeshWriteReport write(const SurfaceMesh& mesh,
                        const MeshWriteOptions& options = {.up = MeshUp::unknown}) const {
    Result<MeshWriteReport> report = writeStl(mesh, folder_ / "b.stl", options);
    EXPECT_TRUE(report) << report.error().describe();
    return report ? std::move(*report) : MeshWriteReport();
  }

  static std::string facet(int x, const char* normal = "0 0 1") {
    const std::string at = std::to_string(x);
    return "facet normal " + std::string(normal) + "\nouter loop\nvertex " + at + " 0 0\nvertex " + at +
           "1 0 0\nvertex " + at + " 1 0\nendloop\nendfacet\n";
  }

  /// Facets with words behind them.
  static std::string binary(std::string header, const std::vector<std::uint16_t>& words, float nz = 1) {
    header.resize(80, '\0');
    const auto count = static_cast<std::uint32_t>(words.size());
    header.append(reinterpret_cast<const char*>(&count), 4);
    for (const std::uint16_t word : words) {
      const float numbers[12] = {0, 0, nz, 0, 0, 0, 1, 0, 0, 0, 1, 0};
      header.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
      header.append(reinterpret_cast<const char*>(&word), 2);
    }
    return header;
  }
};

TEST_F(Stl, SolidsAreObjectsWithTheirNames) {
  // assimp #104, #604, #1970 (empty solids), trimesh #1053, #1761 (names behind "endsolid"), StlVault #45
  // (blanks), numpy-stl #206 and MeshLab #194 ("end solid", "end loop").
  std::string text = "solid  assembly - 300K can \r\n" + facet(1) + facet(2) +
                     "endsolid assembly\nsolid\nendsolid\n" + "SOLID b\n" + facet(3) +
                     "ENDSOLID other\nsolid b\n" + facet(4) + "end solid b";
  for (std::size_t at = text.rfind("endloop"); at != std::string::npos; at = std::string::npos)
    text.replace(at, 7, "end loop");
  const SurfaceMesh mesh = read(text).mesh;
  EXPECT_EQ(mesh.objects, (std::vector<std::string>{"assembly - 300K can", "", "b", "b"}));
  EXPECT_EQ(mesh.objectOf, (std::vector<std::uint32_t>{0, 0, 2, 3}));
  EXPECT_EQ(mesh.positions.size(), 12u);  // as in the file: each facet has its own
  EXPECT_EQ(read("solid one\n" + facet(1) + "endsolid one").mesh.objects, std::vector<std::string>{"one"});
  EXPECT_TRUE(read("solid\n" + facet(1) + "endsolid").mesh.objects.empty());

  const MeshWriteReport report = write(mesh);
  EXPECT_TRUE(report.lost.empty()) << report.lost[0];
  EXPECT_TRUE(contents(folder_ / "b.stl")
                  .starts_with("solid assembly - 300K can\n facet normal 0 0 1\n  outer loop\n"
                               "   vertex 1 0 0\n   vertex 11 0 0\n   vertex 1 1 0\n  endloop\n"
                               " endfacet\n"));
  EXPECT_EQ(readStl(folder_ / "b.stl")->mesh, mesh);
}

TEST_F(Stl, OneObjectIsBinaryAndKeepsItsName) {
  SurfaceMesh mesh = read("solid one of it\n" + facet(1) + facet(2) + "endsolid").mesh;
  EXPECT_TRUE(write(mesh).lost.empty());
  EXPECT_EQ(fs::file_size(folder_ / "b.stl"), 84 + 2 * 50);
  EXPECT_EQ(readStl(folder_ / "b.stl")->mesh, mesh);
  mesh.objects[0] = std::string(70, 'x');
  EXPECT_EQ(write(mesh).lost.size(), 1u);
  EXPECT_EQ(readStl(folder_ / "b.stl")->mesh.objects[0], std::string(67, 'x'));
  mesh.objectOf = {0, kNone};  // not all of it is the object
  EXPECT_EQ(write(mesh).lost, std::vector<std::string>{"faces of no object"});
  EXPECT_EQ(readStl(folder_ / "b.stl")->mesh.objects.size(), 2u);
}

TEST_F(Stl, TextIsExactWhereItHasTheDigitsOfDoubles) {
  std::string text = "solid\n" + facet(1) + "endsolid\n";
  EXPECT_GT(read(text).frame.rounding.x, 0);
  text.replace(text.find("vertex 1 "), 9, "vertex 000.100000001 ");
  EXPECT_GT(read(text).frame.rounding.x, 0);
  text.replace(text.find("vertex 000.100000001 "), 21, "vertex 0.10000000149011612 ");
  EXPECT_EQ(read(text).frame.rounding, Vec3());
}

TEST_F(Stl, WithoutADirectionUpHasNoOrigin) {
  SurfaceMesh mesh;
  mesh.positions = {{1000.5, 2000, 3}, {1001, 2000, 3}, {1000, 2001, 3}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_TRUE(write(mesh).lost.empty());
  const MeshFile plain = std::move(*readStl(folder_ / "b.stl"));
  EXPECT_FALSE(plain.frame.origin);
  EXPECT_EQ(plain.up, MeshUp::unknown);
  EXPECT_EQ(plain.mesh, mesh);
  EXPECT_FALSE(contents(folder_ / "b.stl").starts_with("solid"));

  mesh.positions[0].x = 1000.1;
  write(mesh);
  EXPECT_GE(readStl(folder_ / "b.stl")->frame.rounding.x, 2.3e-5);
  EXPECT_TRUE(write(mesh, {.up = MeshUp::z}).lost.empty());
  EXPECT_TRUE(readStl(folder_ / "b.stl")->frame.origin);
  EXPECT_TRUE(write(mesh, {.origin = Vec3{1000, 2000, 0}, .up = MeshUp::unknown}).lost.empty());
  EXPECT_EQ(readStl(folder_ / "b.stl")->frame.origin, (Vec3{1000, 2000, 0}));
}

TEST_F(Stl, ColoursOfFacetsAreReadWhereTheyAreClear) {
  struct Case {
    std::string header;
    std::vector<std::uint16_t> words;
    const char* name;
    std::vector<double> numbers;  // of the first two facets
  };
  const std::string magics = std::string("COLOR=\x0A\x14\x1E\xFF,MATERIAL=");
  for (const Case& c :
       {Case{"VisCAM", {0xFC00, 0x801F}, "color", {255, 0, 0, 0, 0, 255}},
        Case{"", {0x83E0, 0xFFFF}, "color", {0, 255, 0, 255, 255, 255}},
        Case{"", {0xFC00, 0x0000}, "attribute", {0xFC00, 0}}, Case{"", {0, 7, 0}, "attribute", {0, 7}},
        // vcglib #241: with Magics, the highest bit stands for the colour of the header.
        Case{magics, {0x001F, 0x8000}, "color", {255, 0, 0, 10, 20, 30}},
        Case{magics, {0x7C00, 0x03E0}, "color", {0, 0, 255, 0, 255, 0}},
        Case{"COLOR=\x0A\x14\x1E\x7F", {0x7C00, 0x03E0}, "attribute", {0x7C00, 0x03E0}},
        Case{magics, {0, 0}, nullptr, {}}}) {
    const SurfaceMesh mesh = read(binary(c.header, c.words)).mesh;
    ASSERT_EQ(mesh.triangleAttributes.size(), c.name ? 1u : 0u) << c.header;
    if (!c.name) continue;
    const Attribute& attribute = mesh.triangleAttributes[0];
    EXPECT_EQ(attribute.name, c.name);
    std::vector<double> numbers = attribute.numbers(0), second = attribute.numbers(1);
    numbers.insert(numbers.end(), second.begin(), second.end());
    EXPECT_EQ(numbers, c.numbers) << c.name;
    write(mesh);
    const SurfaceMesh again = readStl(folder_ / "b.stl")->mesh;
    if (c.numbers != std::vector<double>{255, 0, 0, 10, 20, 30}) {
      EXPECT_EQ(again, mesh);
    }
  }
  // All 32 codes of five bits come back.
  std::vector<std::uint16_t> words;
  for (std::uint16_t code = 0; code < 32; ++code)
    words.push_back(std::uint16_t(0x8000 | code << 10 | code << 5 | code));
  const SurfaceMesh mesh = read(binary("", words)).mesh;
  EXPECT_TRUE(write(mesh).lost.empty());
  EXPECT_EQ(contents(folder_ / "b.stl").substr(84), binary("", words).substr(84));
  SurfaceMesh finer = mesh;
  finer.triangleAttributes[0].values[0] = std::byte{1};
  EXPECT_EQ(write(finer).lost, std::vector<std::string>{"colours of faces finer than 5 bits"});
}

TEST_F(Stl, SaysWhereNormalsContradictTheCorners) {
  EXPECT_TRUE(read(binary("", {0, 0, 0})).warnings.empty());
  EXPECT_TRUE(read(binary("", {0, 0, 0}, 0)).warnings.empty());
  EXPECT_EQ(read(binary("", {0, 0, 0}, -1)).warnings.size(), 1u);
  const std::string three = facet(1, "0 0 -1") + facet(2, "0 0 -1.0") + facet(3);
  const MeshFile file = read("solid\n" + three + "endsolid\n");
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].sentence.find("2 of its 3 facets"), std::string::npos)
      << file.warnings[0].sentence;
  EXPECT_TRUE(read("solid\n" + facet(1, "nan 0 0") + facet(2, "") + facet(3, "0 0 x") + "endsolid\n")
                  .warnings.empty());
}

TEST_F(Stl, NamesWhatItCannotHold) {
  SurfaceMesh mesh = read(binary("", {0x8001, 0x8002})).mesh;
  mesh.materials = {{.name = "m"}};
  mesh.groups = {"g"};
  Attribute quality{.name = "quality"};
  quality.values.resize(mesh.positions.size() * 4);
  mesh.vertexAttributes = {quality};
  EXPECT_EQ(write(mesh).lost.size(), 3u);
  mesh.objects = {"a", "b"};
  mesh.objectOf = {1, 0};
  const MeshWriteReport report = write(mesh);
  ASSERT_EQ(report.lost.size(), 4u);
  EXPECT_NE(report.lost[1].find("\"color\" of faces"), std::string::npos) << report.lost[1];
}

}  // namespace
}  // namespace arete
