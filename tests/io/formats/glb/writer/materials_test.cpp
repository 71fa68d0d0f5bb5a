// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/written_glb.h"

namespace arete {
namespace {

using namespace test;

Material material(const char* name) {
  Material m;
  m.name = name;
  return m;
}

TEST(GlbWriteMaterials, WritesAMaterialOfGltfAsItWas) {
  SurfaceMesh mesh = square();
  Material m = material("glass");
  m.baseColor = {0.1, 0.2, 0.3, 0.4};
  m.isDoubleSided = true;
  m.alphaMode = "MASK";
  m.alphaCutoff = 0.25;
  m.verbatim["gltf"] =
      R"({"emissiveFactor":[1,0.5,0],"extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0.7,"strayTexture":{"index":7}},"bad":5},)"
      R"("extras":{"a":[1]},"pbrMetallicRoughness":{"roughnessFactor":0.3}})";
  m.textures = {{"baseColor", "#0", 0},
                {"extensions/KHR_materials_clearcoat/clearcoatTexture", "#0", 1},
                {"occlusion", "#1", 0},
                {"strange", "#1", 0}};
  m.verbatim["gltf:baseColor"] =
      R"({"sampler":{"wrapS":33071},"extensions":{"KHR_texture_transform":{"scale":[2,2]}}})";
  m.verbatim["gltf:occlusion"] = R"({"strength":0.5})";
  mesh.materials = {m};
  mesh.materialOf = {0, 0};
  const auto picture = [](const char* name, std::string_view bytes) {
    EmbeddedPicture p{.name = name, .mimeType = "image/x", .bytes = {}};
    for (const char c : bytes) p.bytes.push_back(std::byte(c));
    return p;
  };
  mesh.pictures = {picture("a", "\x89PNG\r\n\x1A\n....."), picture("b", "RIFF....WEBPVP8")};
  for (const char* name : {"texcoord", "texcoord1"}) {
    mesh.vertexAttributes.push_back(
        attribute(name, AttributeMeaning::textureCoords, ScalarType::float32, 2, {0, 0, 1, 0, 0, 1, 1, 1}));
    mesh.vertexAttributes.back().isFromTop = true;
  }
  const Written written(mesh);
  const Json json = written.json["materials"][0];
  EXPECT_EQ(json, Json::parse(R"({"name":"glass","alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true,
    "emissiveFactor":[1,0.5,0],"extras":{"a":[1]},
    "extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0.7,"clearcoatTexture":{"index":1,"texCoord":1}}},
    "pbrMetallicRoughness":{"roughnessFactor":0.3,"baseColorFactor":[0.1,0.2,0.3,0.4],
      "baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}}},
    "occlusionTexture":{"index":2,"strength":0.5}})"));
  EXPECT_EQ(written.json["textures"], Json::parse(R"([{"sampler":0,"source":0},{"source":0},
    {"extensions":{"EXT_texture_webp":{"source":1}}}])"));
  EXPECT_EQ(written.json["samplers"], Json::parse(R"([{"wrapS":33071}])"));
  ASSERT_EQ(written.json["images"].size(), 2u);
  EXPECT_EQ(written.json["images"][0]["mimeType"], "image/png") << "by its bytes";
  EXPECT_EQ(written.bytesOfView(written.json["images"][0]["bufferView"]), "\x89PNG\r\n\x1A\n.....");
  EXPECT_EQ(written.json["extensionsRequired"], Json({"EXT_texture_webp"}));
  EXPECT_EQ(written.json["extensionsUsed"],
            Json({"EXT_texture_webp", "KHR_materials_clearcoat", "KHR_texture_transform"}));
  EXPECT_EQ(written.lost, (std::vector<std::string>{"textures of materials (strange)"}));
}

TEST(GlbWriteMaterials, WritesAMaterialOfAnMtlAsBlenderReadsIt) {
  SurfaceMesh mesh = square();
  mesh.materials = {material("plain"), material("shiny"), material("lamp")};
  mesh.materials[1].baseColor = {0.5, 0.5, 0.5, 0.25};
  mesh.materials[1].verbatim["mtl"] = "Ns 250\nKs 1 1 1\nillum 2\n";
  mesh.materials[2].verbatim["mtl"] = "Pm 0.75\nPr 0.5\nNs 10\nKe 4 2 0\n";
  mesh.materials[2].textures = {{"map_Kd", "nowhere.png", 0}, {"map_Ks", "x.png", 0}};
  mesh.materialOf = {1, 2};
  const Written written(mesh);
  EXPECT_EQ(written.json["materials"], Json::parse(R"([
    {"name":"plain","pbrMetallicRoughness":{"metallicFactor":0.0,"roughnessFactor":1.0}},
    {"name":"shiny","alphaMode":"BLEND",
     "pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,0.25],"metallicFactor":0.0,"roughnessFactor":0.5}},
    {"name":"lamp","emissiveFactor":[1.0,0.5,0.0],
     "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4.0}},
     "pbrMetallicRoughness":{"metallicFactor":0.75,"roughnessFactor":0.5}}])"));
  EXPECT_EQ(written.lost,
            (std::vector<std::string>{"statements of materials (Ks, illum)", "textures of materials (map_Ks)",
                                      "textures without texture coordinates (\"lamp\")"}));
}

TEST(GlbWriteMaterials, LeavesOutPicturesThatGltfCannotHaveAndNamesThem) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("a.tga")) << "no magic";
  SurfaceMesh mesh = square();
  mesh.vertexAttributes = {attribute("texcoord", AttributeMeaning::textureCoords, ScalarType::float32, 2,
                                     {0, 0, 1, 0, 0, 1, 1, 1})};
  mesh.materials = {material("m"), material("n")};
  mesh.materials[0].textures = {{"map_Kd", "a.tga", 0}};
  mesh.materials[1].textures = {{"map_Kd", "missing.png", 0}};
  const Written written(
      mesh, {.up = MeshUp::unknown, .pictureFolder = std::filesystem::path(folder.file("a")).parent_path()});
  EXPECT_EQ(written.json["materials"].size(), 2u);
  EXPECT_FALSE(written.json.contains("textures"));
  EXPECT_TRUE(written.hasLost("\"a.tga\""));
  EXPECT_TRUE(written.hasLost("\"missing.png\""));
}

}  // namespace
}  // namespace arete
