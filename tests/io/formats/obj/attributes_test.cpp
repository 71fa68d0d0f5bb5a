// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an OBJ says of its corners, faces and names. Most cases are what other programs got wrong; their issue
// is named.
#include <gtest/gtest.h>

#include <cstring>

#include "io/formats/obj/obj.h"
#include "io/mesh_file_fixture.h"
#include "surface/model/labels.h"

namespace arete {
namespace {

using namespace test;

constexpr std::uint32_t kNoObject = MeshAttributes::kNone;
const std::string kFour = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

class ObjAttributes : public MeshFileTest {
 protected:
  MeshFile read(const std::string& text) const {
    Result<MeshFile> file = readObj(put("a.obj", text));
    EXPECT_TRUE(file) << file.error().describe();
    if (!file) return {};
    EXPECT_TRUE(file->mesh.validate());
    return std::move(*file);
  }

  static const Attribute* named(const std::vector<Attribute>& attributes, std::string_view name) {
    for (const Attribute& attribute : attributes)
      if (attribute.name == name) return &attribute;
    return nullptr;
  }

  /// The numbers of a wedge attribute at a corner.
  static std::vector<double> at(const SurfaceMesh& mesh, std::string_view name, std::size_t triangle,
                                int corner) {
    const Attribute* attribute = named(mesh.wedgeAttributes, name);
    return attribute ? attribute->numbers(mesh.wedges[triangle][std::size_t(corner)]) : std::vector<double>{};
  }
};

using Numbers = std::vector<double>;

TEST_F(ObjAttributes, CornersHaveTextureCoordinatesAndNormalsByAnyIndex) {
  const std::string values = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0.25 0.5\nvn 0 0 1\nvn 0 1 0\n";
  for (const char* face : {"f 1/1/1 2/2/1 3/3/1 4/4/2\n", "f -4/-4/-2 -3/-3/-2 -2/-2/-2 -1/-1/-1\n",
                           "f 1/1/1 2/2/1 \\\n 3/3/1 4/4/2 # a comment\n", "fo 1/1/1 2/2/1 3/3/1 4/4/2\n"}) {
    const SurfaceMesh mesh = read(kFour + values + face).mesh;
    ASSERT_EQ(mesh.triangles.size(), 2u) << face;
    EXPECT_EQ(mesh.faceOf, (std::vector<std::uint32_t>{0, 0}));
    EXPECT_EQ(mesh.wedgeCount, 4u);
    EXPECT_EQ(at(mesh, "texcoord", 0, 1), (Numbers{1, 0}));
    EXPECT_EQ(at(mesh, "texcoord", 1, 2), (Numbers{0.25, 0.5}));
    EXPECT_EQ(at(mesh, "normal", 1, 2), (Numbers{0, 1, 0}));
    EXPECT_EQ(named(mesh.wedgeAttributes, "texcoord")->meaning, AttributeMeaning::textureCoords);
    EXPECT_FALSE(named(mesh.wedgeAttributes, "texcoord")->isFromTop);
    EXPECT_EQ(named(mesh.wedgeAttributes, "normal")->meaning, AttributeMeaning::normal);
  }
}

TEST_F(ObjAttributes, EqualValuesAtAVertexAreOneWedgeHoweverOftenTheyAreListed) {
  // A seam between the faces at vertex 3; at vertex 1 the same value twice; values may follow the faces.
  const SurfaceMesh mesh =
      read(kFour + "f 1/1 2/2 3/3\nf 1/4 3/5 4/6\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 0\nvt 0.5 0.5\nvt 0 1\n").mesh;
  EXPECT_EQ(mesh.wedgeCount, 5u);
  EXPECT_EQ(mesh.wedges[0][0], mesh.wedges[1][0]);
  EXPECT_NE(mesh.wedges[0][2], mesh.wedges[1][1]);
  EXPECT_TRUE(mesh.faceOf.empty());
}

TEST_F(ObjAttributes, AnIndexThatNamesNothingIsNoReasonToRefuse) {
  // tinyobjloader, trimesh #272: "1/0/1" is none; three.js: indices beyond the list crash.
  for (const char* face :
       {"f 1/1 2/0 3/9\n", "f 1/1 2 3/-9\n", "f 1/1 2/ 3//7\n", "f 1/1 2// 3/99999999999999999999\n"}) {
    const MeshFile file = read(kFour + "vt 0.5 0.75\n" + face);
    EXPECT_EQ(at(file.mesh, "texcoord", 0, 0), (Numbers{0.5, 0.75})) << face;
    EXPECT_EQ(at(file.mesh, "texcoord", 0, 1), (Numbers{0, 0})) << face;
    EXPECT_EQ(at(file.mesh, "texcoord", 0, 2), (Numbers{0, 0})) << face;
    EXPECT_FALSE(file.warnings.empty()) << face;
    EXPECT_EQ(named(file.mesh.wedgeAttributes, "normal"), nullptr);
  }
  // Without any that names something there are no wedges.
  const MeshFile none = read(kFour + "f 1/1/1 2/2/2 3/3/3\n");
  EXPECT_FALSE(none.mesh.hasWedges());
  EXPECT_FALSE(none.warnings.empty());
}

TEST_F(ObjAttributes, FacesWithAndWithoutTextureCoordinatesKeepTheirOwn) {
  // threejs-full-es6 #16: one material without a texture shifted the coordinates of all later faces.
  const MeshFile file = read(kFour + "vt 0 1\nvt 1 0\nvt 1 1\nf 1 2 3\nf 1/1 3/2 4/3\nf 2 3 4\n");
  EXPECT_EQ(at(file.mesh, "texcoord", 0, 0), (Numbers{0, 0}));
  EXPECT_EQ(at(file.mesh, "texcoord", 1, 0), (Numbers{0, 1}));
  EXPECT_EQ(at(file.mesh, "texcoord", 1, 2), (Numbers{1, 1}));
  EXPECT_EQ(at(file.mesh, "texcoord", 2, 2), (Numbers{0, 0}));
  EXPECT_EQ(file.warnings.size(), 1u);
}

TEST_F(ObjAttributes, NumbersHaveTheTypeThatTheirDigitsNeed) {
  const auto typeOf = [&](const std::string& u) {
    return named(read(kFour + "vt " + u + " 0\nf 1/1 2/1 3/1\n").mesh.wedgeAttributes, "texcoord")->type;
  };
  for (const char* u : {"0.1", "0.333333", "-0", "1e-7", "3.4e38", "16777217e-1"})
    EXPECT_EQ(typeOf(u), std::string_view(u) == "16777217e-1" ? ScalarType::float64 : ScalarType::float32)
        << u;
  for (const char* u : {"0.123456789", "0.3333333333333333", "1e-300", "1e39"})
    EXPECT_EQ(typeOf(u), ScalarType::float64) << u;
}

TEST_F(ObjAttributes, TextureCoordinatesHaveAThirdNumberIfItSaysSomething) {
  const auto componentsOf = [&](const std::string& lines) {
    return named(read(kFour + lines + "f 1/1 2/2 3/1\n").mesh.wedgeAttributes, "texcoord")->components;
  };
  EXPECT_EQ(componentsOf("vt 0.5\nvt 1\n"), 2);
  EXPECT_EQ(componentsOf("vt 0.5 0.5 0.000\nvt 1 0 0\n"), 2);
  EXPECT_EQ(componentsOf("vt 0.5 0.5 0.000\nvt 1 0 0.5\n"), 3);
}

TEST_F(ObjAttributes, ValuesThatAreNotFiniteAreZerosWithAWarning) {
  const MeshFile file =
      read(kFour + "vt nan 1\nvt -nan(ind) 1.#QNAN\nvn -1.#IND00 1e999 1\nf 1/1/1 2/2/1 3/1/1\n");
  EXPECT_EQ(at(file.mesh, "texcoord", 0, 0), (Numbers{0, 1}));
  EXPECT_EQ(at(file.mesh, "texcoord", 0, 1), (Numbers{0, 0}));
  EXPECT_EQ(at(file.mesh, "normal", 0, 1), (Numbers{0, 0, 1}));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].sentence.find("5 numbers"), std::string::npos) << file.warnings[0].sentence;
}

TEST_F(ObjAttributes, VerticesHaveColours) {
  struct Case {
    const char* vertices;
    ScalarType type;
    Numbers first, last;
  };
  // Godot #71033: vertices without a colour are white. Colours are sRGB (three.js #23340).
  for (const Case& c :
       {Case{"v 0 0 0 0.5 0.25 1\nv 1 0 0 0 0 0\nv 0 1 0 1 1 1\n",
             ScalarType::float32,
             {0.5, 0.25, 1},
             {1, 1, 1}},
        Case{"v 0 0 0\nv 1 0 0 0.5 0 0\nv 0 1 0\n", ScalarType::float32, {1, 1, 1}, {1, 1, 1}},
        Case{"v 0 0 0 0.123456789 0 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0.1\n",
             ScalarType::float64,
             {0.123456789, 0, 0},
             {0, 0, 0.1}},
        Case{"v 0 0 0 0.5 0.25 1 0.5\nv 1 0 0 0 0 0\nv 0 1 0 1 1 1\n",
             ScalarType::float32,
             {0.5, 0.25, 1, 0.5},
             {1, 1, 1, 1}},
        // Red is a byte in any way; the others are the digits that float32 has of a byte's fraction.
        Case{"v 0 0 0 1 0 0\nv 1 0 0 0 0.2 0.003921569\nv 0 1 0 0.5019608 0 0\n",
             ScalarType::uint8,
             {255, 0, 0},
             {128, 0, 0}},
        Case{"v 0 0 0 255 128 0\nv 1 0 0 0 0 0\nv 0 1 0 1 2 3\n",
             ScalarType::uint8,
             {255, 128, 0},
             {1, 2, 3}}}) {
    const MeshFile file = read(std::string(c.vertices) + "f 1 2 3\n");
    const Attribute* color = named(file.mesh.vertexAttributes, "color");
    ASSERT_NE(color, nullptr) << c.vertices;
    EXPECT_EQ(color->type, c.type) << c.vertices;
    EXPECT_EQ(color->colorSpace, ColorSpace::srgb);
    EXPECT_EQ(color->isNormalized, c.type == ScalarType::uint8);
    EXPECT_EQ(color->components, c.first.size());
    EXPECT_EQ(color->meaning, AttributeMeaning::color);
    for (std::size_t i = 0; i < c.first.size(); ++i) {
      EXPECT_FLOAT_EQ(float(color->numbers(0)[i]), float(c.first[i])) << c.vertices;
      EXPECT_FLOAT_EQ(float(color->numbers(2)[i]), float(c.last[i])) << c.vertices;
    }
  }
  const MeshFile weights = read("v 0 0 0 1\nv 1 0 0 0.5\nv 0 1 0 1 2\nf 1 2 3\n");
  EXPECT_TRUE(weights.mesh.vertexAttributes.empty());
  EXPECT_EQ(weights.warnings.size(), 2u);
}

TEST_F(ObjAttributes, ObjectsAreOneForEachLineAndGroupsOneForEachName) {
  // tobj #15: objects of one name stay apart, groups of one name are one. "g" without a name ends a group.
  const SurfaceMesh mesh = read(kFour +
                                "f 1 2 3\no  a \\ b \nf 1 2 3\ng x y\nf 1 2 3\no a \\ b\nf 1 2 4\ng z\no "
                                "empty\no\nf 1 2 4\ng x y\nf 1 3 4\ng\nf 1 3 4\n")
                               .mesh;
  EXPECT_EQ(mesh.objects, (std::vector<std::string>{"a \\ b", "a \\ b", "empty", ""}));
  EXPECT_EQ(mesh.objectOf, (std::vector<std::uint32_t>{kNoObject, 0, 0, 1, 3, 3, 3}));
  EXPECT_EQ(mesh.groups, (std::vector<std::string>{"x y", "z"}));
  EXPECT_EQ(mesh.groupOf, (std::vector<std::uint32_t>{kNoObject, kNoObject, 0, 0, 1, 0, kNoObject}));
}

TEST_F(ObjAttributes, SmoothingGroupsAreLabelsOfTriangles) {
  const SurfaceMesh mesh = read(kFour + "s off\nf 1 2 3\ns 7\nf 1 2 3 4\ns on\nf 1 2 3\ns 0\nf 1 2 4\n").mesh;
  const Attribute* groups = named(mesh.triangleAttributes, "smoothing_group");
  ASSERT_NE(groups, nullptr);
  Numbers numbers;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) numbers.push_back(groups->numbers(t)[0]);
  EXPECT_EQ(numbers, (Numbers{0, 7, 7, 1, 0}));
  EXPECT_TRUE(isLabel(*groups));
  EXPECT_TRUE(read(kFour + "s off\nf 1 2 3\ns 0\nf 1 2 3\n").mesh.triangleAttributes.empty());
}

TEST_F(ObjAttributes, WhatIsNoFaceIsNamed) {
  // three.js #9204, obj2gltf #119: faces of one or two corners are in real files.
  const MeshFile file =
      read(kFour + "f 1\nf 1 2\nf 1 2 3\nl 1 2 3\np 1\np 2\ncstype bezier\nvp 0 1\ncurv 0 1 1 2\nend\n");
  EXPECT_EQ(file.mesh.triangles.size(), 1u);
  EXPECT_EQ(file.mesh.faceOf, std::vector<std::uint32_t>{2});
  ASSERT_EQ(file.warnings.size(), 2u);
  EXPECT_EQ(file.warnings[0].sentence,
            "2 of its 3 faces have fewer than three corners and are left out (the first is face 1)");
  for (const char* named : {"\"l\" (1)", "\"p\" (2)", "\"curv\" (1)", "\"cstype\" (1)"})
    EXPECT_NE(file.warnings[1].sentence.find(named), std::string::npos) << file.warnings[1].sentence;
}

TEST_F(ObjAttributes, AMillionKeywordsAreOneSentence) {
  std::string text = kFour + "f 1 2 3\n";
  for (int i = 0; i < 1000; ++i) text += "k" + std::to_string(i) + " 1\n";
  const MeshFile file = read(text);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_LT(file.warnings[0].sentence.size(), 300u);
}

}  // namespace
}  // namespace arete
