// SPDX-License-Identifier: GPL-3.0-or-later
//
// Materials, their textures and pictures; transforms of textures.
#include "io/formats/glb/reader/materials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "io/formats/glb/glb.h"
#include "io/formats/glb/texture_transform.h"
#include "io/glb_fixture.h"
#include "io/mesh_fixture.h"
#include "sentences_of.h"

namespace arete {
namespace {

using namespace test;

class GltfMaterial : public ::testing::Test {
 protected:
  MeshFile read(const Assembled& made) const {
    Result<MeshFile> file = readGlb(folder.write("a.glb", made.glb()));
    if (!file) {
      ADD_FAILURE() << file.error().describe();
      return {};
    }
    EXPECT_TRUE(file->mesh.validate());
    return std::move(*file);
  }
  static std::string bytesOf(const EmbeddedPicture& picture) {
    return std::string(reinterpret_cast<const char*>(picture.bytes.data()), picture.bytes.size());
  }

  TemporaryFolder folder;
};

TEST_F(GltfMaterial, HasFieldsTexturesAndTheRestAsWritten) {
  Assembled made = oneTriangle();
  made.primitive()["material"] = 1;
  const std::size_t inside = made.view("PNG bytes");
  made.json["images"] = {{{"uri", "wood%20%231.png"}},
                         {{"bufferView", inside}, {"mimeType", "image/png"}, {"name", "bark"}},
                         {{"uri", "data:image/jpeg;base64,SlBFRw=="}},
                         {{"uri", "unused.png"}}};
  made.json["samplers"] = {{{"wrapS", 33071}, {"magFilter", 9728}}};
  made.json["textures"] = {{{"source", 0}, {"sampler", 0}},
                           {{"source", 1}},
                           {{"extensions", {{"KHR_texture_basisu", {{"source", 2}}}}}}};
  made.json["materials"] = Json::parse(R"([{}, {
    "name": "oak", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25,
    "emissiveFactor": [1, 0.5, 0],
    "extras": {"from": "a scan"},
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "roughnessFactor": 0.7,
      "baseColorTexture": {"index": 0, "texCoord": 1,
        "extensions": {"KHR_texture_transform": {"scale": [2, 3]}}}},
    "normalTexture": {"index": 1, "scale": 0.5},
    "extensions": {"KHR_materials_sheen": {"sheenRoughnessFactor": 0.3,
      "sheenColorTexture": {"index": 2}}}
  }])");
  const MeshFile file = read(made);
  ASSERT_EQ(file.mesh.materials.size(), 2u);
  EXPECT_EQ(file.mesh.materials[0], Material{});
  EXPECT_EQ(file.mesh.materialOf, (std::vector<std::uint32_t>{1}));
  const Material& oak = file.mesh.materials[1];
  EXPECT_EQ(oak.name, "oak");
  EXPECT_EQ(oak.baseColor, (std::array<double, 4>{0.1, 0.2, 0.3, 0.4}));
  EXPECT_TRUE(oak.isDoubleSided);
  EXPECT_EQ(oak.alphaMode, "MASK");
  EXPECT_EQ(oak.alphaCutoff, 0.25);
  EXPECT_EQ(oak.textures,
            (std::vector<TextureUse>{{"baseColor", "wood #1.png", 1},
                                     {"normal", "#0", 0},
                                     {"extensions/KHR_materials_sheen/sheenColorTexture", "#1", 0}}));
  EXPECT_EQ(Json::parse(oak.verbatim.at("gltf")), Json::parse(R"({
    "emissiveFactor": [1, 0.5, 0], "extras": {"from": "a scan"},
    "pbrMetallicRoughness": {"roughnessFactor": 0.7},
    "extensions": {"KHR_materials_sheen": {"sheenRoughnessFactor": 0.3}}})"));
  EXPECT_EQ(Json::parse(oak.verbatim.at("gltf:baseColor")), Json::parse(R"({
    "sampler": {"wrapS": 33071, "magFilter": 9728},
    "extensions": {"KHR_texture_transform": {"scale": [2, 3]}}})"));
  EXPECT_EQ(Json::parse(oak.verbatim.at("gltf:normal")), Json::parse(R"({"scale": 0.5})"));
  EXPECT_EQ(oak.verbatim.size(), 3u);
  ASSERT_EQ(file.mesh.pictures.size(), 2u);
  EXPECT_EQ(file.mesh.pictures[0].name, "bark");
  EXPECT_EQ(file.mesh.pictures[0].mimeType, "image/png");
  EXPECT_EQ(bytesOf(file.mesh.pictures[0]), "PNG bytes");
  EXPECT_EQ(file.mesh.pictures[1].mimeType, "image/jpeg") << "as the URI says";
  EXPECT_EQ(bytesOf(file.mesh.pictures[1]), "JPEG");
  EXPECT_EQ(test::sentencesOf(file.warnings),
            (std::vector<std::string>{"1 picture that no material uses is left out"}));
}

TEST_F(GltfMaterial, IsReadWithoutWhatIsDamaged) {
  Assembled made = oneTriangle();
  made.primitive()["material"] = 0;
  made.json["images"] = {{{"bufferView", 99}}, {{"uri", "data:image/png,plain"}}, Json::object()};
  made.json["textures"] = {
      {{"source", 0}}, {{"source", 1}}, {{"source", 2}}, {{"source", 3}}, Json::object()};
  made.json["materials"] = Json::parse(R"([{
    "name": "bad\u001b", "doubleSided": 1, "alphaMode": "GLASS", "alphaCutoff": "x",
    "pbrMetallicRoughness": {"baseColorFactor": [1, 2], "baseColorTexture": {"index": 0},
      "metallicRoughnessTexture": {"index": 1}},
    "normalTexture": {"index": 2}, "occlusionTexture": {"index": 3}, "emissiveTexture": {"index": 4}
  }, 7])");
  const MeshFile file = read(made);
  EXPECT_EQ(file.mesh.materials[0].alphaMode, "OPAQUE");
  EXPECT_EQ(file.mesh.materials[0].baseColor, (std::array<double, 4>{1, 1, 1, 1}));
  EXPECT_TRUE(file.mesh.materials[0].textures.empty());
  EXPECT_EQ(file.mesh.materials[1], Material{});
  const std::string warnings = joined(file.warnings);
  for (const char* said :
       {"material \"bad?\" has a damaged \"doubleSided\"", "\"alphaMode\"", "\"baseColorFactor\"",
        "material \"bad?\" is without its texture \"baseColor\": names element 99",
        "\"metallicRoughness\": its picture is a data URI that is not of base 64", "more problems"})
    EXPECT_TRUE(contains(warnings, said)) << said << '\n' << warnings;
  // Lists that are none, and a material that does not exist.
  for (const char* list : {"materials", "textures", "images", "samplers"})
    for (const Json& bad : {Json(1), Json("x"), Json::object(), Json::array({1})}) {
      Assembled worse = made;
      worse.json[list] = bad;
      EXPECT_EQ(read(worse).mesh.triangles.size(), 1u);
    }
  made.primitive()["material"] = 5;
  EXPECT_TRUE(
      contains(joined(read(made).warnings), "1 material that is named and does not exist is left out"));
}

/// Two triangles that share an edge, each of a material of its own with one texture; its transform is that
/// JSON, or none.
Assembled twoMaterials(const std::vector<std::string>& transforms) {
  Assembled made;
  made.attributes()["POSITION"] = made.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  made.attributes()["TEXCOORD_0"] = made.add<float>({0, 0, 1, 0, 0, 1, 1, 1}, "VEC2");
  made.primitive()["indices"] = made.add<std::uint8_t>({0, 1, 2}, "SCALAR");
  made.json["meshes"][0]["primitives"].push_back(made.primitive());
  made.primitive(1)["indices"] = made.add<std::uint8_t>({2, 1, 3}, "SCALAR");
  made.json["images"] = {{{"uri", "a.png"}}};
  made.json["textures"] = {{{"source", 0}}};
  made.json["materials"] = Json::array();
  for (std::size_t m = 0; m < transforms.size(); ++m) {
    Json use = {{"index", 0}};
    if (!transforms[m].empty()) use["extensions"]["KHR_texture_transform"] = Json::parse(transforms[m]);
    made.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", use}}}});
    made.primitive(m)["material"] = m;
  }
  return made;
}

std::vector<double> allNumbers(const Attribute& attribute) {
  std::vector<double> all;
  for (std::size_t i = 0; i < attribute.elementCount(); ++i)
    for (const double number : attribute.numbers(i)) all.push_back(number);
  return all;
}

TEST_F(GltfMaterial, LosesItsTextureTransformToTheCoordinatesForOtherFormats) {
  // Scale, then turn a quarter, then move; the sense of the turn is that of the sample TextureTransformTest.
  const std::string transform = R"({"offset": [10, 20], "scale": [2, 4], "rotation": 1.5707963267948966})";
  SurfaceMesh mesh = read(twoMaterials({transform, transform})).mesh;
  EXPECT_TRUE(applyTextureTransforms(mesh).empty());
  ASSERT_TRUE(mesh.validate());
  EXPECT_FALSE(mesh.hasWedges());
  const std::vector<double> expected = {10, 20, 10, 18, 14, 20, 14, 18},
                            numbers = allNumbers(mesh.vertexAttributes[0]);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(numbers[i], expected[i], 1e-6) << i;
  EXPECT_TRUE(mesh.materials[0].verbatim.empty());
  const SurfaceMesh once = mesh;
  EXPECT_TRUE(applyTextureTransforms(mesh).empty());
  EXPECT_EQ(mesh, once);
}

TEST_F(GltfMaterial, SplitsWedgesWhereTextureTransformsDiffer) {
  SurfaceMesh mesh = read(twoMaterials({R"({"offset": [0.5, 0]})", ""})).mesh;
  EXPECT_TRUE(applyTextureTransforms(mesh).empty());
  ASSERT_TRUE(mesh.validate());
  ASSERT_TRUE(mesh.hasWedges());
  const auto at = [&](std::size_t t, std::size_t k) {
    return mesh.wedgeAttributes[0].numbers(mesh.wedges[t][k]);
  };
  EXPECT_EQ(at(0, 0), (std::vector<double>{0.5, 0}));
  EXPECT_EQ(at(0, 1), (std::vector<double>{1.5, 0}));
  EXPECT_EQ(at(0, 2), (std::vector<double>{0.5, 1}));
  EXPECT_EQ(at(1, 0), (std::vector<double>{0, 1}));
  EXPECT_EQ(at(1, 1), (std::vector<double>{1, 0}));
  EXPECT_EQ(at(1, 2), (std::vector<double>{1, 1}));
}

TEST_F(GltfMaterial, HasOneTextureTransformForEachSetOfCoordinates) {
  Assembled made = twoMaterials({R"({"offset": [1, 0], "texCoord": 1})", ""});
  const std::size_t second = made.add<std::uint8_t>({0, 0, 255, 0, 0, 255, 255, 255}, "VEC2", true);
  for (std::size_t p = 0; p < 2; ++p) made.attributes(p)["TEXCOORD_1"] = second;
  made.primitive(1)["material"] = 0;
  made.json["materials"][0]["normalTexture"] = {{"index", 0}, {"texCoord", 1}};
  SurfaceMesh mesh = read(made).mesh;
  const std::vector<std::string> lost = applyTextureTransforms(mesh);
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_TRUE(contains(lost[0], "those of \"normal\" lose theirs")) << lost[0];
  EXPECT_EQ(mesh.materials[0].textures[0].textureCoords, 1u);
  EXPECT_EQ(allNumbers(mesh.vertexAttributes[0]), (std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1}));
  EXPECT_EQ(allNumbers(mesh.vertexAttributes[1]), (std::vector<double>{1, 0, 2, 0, 1, 1, 2, 1}));
  EXPECT_EQ(mesh.vertexAttributes[1].type, ScalarType::float32);
}

}  // namespace
}  // namespace arete
