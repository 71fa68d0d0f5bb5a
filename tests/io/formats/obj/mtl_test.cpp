// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/obj/mtl.h"

#include <gtest/gtest.h>

#include "io/formats/obj/obj.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

Material only(const std::string& text) {
  MtlMaterials read = readMtl("newmtl a\n" + text);
  EXPECT_EQ(read.materials.size(), 1u);
  return read.materials.empty() ? Material() : read.materials[0];
}

std::string verbatim(const Material& material, const std::string& key) {
  const auto found = material.verbatim.find(key);
  return found == material.verbatim.end() ? "" : found->second;
}

TEST(Mtl, ReadsColoursAndAlpha) {
  struct Case {
    const char* text;
    std::array<double, 4> color;
    const char* alphaMode;
    const char* kept;
  };
  for (const Case& c :
       {Case{"Kd 0.1 0.2 0.3", {0.1, 0.2, 0.3, 1}, "OPAQUE", ""},
        Case{"  Kd\t0.5 # grey", {0.5, 0.5, 0.5, 1}, "OPAQUE", ""},
        Case{"Kd spectral a.rfl 1", {1, 1, 1, 1}, "OPAQUE", "Kd spectral a.rfl 1"},
        Case{"Kd xyz 1 2 3", {1, 1, 1, 1}, "OPAQUE", "Kd xyz 1 2 3"},
        Case{"d 0.25", {1, 1, 1, 0.25}, "BLEND", ""},
        Case{"d -halo 0.25", {1, 1, 1, 1}, "OPAQUE", "d -halo 0.25"},
        Case{"Tr 0.25", {1, 1, 1, 0.75}, "BLEND", ""},
        // tinyobjloader #43, three.js #12861, CloudCompare #1059: d counts, whatever Tr says.
        Case{"d 1.0\nTr 0.0", {1, 1, 1, 1}, "OPAQUE", ""}, Case{"Tr 1\nd 1", {1, 1, 1, 1}, "OPAQUE", "Tr 1"},
        Case{"Ka 1 1 1\nKs 0.5 0.5 0.5\r\nNs 96.078431\nillum 2\nPr 0.5",
             {1, 1, 1, 1},
             "OPAQUE",
             "Ka 1 1 1\nKs 0.5 0.5 0.5\nNs 96.078431\nillum 2\nPr 0.5"},
        Case{"map_Kd\nmap_Ke \nmap_aat on", {1, 1, 1, 1}, "OPAQUE", "map_aat on"},
        Case{"map_d a.png", {1, 1, 1, 1}, "BLEND", ""}}) {
    const Material material = only(c.text);
    EXPECT_EQ(material.baseColor, c.color) << c.text;
    EXPECT_EQ(material.alphaMode, c.alphaMode) << c.text;
    EXPECT_EQ(verbatim(material, "mtl"), c.kept) << c.text;
  }
}

TEST(Mtl, FindsThePictureAmongTheOptions) {
  struct Case {
    const char *statement, *role, *picture, *options;
  };
  for (const Case& c :
       {Case{"map_Kd wood.png", "baseColor", "wood.png", ""},
        // assimp #1161, MeshLab #66: names with blanks.
        Case{"map_Kd  oak wood 2.png ", "baseColor", "oak wood 2.png", ""},
        Case{"map_Kd \"oak wood.png\"", "baseColor", "oak wood.png", ""},
        Case{"map_Kd maps\\oak.png", "baseColor", "maps\\oak.png", ""},
        // tinyobjloader-c #71
        Case{"map_Kd -o 0.0 -7.0 0.0 -s 1.0 10.0 1.0 -clamp on BodyStripe.png", "baseColor", "BodyStripe.png",
             "-o 0.0 -7.0 0.0 -s 1.0 10.0 1.0 -clamp on"},
        // javagl/Obj #28
        Case{"map_Ks -s 2 3 4 where it starts.png", "map_Ks", "where it starts.png", "-s 2 3 4"},
        Case{"map_Ks -s 2 2.png", "map_Ks", "2.png", "-s 2"}, Case{"map_Ks -s 2 3", "map_Ks", "3", "-s 2"},
        // godot #110925; three.js #7943: behind the name.
        Case{"map_Bump -bm 1.000000 a_n.png", "map_Bump", "a_n.png", "-bm 1.000000"},
        Case{"bump Thing Norm.png -bm 1", "bump", "Thing Norm.png", "-bm 1"},
        Case{"bump -imfchan r a -b.png -mm 0 1 -texres 512", "bump", "a -b.png",
             "-imfchan r -mm 0 1 -texres 512"},
        Case{"norm n.png", "normal", "n.png", ""}, Case{"map_Kn n.png", "normal", "n.png", ""},
        Case{"map_Ke e.png", "emissive", "e.png", ""},
        Case{"disp -mm 0 0.5 d.png", "disp", "d.png", "-mm 0 0.5"},
        Case{"map_kd -blendu off -type sphere x.png", "baseColor", "x.png", "-blendu off -type sphere"}}) {
    const Material material = only(c.statement);
    ASSERT_EQ(material.textures.size(), 1u) << c.statement;
    EXPECT_EQ(material.textures[0].role, c.role) << c.statement;
    EXPECT_EQ(material.textures[0].picture, c.picture) << c.statement;
    EXPECT_EQ(verbatim(material, std::string("mtl:") + c.role), c.options) << c.statement;
    EXPECT_EQ(verbatim(material, "mtl"), "") << c.statement;
  }
}

TEST(Mtl, ManyStatementsTakeLinearTime) {
  std::string lines, names = "newmtl a\n", options = "bump a";
  for (int i = 0; i < 200'000; ++i) {
    lines += "refl a\n";
    names += "map_" + std::to_string(i) + " b\n";
    options += " -o 1";
  }
  const Material material = only(lines);
  EXPECT_EQ(material.textures.size(), 64u);
  EXPECT_EQ(verbatim(material, "mtl").size(), (200'000 - 64) * 7 - 1);
  EXPECT_EQ(readMtl(names).materials[0].textures.size(), 64u);
  EXPECT_EQ(only(options + " x").textures.size(), 1u);
}

TEST(Mtl, NamesAreTheRestOfTheLineWithoutBlanksAtTheEnds) {
  // tinyobjloader #356, javagl/Obj #5, fast_obj #43
  const MtlMaterials read = readMtl(
      "Kd 0 0 0\n  newmtl   Minecraft dirt_49 \t\r\n Kd 1 0 0\nnewmtl b\nnewmtl b\nKd 0 1 0\nnewmtl c");
  ASSERT_EQ(read.materials.size(), 3u);
  EXPECT_EQ(read.materials[0].name, "Minecraft dirt_49");
  EXPECT_EQ(read.materials[0].baseColor[1], 0);
  EXPECT_EQ(read.materials[1].baseColor[1], 1);  // of two of one name the first
  EXPECT_EQ(read.warnings.size(), 2u);
}

TEST(Mtl, TwoStatementsOfOneTextureAreOneAndComeBackAsTwo) {
  const Material material =
      only("norm n.png\nmap_Bump n.png\nmap_Pr -imfchan g m.png\nmap_Pm -imfchan b m.png\n");
  ASSERT_EQ(material.textures.size(), 2u);
  EXPECT_EQ(material.textures[0].role, "normal");
  EXPECT_EQ(material.textures[1].role, "metallicRoughness");
  const auto same = [](const std::string& picture) -> Result<std::string> { return picture; };
  const std::vector<Material> materials = {material};
  const Result<MtlText> text = mtlText(materials, mtlNames(materials), same);
  ASSERT_TRUE(text);
  EXPECT_TRUE(text->lost.empty());
  EXPECT_EQ(
      text->text,
      "\nnewmtl a\nKd 1 1 1\nnorm n.png\nmap_Bump n.png\nmap_Pr -imfchan g m.png\nmap_Pm -imfchan b m.png\n");
  EXPECT_EQ(readMtl(text->text).materials, materials);
  EXPECT_EQ(only("norm n.png\nbump other.png\nmap_Pr m.png\nmap_Pm m.png").textures.size(), 4u);
}

TEST(Mtl, WhatIsReadIsWrittenAgain) {
  const std::string text =
      "newmtl a b\nKd 0.8 0.7 0.1\nd 0.5\nKa 0 0 0\nNs 10\nmap_Kd -s 2 2 2 oak wood.png\nmap_Bump -bm 0.5 "
      "b.png\n"
      "refl -type cube_top t.png\nrefl -type cube_left l.png\n\nnewmtl c\nKd 1 1 1\nTf xyz 1 1 1\nKe 1 0 0\n";
  const std::vector<Material> materials = readMtl(text).materials;
  const Result<MtlText> written =
      mtlText(materials, mtlNames(materials), [](const std::string& p) -> Result<std::string> { return p; });
  ASSERT_TRUE(written);
  EXPECT_EQ(written->text, "\n" + text);
  EXPECT_TRUE(written->lost.empty());
}

TEST(Mtl, MaterialsOfGltfBecomeWhatMtlKnows) {
  Material material{
      .name = "m", .baseColor = {0.1, 0.2, 0.3, 0.5}, .isDoubleSided = true, .alphaMode = "MASK"};
  material.textures = {{"baseColor", "b.png"}, {"occlusion", "o.png"}, {"emissive", "#0", 1}};
  material.verbatim["gltf"] =
      R"({"pbrMetallicRoughness":{"metallicFactor":0.25,"roughnessFactor":0.5},"emissiveFactor":[1,0.5,0],)"
      R"("extensions":{"KHR_materials_ior":{}}})";
  material.verbatim["gltf:baseColor"] = R"({"sampler":{"wrapS":33071}})";
  const std::vector<Material> materials = {material, material, {.name = ""}};
  const std::vector<std::string> names = mtlNames(materials);
  EXPECT_EQ(names, (std::vector<std::string>{"m", "m-1", "material"}));
  const Result<MtlText> written = mtlText(materials, names, [](const std::string& p) -> Result<std::string> {
    return p == "#0" ? std::string("e.png") : p;
  });
  ASSERT_TRUE(written);
  EXPECT_TRUE(written->text.starts_with("\nnewmtl m\nKd 0.1 0.2 0.3\nd 0.5\nKe 1 0.5 0\nPm 0.25\nPr 0.5\n") ||
              written->text.starts_with("\nnewmtl m\nKd 0.1 0.2 0.3\nd 0.5\nPm 0.25\nPr 0.5\nKe 1 0.5 0\n"))
      << written->text;
  EXPECT_NE(written->text.find("map_Kd b.png\nmap_Ke e.png\n"), std::string::npos) << written->text;
  std::string lost;
  for (const std::string& text : written->lost) lost += text + "\n";
  for (const char* what : {"alpha mode MASK", "double sides", "occlusion textures", "extensions",
                           "which texture coordinates", "samplers and transforms", "(\"m\")"})
    EXPECT_NE(lost.find(what), std::string::npos) << what << "\n" << lost;
}

class MtlFiles : public MeshFileTest {
 protected:
  void SetUp() override {
    MeshFileTest::SetUp();
    fs::create_directories(folder_ / "sub dir");
    put("one.mtl", "newmtl red\nKd 1 0 0\nmap_Kd red.png\n");
    put("two three.mtl", "newmtl green\nKd 0 1 0\nnewmtl red\nKd 0 0 1\n");
    put("sub dir/Four.MTL", "newmtl blue\nmap_Kd blue.png\nmap_Ks top.png\nmap_Ke none.png\n");
    put("sub dir/blue.png", "x");
    put("top.png", "x");
  }
  MeshFile read(const std::string& head) const {
    Result<MeshFile> file =
        readObj(put("a.obj", head + "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl  "
                                    "green \nf 1 2 3\nusemtl\nf 1 2 3\nusemtl red\nf 1 3 2\n"));
    EXPECT_TRUE(file) << file.error().describe();
    return file ? std::move(*file) : MeshFile();
  }
  static std::vector<std::string> names(const MeshFile& file) {
    std::vector<std::string> names;
    for (const Material& material : file.mesh.materials) names.push_back(material.name);
    return names;
  }
};

TEST_F(MtlFiles, AreFoundByOneNameOrSeveralWithBlanksOrWithout) {
  // tinyobjloader #49, #112, #355; vengi #203; obj2gltf #110; tinyobjloader-c #70 (blanks behind the name);
  // tinyobjloader #327 (one library 181 times)
  for (const char* lines :
       {"mtllib one.mtl two three.mtl\n", "mtllib one.mtl \r\nmtllib two three.mtl\t\r\n",
        "mtllib \"one.mtl\"\nmtllib \"two three.mtl\"\n", "mtllib ./ONE.mtl two three.mtl\n",
        "mtllib C:\\x\\one.mtl\nmtllib two three.mtl\nmtllib one.mtl\nmtllib ./one.mtl\n"}) {
    const MeshFile file = read(lines);
    EXPECT_EQ(names(file), (std::vector<std::string>{"red", "green"})) << lines;
    EXPECT_EQ(file.mesh.materialOf, (std::vector<std::uint32_t>{0, 1, MeshAttributes::kNone, 0}));
    EXPECT_EQ(file.mesh.materials[0].baseColor[0], 1);  // the library that is named first
    EXPECT_EQ(file.mesh.materials[0].baseColor[2], 0);
    EXPECT_TRUE(file.warnings.empty()) << lines << file.warnings[0].sentence;
  }
}

TEST_F(MtlFiles, NamePicturesRelativeToThemselvesOrToTheObj) {
  const MeshFile file = read("mtllib sub dir/four.mtl one.mtl\n");
  EXPECT_EQ(names(file), (std::vector<std::string>{"blue", "red", "green"}));
  std::vector<std::string> pictures;
  for (const TextureUse& use : file.mesh.materials[0].textures) pictures.push_back(use.picture);
  EXPECT_EQ(pictures, (std::vector<std::string>{"sub dir/blue.png", "top.png", "sub dir/none.png"}));
}

TEST_F(MtlFiles, ThatAreMissingLeaveTheNamesOfTheirMaterials) {
  const MeshFile file = read("mtllib none.mtl\nmtllib ../out.mtl http://host/a.mtl\n");
  EXPECT_EQ(names(file), (std::vector<std::string>{"red", "green"}));
  EXPECT_EQ(file.mesh.materials[0], Material{.name = "red"});
  ASSERT_EQ(file.warnings.size(), 3u);
  EXPECT_EQ(file.warnings[0].sentence, "its materials are in \"none.mtl\", which does not exist");
  const MeshFile other = read("mtllib sub dir/four.mtl\n");
  EXPECT_EQ(names(other), (std::vector<std::string>{"blue", "red", "green"}));
  ASSERT_EQ(other.warnings.size(), 1u);
  EXPECT_EQ(other.warnings[0].sentence, "2 of its materials are in no library (the first is \"red\")");
}

TEST_F(MtlFiles, MayBeUtf16) {
  std::string wide = "\xFF\xFE";
  for (const char c : std::string("newmtl red\r\nKd 0.5 0 0\r\n")) wide += {c, '\0'};
  put("wide.mtl", wide);
  EXPECT_EQ(read("mtllib wide.mtl\n").mesh.materials[0].baseColor[0], 0.5);
}

TEST_F(MtlFiles, AThousandMissingOnesAreAFewSentences) {
  std::string lines;
  for (int i = 0; i < 1000; ++i) lines += "mtllib no" + std::to_string(i) + " a b c.mtl\n";
  EXPECT_LT(read(lines).warnings.size(), 12u);
}

}  // namespace
}  // namespace arete
