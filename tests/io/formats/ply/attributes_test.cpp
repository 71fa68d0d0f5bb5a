// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a PLY says beside positions and triangles, as the programs write it that made the files named at each
// test.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "io/formats/ply/ply.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

using PlyAttributes = MeshFileTest;
using Numbers = std::vector<double>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const std::string kStart = "ply\nformat ascii 1.0\n",
                  kXyz = "property float x\nproperty float y\nproperty float z\n",
                  kIndices = "property list uchar int vertex_indices\n";

const Attribute* find(const std::vector<Attribute>& attributes, std::string_view name) {
  const auto found = std::ranges::find(attributes, name, &Attribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

Numbers numbersOf(const Attribute& attribute) {
  Numbers numbers;
  for (std::size_t i = 0; i < attribute.elementCount(); ++i)
    for (const double number : attribute.numbers(i)) numbers.push_back(number);
  return numbers;
}

std::vector<std::string> namesOf(const std::vector<Attribute>& attributes) {
  std::vector<std::string> names;
  for (const Attribute& attribute : attributes) names.push_back(attribute.name);
  return names;
}

class PlyReadText : public PlyAttributes {
 protected:
  MeshFile read(const std::string& text) const {
    Result<MeshFile> file = readPly(put("a.ply", text));
    if (!file) {
      ADD_FAILURE() << text << file.error().describe();
      return {};
    }
    const Status valid = file->mesh.validate();
    EXPECT_TRUE(valid) << text << valid.error().message;
    return std::move(*file);
  }
};

TEST_F(PlyReadText, HasEveryPropertyOfVerticesInItsType) {
  // Blender writes custom attributes as floats of their names, CloudCompare scalar_ and a name.
  const MeshFile file = read(
      kStart + "element vertex 3\n" + kXyz +
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nproperty uchar alpha\nproperty double s\nproperty double t\n"
      "property float quality\nproperty short label\nproperty uint flags\nproperty double scalar_depth\n"
      "element face 1\n" +
      kIndices +
      "end_header\n"
      "0 0 0 0 0 1 1 2 3 4 0.1 0.2 0.1 -7 4294967295 0.1\n"
      "1 0 0 0 1 0 5 6 7 8 0.3 0.4 1e-45 32767 0 1e300\n"
      "0 1 0 1 0 0 255 0 0 255 1 0 nan -32768 1 -0\n3 0 1 2\n");
  const auto& vertices = file.mesh.vertexAttributes;
  ASSERT_EQ(namesOf(vertices), (std::vector<std::string>{"normal", "color", "texcoord", "quality", "label",
                                                         "flags", "scalar_depth"}));
  EXPECT_EQ(vertices[0].meaning, AttributeMeaning::normal);
  EXPECT_EQ(numbersOf(vertices[0]), (Numbers{0, 0, 1, 0, 1, 0, 1, 0, 0}));
  EXPECT_EQ(vertices[1].meaning, AttributeMeaning::color);
  EXPECT_EQ(vertices[1].colorSpace, ColorSpace::srgb);
  EXPECT_EQ(vertices[1].type, ScalarType::uint8);
  EXPECT_TRUE(vertices[1].isNormalized);
  EXPECT_EQ(numbersOf(vertices[1]), (Numbers{1, 2, 3, 4, 5, 6, 7, 8, 255, 0, 0, 255}));
  EXPECT_EQ(vertices[2].meaning, AttributeMeaning::textureCoords);
  EXPECT_FALSE(vertices[2].isFromTop);
  EXPECT_EQ(numbersOf(vertices[2]), (Numbers{0.1, 0.2, 0.3, 0.4, 1, 0}));
  EXPECT_EQ(vertices[3].type, ScalarType::float32);
  EXPECT_EQ(vertices[3].numbers(0), Numbers{double(0.1f)});
  EXPECT_EQ(vertices[3].numbers(1), Numbers{double(std::numeric_limits<float>::denorm_min())});
  EXPECT_EQ(vertices[4].type, ScalarType::int16);
  EXPECT_EQ(numbersOf(vertices[4]), (Numbers{-7, 32767, -32768}));
  EXPECT_EQ(numbersOf(vertices[5]), (Numbers{4294967295, 0, 1}));
  EXPECT_EQ(numbersOf(vertices[6]), (Numbers{0.1, 1e300, -0.0}));
  EXPECT_TRUE(file.warnings.empty());
}

TEST_F(PlyReadText, KnowsTheNamesThatProgramsHaveForOneThing) {
  struct Case {
    std::string properties;  // each "type name"
    std::vector<std::string> names;
  };
  for (const Case& one : {
           Case{"float u,float v", {"texcoord"}},
           Case{"float texture_u,float texture_v", {"texcoord"}},
           Case{"uchar diffuse_red,uchar diffuse_green,uchar diffuse_blue", {"color"}},
           Case{"float r,float g,float b", {"color"}},
           Case{"uchar Red,uchar Green,uchar Blue", {"color"}},
           // an alpha of another type, or without a colour
           Case{"uchar red,uchar green,uchar blue,float alpha", {"color", "alpha"}},
           Case{"uchar alpha,float s", {"alpha", "s"}},
           // numbers that mean something else
           Case{"float u,float v,float w", {"u", "v", "w"}},
           Case{"int red,int green,int blue", {"red", "green", "blue"}},
           Case{"float nx,double ny,float nz", {"nx", "ny", "nz"}},
           Case{"float f_rest_0,float f_rest_1", {"f_rest_0", "f_rest_1"}},
           // both, and twice the same
           Case{"float s,float t,float u,float v", {"texcoord", "texcoord1"}},
           Case{"uchar red,uchar green,uchar blue,uchar diffuse_red,uchar diffuse_green,uchar diffuse_blue",
                {"color", "color1"}},
           Case{"int a,int a,int a", {"a", "a_2", "a_3"}},
       }) {
    std::string header = kStart + "element vertex 3\n" + kXyz, values;
    for (std::size_t at = 0; at < one.properties.size();) {
      const std::size_t end = std::min(one.properties.find(',', at), one.properties.size());
      header += "property " + one.properties.substr(at, end - at) + "\n";
      values += " 1";
      at = end + 1;
    }
    const MeshFile file = read(header + "element face 1\n" + kIndices + "end_header\n0 0 0" + values +
                               "\n1 0 0" + values + "\n0 1 0" + values + "\n3 0 1 2\n");
    EXPECT_EQ(namesOf(file.mesh.vertexAttributes), one.names) << one.properties;
  }
}

TEST_F(PlyReadText, HasThePropertiesOfFacesForTheirTriangles) {
  const MeshFile file =
      read(kStart + "element vertex 5\n" + kXyz + "element face 3\nproperty ushort label\n" + kIndices +
           "property uchar red\nproperty uchar green\nproperty uchar blue\n"
           "property list uchar float weights\nproperty list uchar int near\n"
           "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 2 0\n"
           "7 4 0 1 2 3 1 2 3 2 0.5 0.25 0\n"
           "8 2 0 1 4 5 6 2 1 2 1 5\n"
           "9 3 1 4 2 7 8 9 2 3 4 2 5 6\n");
  EXPECT_EQ(file.mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}}));
  EXPECT_EQ(file.mesh.faceOf, (std::vector<std::uint32_t>{0, 0, 2}));
  const auto& faces = file.mesh.triangleAttributes;
  ASSERT_EQ(namesOf(faces), (std::vector<std::string>{"label", "color", "weights"}));
  EXPECT_EQ(numbersOf(faces[0]), (Numbers{7, 7, 9}));
  EXPECT_EQ(numbersOf(faces[1]), (Numbers{1, 2, 3, 1, 2, 3, 7, 8, 9}));
  EXPECT_EQ(faces[2].components, 2);
  EXPECT_EQ(numbersOf(faces[2]), (Numbers{0.5, 0.25, 0.5, 0.25, 3, 4}));
  ASSERT_EQ(file.warnings.size(), 2u);
  EXPECT_NE(file.warnings[0].sentence.find("1 face of fewer than three corners"), std::string::npos);
  EXPECT_NE(file.warnings[1].sentence.find("\"near\""), std::string::npos);
}

TEST_F(PlyReadText, HasTextureCoordinatesOfCornersAndAMaterialForEachPicture) {
  // MeshLab: two triangles at a seam; the list before the indices, as some scanners have it; blanks and
  // digits in the names of pictures, which have broken other readers.
  for (const bool isListFirst : {false, true}) {
    const auto face = [&](const std::string& indices, const std::string& list, const std::string& number) {
      return (isListFirst ? list + " " + indices : indices + " " + list) + " " + number + "\n";
    };
    const std::string texcoord = "property list uchar float texcoord\n";
    const MeshFile file = read(
        kStart + "comment VCGLIB generated\ncomment TextureFile 512.png\n" +
        "comment TEXTUREFILE maps\\the skin.of it.jpg\nelement vertex 4\n" + kXyz + "element face 3\n" +
        (isListFirst ? texcoord + kIndices : kIndices + texcoord) + "property int texnumber\nend_header\n" +
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + face("3 0 1 2", "6 0 0 1 0 1 1", "1") +
        face("3 0 2 3", "6 0.5 0 1 1 0 1", "0") + face("3 0 2 1", "6 0 0 1 1 1 0", "-1"));
    const SurfaceMesh& mesh = file.mesh;
    ASSERT_EQ(namesOf(mesh.wedgeAttributes), std::vector<std::string>{"texcoord"});
    EXPECT_EQ(mesh.wedgeAttributes[0].meaning, AttributeMeaning::textureCoords);
    // The corners of the third face are wedges of the first.
    EXPECT_EQ(mesh.wedges, (Triangles{{0, 1, 2}, {3, 2, 4}, {0, 2, 1}}));
    EXPECT_EQ(numbersOf(mesh.wedgeAttributes[0]), (Numbers{0, 0, 1, 0, 1, 1, 0.5, 0, 0, 1}));
    ASSERT_EQ(mesh.materials.size(), 2u);
    EXPECT_EQ(mesh.materials[0].name, "512");
    EXPECT_EQ(mesh.materials[1].name, "the skin.of it");
    EXPECT_EQ(mesh.materials[1].textures,
              (std::vector<TextureUse>{{"baseColor", "maps\\the skin.of it.jpg"}}));
    EXPECT_EQ(mesh.materialOf, (std::vector<std::uint32_t>{1, 0, MeshAttributes::kNone}));
    EXPECT_EQ(file.folder, folder_);
    EXPECT_TRUE(file.warnings.empty());
  }
}

TEST_F(PlyReadText, GivesAllFacesTheFirstPictureWithoutATexnumber) {
  const MeshFile file = read(kStart + "comment TextureFile a.png\nelement vertex 3\n" + kXyz +
                             "property float texture_u\nproperty float texture_v\nelement face 1\n" +
                             kIndices + "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
  EXPECT_EQ(file.mesh.materialOf, std::vector<std::uint32_t>{0});
  // Without a picture it is a number like any other.
  const MeshFile bare = read(kStart + "element vertex 3\n" + kXyz + "element face 1\n" + kIndices +
                             "property int texnumber\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 5\n");
  EXPECT_TRUE(bare.mesh.materials.empty());
  EXPECT_EQ(namesOf(bare.mesh.triangleAttributes), std::vector<std::string>{"texnumber"});
}

TEST_F(PlyReadText, TurnsTextureCoordinatesOfPolygonsWithTheirCorners) {
  // A quad whose reflex corner makes the other diagonal the right one.
  const MeshFile file = read(kStart + "element vertex 4\n" + kXyz + "element face 1\n" + kIndices +
                             "property list uchar float texcoord\nproperty list uchar float color\n"
                             "end_header\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n"
                             "4 0 1 2 3 8 0 0 4 0 1 1 0 4 12 0 0 0 1 0 0 0 1 0 0 0 1\n");
  ASSERT_EQ(file.mesh.triangles.size(), 2u);
  ASSERT_EQ(namesOf(file.mesh.wedgeAttributes), (std::vector<std::string>{"texcoord", "color"}));
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 at = file.mesh.positions[file.mesh.triangles[t][c]];
      EXPECT_EQ(file.mesh.wedgeAttributes[0].numbers(file.mesh.wedges[t][c]), (Numbers{at.x, at.y}));
    }
  EXPECT_EQ(file.mesh.wedgeAttributes[1].components, 3);
  EXPECT_EQ(file.mesh.wedgeAttributes[1].meaning, AttributeMeaning::color);
}

TEST_F(PlyReadText, ReadsNoListBeyondTheCornersOfItsFace) {
  // A list of another length than the corners made another reader run over: one vertex and six numbers, three
  // and two, none at all.
  const std::string head = kStart + "element vertex 3\n" + kXyz + "element face 3\n" + kIndices +
                           "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  const MeshFile file = read(head + "1 0 6 1 2 3 4 5 6\n3 0 1 2 0\n3 0 1 2 6 1 2 3 4 5 6\n");
  EXPECT_EQ(file.mesh.triangles.size(), 2u);
  ASSERT_EQ(file.mesh.wedgeAttributes.size(), 1u);
  EXPECT_EQ(numbersOf(file.mesh.wedgeAttributes[0]), (Numbers{0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(file.warnings.size(), 2u);
  // Lists that fit nowhere.
  const MeshFile none = read(head + "3 0 1 2 2 1 2\n3 0 1 2 1 1\n3 0 1 2 0\n");
  EXPECT_FALSE(none.mesh.hasWedges());
  ASSERT_EQ(none.warnings.size(), 1u);
  EXPECT_NE(none.warnings[0].sentence.find("\"texcoord\""), std::string::npos);
  // All empty: an exporter that always states the property.
  EXPECT_TRUE(read(head + "3 0 1 2 0\n3 0 1 2 0\n3 0 1 2 0\n").warnings.empty());
}

TEST_F(PlyReadText, BoundsWhatMissingListsTake) {
  // One list of 255 doubles for each corner, and many faces without.
  std::string text = kStart + "element vertex 3\n" + kXyz + "element face 2001\n" + kIndices +
                     "property list ushort double corner_big\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 765";
  for (int i = 0; i < 765; ++i) text += " 1";
  for (int i = 0; i < 2000; ++i) text += "\n3 0 1 2 0";
  const MeshFile file = read(text);
  EXPECT_TRUE(file.mesh.wedgeAttributes.empty());
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].sentence.find("\"big\""), std::string::npos);
}

TEST_F(PlyReadText, ReadsTriangleStrips) {
  // Stanford's, with -1 between the strips; every second triangle is turned, and one that only leads on is
  // none.
  const std::string head = kStart + "element vertex 6\n" + kXyz +
                           "element tristrips 1\nproperty list int int " +
                           "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n";
  EXPECT_EQ(read(head + "10 0 1 2 3 -1 2 3 4 5 -1\n").mesh.triangles,
            (Triangles{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}}));
  EXPECT_EQ(read(head + "8 0 1 2 2 4 3 5 -1\n").mesh.triangles, (Triangles{{0, 1, 2}, {4, 2, 3}, {4, 3, 5}}));
  EXPECT_EQ(read(head + "3 0 1 -1\n").mesh.triangles, Triangles{});
  EXPECT_NE(refusal("a.ply", head + "3 0 1 6\n").message.find("names vertex 6 of 6"), std::string::npos);
  // With faces as well: attributes of these would lack values.
  const MeshFile both = read(
      kStart + "comment TextureFile a.png\nelement vertex 4\n" + kXyz + "element face 1\n" + kIndices +
      "property int label\nproperty list uchar float texcoord\nproperty float error\nelement tristrips 1\n"
      "property list uchar ushort vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n"
      "3 0 1 2 7 6 0 0 1 0 0 1 0.5\n4 0 1 65535 3\n");
  EXPECT_EQ(both.mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_TRUE(both.mesh.triangleAttributes.empty() && both.triangleErrors.empty());
  EXPECT_EQ(both.mesh.materialOf, std::vector<std::uint32_t>{0});
  EXPECT_EQ(both.warnings.size(), 1u);
}

TEST_F(PlyReadText, HasNoAttributesOfTrianglesThatAreNone) {
  // An outline there and back encloses nothing.
  const MeshFile file =
      read(kStart + "comment TextureFile a.png\nelement vertex 2\n" + kXyz + "element face 1\n" + kIndices +
           "property int label\nproperty list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n" +
           "4 0 1 0 1 7 8 0 0 1 0 0 0 1 0\n");
  EXPECT_TRUE(file.mesh.triangles.empty() && file.mesh.materialOf.empty());
}

TEST_F(PlyReadText, NamesTheElementsThatItLeavesOut) {
  const MeshFile file = read(kStart + "obj_info num_cols 512\nelement vertex 3\n" + kXyz +
                             "element face 1\n" + kIndices + "element edge 1\nproperty int vertex1\n" +
                             "property int vertex2\nelement camera 1\nproperty float view_px\n" +
                             "element multi_patch 0\nproperty int a\nend_header\n" +
                             "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n0 1\n0.5\n");
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0].sentence, "its elements \"edge\" (1), \"camera\" (1) are left out");
}

TEST_F(PlyReadText, SaysWhenNumbersDoNotFitTheirTypes) {
  const MeshFile file =
      read(kStart + "element vertex 3\n" + kXyz + "property uchar a\nproperty char b\nelement face 1\n" +
           kIndices + "end_header\n0 0 0 300 -200\n1 0 0 0.6 1\n0 1 0 255 1\n3 0 1 2\n");
  EXPECT_EQ(numbersOf(file.mesh.vertexAttributes[0]), (Numbers{255, 1, 255}));
  EXPECT_EQ(numbersOf(file.mesh.vertexAttributes[1]), (Numbers{-128, 1, 1}));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(file.warnings[0].sentence.starts_with("3 numbers")) << file.warnings[0].sentence;
}

TEST_F(PlyReadText, KeepsErrorsOfFacesThatAreNone) {
  const std::string head = kStart + "element vertex 3\n" + kXyz + "element face 2\n" + kIndices +
                           "property float error\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 ";
  const MeshFile good = read(head + "0.5\n3 0 2 1 0\n"), bad = read(head + "-0.5\n3 0 2 1 nan\n");
  EXPECT_EQ(good.triangleErrors, (std::vector<float>{0.5f, 0}));
  EXPECT_TRUE(good.mesh.triangleAttributes.empty() && bad.triangleErrors.empty());
  ASSERT_NE(find(bad.mesh.triangleAttributes, "error"), nullptr);
  EXPECT_EQ(bad.mesh.triangleAttributes[0].numbers(0), Numbers{-0.5});
}

}  // namespace
}  // namespace arete
