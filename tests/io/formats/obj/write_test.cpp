// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstring>

#include "io/formats/obj/obj.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

constexpr std::uint32_t kNone = MeshAttributes::kNone;

template <class Number>
Attribute attribute(std::string name, AttributeMeaning meaning, ScalarType type, std::uint8_t components,
                    const std::vector<Number>& numbers) {
  Attribute result{.name = std::move(name), .meaning = meaning, .type = type, .components = components};
  result.values.resize(numbers.size() * sizeof(Number));
  std::memcpy(result.values.data(), numbers.data(), result.values.size());
  return result;
}

/// A square of two triangles and a third one.
SurfaceMesh square() {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 2, 3}};
  return mesh;
}

class ObjWrite : public MeshFileTest {
 protected:
  MeshWriteReport write(const SurfaceMesh& mesh, const fs::path& path, MeshWriteOptions options = {}) const {
    if (options.pictureFolder.empty()) options.pictureFolder = folder_;
    Result<MeshWriteReport> report = writeObj(mesh, path, options);
    EXPECT_TRUE(report) << report.error().describe();
    return report ? std::move(*report) : MeshWriteReport();
  }
  std::string expected_;
  /// What is read again, without other warnings than that.
  SurfaceMesh again(const SurfaceMesh& mesh) const {
    const MeshWriteReport report = write(mesh, folder_ / "again.obj");
    EXPECT_TRUE(report.lost.empty()) << report.lost[0];
    Result<MeshFile> file = readObj(folder_ / "again.obj");
    EXPECT_TRUE(file) << file.error().describe();
    if (!file) return {};
    for (const std::string& warning : file->warnings) EXPECT_EQ(warning, expected_);
    return std::move(file->mesh);
  }
};

TEST_F(ObjWrite, AMeshWithoutAttributesIsItsVerticesAndFaces) {
  SurfaceMesh mesh = square();
  mesh.positions[3].z = 1.0 / 3;
  const MeshWriteReport report = write(mesh, folder_ / "a.obj", {.crsWkt = "X", .notes = {"a note"}});
  EXPECT_EQ(contents(folder_ / "a.obj"),
            "# generator arete\n# crs X\n# a note\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.3333333333333333\n"
            "f 1 2 3\nf 1 3 4\nf 2 3 4\n# end\n");
  EXPECT_TRUE(report.lost.empty());
  EXPECT_TRUE(report.filesBeside.empty());
}

TEST_F(ObjWrite, EverythingThatAnObjCanHoldComesBack) {
  SurfaceMesh mesh = square();
  mesh.wedgeAttributes = {
      attribute<float>("texcoord", AttributeMeaning::textureCoords, ScalarType::float32, 2,
                       {0, 0, 0.1f, 0, 1, 1.0f / 3, 0.25f, 1, 0.75f, 0.5f}),
      attribute<double>("normal", AttributeMeaning::normal, ScalarType::float64, 3,
                        {0, 0, 1, 0, 0.6, 0.8, 0, 0, 1, 1.0 / 3, 2.0 / 3, 2.0 / 3, 0, 0, 0})};
  mesh.wedgeCount = 5;
  mesh.wedges = {{0, 1, 2}, {0, 2, 3}, {1, 4, 3}};
  Attribute color = attribute<std::uint8_t>("color", AttributeMeaning::color, ScalarType::uint8, 3,
                                            {0, 1, 2, 128, 254, 255, 3, 77, 100, 51, 52, 53});
  color.isNormalized = true;
  color.colorSpace = ColorSpace::srgb;
  mesh.vertexAttributes = {color};
  mesh.triangleAttributes = {
      attribute<std::int32_t>("smoothing_group", AttributeMeaning::other, ScalarType::int32, 1, {0, 3, 0})};
  mesh.objects = {"unused", "body of it", "", "end"};
  mesh.objectOf = {kNone, 1, 2};
  mesh.groups = {"c", "a b", "unused"};
  mesh.groupOf = {0, kNone, 1};
  mesh.materials = {{.name = "red", .baseColor = {1, 0.5, 0, 1}},
                    {.name = "glass", .baseColor = {1, 1, 1, 0.5}}};
  mesh.materials[1].alphaMode = "BLEND";
  mesh.materials[0].textures = {{"baseColor", "maps/red wood.png"}};
  mesh.materials[0].verbatim = {{"mtl", "Ka 1 1 1\nNs 10"}, {"mtl:baseColor", "-s 2 2 2"}};
  mesh.materialOf = {0, 1, kNone};
  fs::create_directories(folder_ / "maps");
  put("maps/red wood.png", "pixels");
  expected_ = "some corners have normals and some have none; those get zeros";
  EXPECT_EQ(again(mesh), mesh);
  const std::string text = contents(folder_ / "again.obj");
  EXPECT_NE(text.find("vt 0.1 0\nvt 1 0.33333334\n"), std::string::npos) << text;
  EXPECT_NE(text.find("g c\nusemtl red\nf 1/1/1 2/2/2 3/3/1\n"
                      "o unused\no body of it\ng\nusemtl glass\ns 3\nf 1/1/1 3/3/1 4/4/3\n"
                      "o\ng a b\nusemtl\ns off\nf 2/2/2 3/5 4/4/3\no end\ng unused\n# end\n"),
            std::string::npos)
      << text;
  const SurfaceMesh first = again(mesh);
  EXPECT_EQ(again(first), first);
}

TEST_F(ObjWrite, AttributesOfVerticesAreThoseOfTheirCorners) {
  SurfaceMesh mesh = square();
  Attribute texcoord = attribute<float>("texcoord", AttributeMeaning::textureCoords, ScalarType::float32, 2,
                                        {0, 0.1f, 1, 0, 1, 1, 0, 0.75f});
  texcoord.isFromTop = true;
  mesh.vertexAttributes = {texcoord, attribute<float>("normal", AttributeMeaning::normal, ScalarType::float32,
                                                      3, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})};
  const SurfaceMesh read = again(mesh);
  ASSERT_EQ(read.wedgeAttributes.size(), 2u);
  const auto v = [&](std::size_t t, std::size_t k) {
    return read.wedgeAttributes[0].numbers(read.wedges[t][k])[1];
  };
  // 1 - v, exactly, so that it can be turned back.
  EXPECT_EQ(1 - v(0, 0), double(0.1f));
  EXPECT_EQ(v(0, 1), 1);
  EXPECT_EQ(v(1, 2), 0.25);
  EXPECT_EQ(read.wedgeCount, 4u);
}

TEST_F(ObjWrite, LinearColoursAreWrittenAsSrgb) {
  // Codes of 8 bits survive 16 linear ones.
  SurfaceMesh mesh;
  std::vector<std::uint16_t> linear;
  for (int code = 0; code < 256; ++code) {
    mesh.positions.push_back({double(code), 0, 0});
    const double s = code / 255.0;
    const double l = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    for (int i = 0; i < 3; ++i) linear.push_back(std::uint16_t(std::lround(l * 65535)));
    linear.push_back(65535);
  }
  mesh.triangles = {{0, 1, 2}};
  Attribute color = attribute<std::uint16_t>("color", AttributeMeaning::color, ScalarType::uint16, 4, linear);
  color.isNormalized = true;
  color.colorSpace = ColorSpace::linear;
  mesh.vertexAttributes = {color};
  const SurfaceMesh read = again(mesh);
  ASSERT_EQ(read.vertexAttributes.size(), 1u);
  EXPECT_EQ(read.vertexAttributes[0].type, ScalarType::uint8);
  for (std::size_t code = 0; code < 256; ++code)
    EXPECT_EQ(read.vertexAttributes[0].numbers(code), (std::vector<double>(3, double(code))));
}

TEST_F(ObjWrite, NamesWhatItCannotHold) {
  SurfaceMesh mesh = square();
  const std::vector<float> four(4, 0.5f);
  mesh.vertexAttributes = {attribute<float>("quality", AttributeMeaning::other, ScalarType::float32, 1, four),
                           attribute<float>("color", AttributeMeaning::color, ScalarType::float32, 4,
                                            std::vector<float>(16, 0.5f)),
                           attribute<float>("texcoord", AttributeMeaning::textureCoords, ScalarType::float32,
                                            2, {NAN, 0, 1, 1, 0, 0, 0, INFINITY}),
                           attribute<float>("texcoord1", AttributeMeaning::textureCoords, ScalarType::float32,
                                            2, std::vector<float>(8, 0.5f))};
  mesh.triangleAttributes = {
      attribute<std::int32_t>("label", AttributeMeaning::other, ScalarType::int32, 1, {1, 2, 3})};
  mesh.objects = {"a", " b\nc "};
  mesh.objectOf = {0, 1, 0};
  mesh.groups = {"g", "g"};
  mesh.groupOf = {0, 1, kNone};
  mesh.materials = {{.name = "m"}, {.name = "m"}};
  mesh.materials[1].textures = {{"baseColor", "none.png"}};
  mesh.materialOf = {0, 1, 1};
  const MeshWriteReport report = write(mesh, folder_ / "a.obj");
  std::string lost;
  for (const std::string& text : report.lost) lost += text + "\n";
  for (const char* what : {"\"quality\"", "\"texcoord1\"", "\"label\" of faces", "alpha of vertex colours",
                           "not finite", "objects whose faces are apart", "blanks at the ends of names",
                           "groups without a name of their own", "names of materials",
                           "the picture \"none.png\", which "
                           "does not exist"})
    EXPECT_NE(lost.find(what), std::string::npos) << what << "\n" << lost;
  EXPECT_EQ(lost.find("\"color\""), std::string::npos) << lost;
  const Result<MeshFile> read = readObj(folder_ / "a.obj");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->mesh.objects, (std::vector<std::string>{"a", "b c", "a"}));
  EXPECT_EQ(read->mesh.materialOf, (std::vector<std::uint32_t>{0, 1, 1}));
  EXPECT_EQ(read->mesh.materials[1].textures[0].picture, "none.png");
}

TEST_F(ObjWrite, BringsThePicturesInsideTheMeshAlong) {
  // assimp #3944: "*0" in the MTL
  SurfaceMesh mesh = square();
  mesh.pictures = {{"wood", "image/png", {std::byte{'x'}}}};
  mesh.materials = {{.name = "m"}};
  mesh.materials[0].textures = {{"baseColor", "#0"}};
  mesh.materialOf = {0, 0, 0};
  const MeshWriteReport report = write(mesh, folder_ / "a.obj");
  EXPECT_EQ(report.filesBeside, (std::vector<fs::path>{folder_ / "a.mtl", folder_ / "wood.png"}));
  EXPECT_EQ(contents(folder_ / "a.mtl"),
            "# generator arete, for a.obj\n\nnewmtl m\nKd 1 1 1\nmap_Kd wood.png\n");
  EXPECT_EQ(contents(folder_ / "wood.png"), "x");
}

TEST_F(ObjWrite, NeverOverwritesTheMaterialsOfAnother) {
  SurfaceMesh mesh = square();
  mesh.materials = {{.name = "m"}};
  mesh.materialOf = {0, 0, 0};
  put("a.mtl", "newmtl mine\n");
  put("a-1.mtl", "# generator arete, for a.objx\n");
  fs::create_symlink(folder_ / "elsewhere.mtl", folder_ / "a-2.mtl");
  for (int run = 0; run < 2; ++run) {  // the second one overwrites its own
    mesh.materials[0].baseColor[0] = run;
    EXPECT_EQ(write(mesh, folder_ / "a.obj").filesBeside, std::vector<fs::path>{folder_ / "a-3.mtl"});
  }
  EXPECT_EQ(readObj(folder_ / "a.obj")->mesh.materials[0].baseColor[0], 1);
  EXPECT_EQ(contents(folder_ / "a.mtl"), "newmtl mine\n");
  EXPECT_FALSE(fs::exists(folder_ / "elsewhere.mtl"));

  // Equal stems in one folder.
  EXPECT_EQ(write(mesh, folder_ / "tin.obj").filesBeside, std::vector<fs::path>{folder_ / "tin.mtl"});
  EXPECT_EQ(write(mesh, folder_ / "tin.OBJ").filesBeside, std::vector<fs::path>{folder_ / "tin-1.mtl"});
  EXPECT_EQ(write(mesh, folder_ / "tin.obj").filesBeside, std::vector<fs::path>{folder_ / "tin.mtl"});
  EXPECT_EQ(write(mesh, folder_ / "with blank.obj").filesBeside,
            std::vector<fs::path>{folder_ / "with blank.mtl"});
  EXPECT_EQ(readObj(folder_ / "with blank.obj")->mesh.materials,
            mesh.materials.size() == 1 ? readObj(folder_ / "tin.obj")->mesh.materials : mesh.materials);
}

TEST_F(ObjWrite, ToAPipeHasNoFilesBesideIt) {
  SurfaceMesh mesh = square();
  mesh.materials = {{.name = "m"}};
  mesh.materials[0].textures = {{"baseColor", "a.png"}};
  mesh.materialOf = {0, 0, 0};
  const Result<MeshWriteReport> report = writeObj(mesh, "/dev/null");
  ASSERT_TRUE(report);
  EXPECT_EQ(report->lost, (std::vector<std::string>{"materials (\"m\")", "pictures of materials"}));
  EXPECT_TRUE(report->filesBeside.empty());
}

TEST_F(ObjWrite, LeavesNothingOfAMeshThatIsInvalid) {
  SurfaceMesh mesh = square();
  mesh.materialOf = {7, 0, 0};
  mesh.materials = {{.name = "m"}};
  EXPECT_EQ(writeObj(mesh, folder_ / "a.obj").error().code, ErrorCode::invalidData);
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace arete
