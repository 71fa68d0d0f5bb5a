// SPDX-License-Identifier: GPL-3.0-or-later
//
// What happened elsewhere: CesiumGS/obj2gltf#63 (models on their side, since OBJ states no axis), and
// IfcOpenShell/IfcOpenShell#421 (the vertices have to be turned, x, z, -y, not a node above them).
#include "io/formats/exchange/axes.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

MeshFile oneTriangle() {
  MeshFile file;
  file.mesh.positions = {{1, 2, 3}, {4, 5, 7}, {0, -1, 0.1}};
  file.mesh.triangles = {{0, 1, 2}};
  Attribute normal{.name = "normal", .meaning = AttributeMeaning::normal, .components = 3};
  for (int v = 0; v < 3; ++v) normal.append(std::vector<double>{0, 0.6, 0.8});
  Attribute tangent{.name = "tangent", .meaning = AttributeMeaning::tangent, .components = 4};
  for (int v = 0; v < 3; ++v) tangent.append(std::vector<double>{0, 0.8, -0.6, -1});
  file.mesh.vertexAttributes = {normal, tangent};
  return file;
}

TEST(PlaceMesh, TurnsPositionsAndDirectionsAndBack) {
  MeshFile mesh = oneTriangle();
  ASSERT_TRUE(placeMesh(mesh, {.up = MeshUp::y}, MeshUp::z));
  EXPECT_EQ(mesh.mesh.positions[0], (Vec3{1, -3, 2}));
  EXPECT_EQ(mesh.mesh.vertexAttributes[0].numbers(1), (std::vector<double>{0, -0.8f, 0.6f}));
  EXPECT_EQ(mesh.mesh.vertexAttributes[1].numbers(2), (std::vector<double>{0, 0.6f, 0.8f, -1}));
  EXPECT_EQ(mesh.up, MeshUp::unknown) << "its frame is none of ours";
  ASSERT_TRUE(placeMesh(mesh, {.up = MeshUp::z}, MeshUp::y));
  EXPECT_TRUE(mesh.mesh == oneTriangle().mesh);
  EXPECT_EQ(mesh.up, MeshUp::y);
}

TEST(PlaceMesh, DoesNothingToAxesThatAreRightOrNotStated) {
  for (const auto& [stated, wanted] :
       {std::pair{MeshUp::y, MeshUp::y}, std::pair{MeshUp::z, MeshUp::z},
        std::pair{MeshUp::unknown, MeshUp::y}, std::pair{MeshUp::unknown, MeshUp::z}}) {
    MeshFile mesh = oneTriangle();
    ASSERT_TRUE(placeMesh(mesh, {.up = stated}, wanted));
    EXPECT_TRUE(mesh.mesh == oneTriangle().mesh);
  }
}

TEST(PlaceMesh, ScalesToMetres) {
  for (const auto& [unit, metres] : {std::pair{"mm", 0.001}, std::pair{"cm", 0.01}, std::pair{"m", 1.},
                                     std::pair{"km", 1000.}, std::pair{"in", 0.0254}, std::pair{"ft", 0.3048},
                                     std::pair{"us-ft", 1200. / 3937}, std::pair{"yd", 0.9144}}) {
    MeshFile mesh = oneTriangle();
    mesh.triangleErrors = {1000};
    ASSERT_TRUE(placeMesh(mesh, {.unit = unit}, MeshUp::z));
    EXPECT_DOUBLE_EQ(mesh.mesh.positions[1].z, 7 * metres) << unit;
    EXPECT_FLOAT_EQ(mesh.triangleErrors[0], float(1000 * metres)) << unit;
    EXPECT_EQ(mesh.mesh.vertexAttributes, oneTriangle().mesh.vertexAttributes) << "directions have no length";
  }
  MeshFile mesh = oneTriangle();
  ASSERT_TRUE(placeMesh(mesh, {.unit = "mm"}, MeshUp::z));
  EXPECT_EQ(mesh.mesh.positions[0], (Vec3{0.001, 0.002, 0.003})) << "the nearest double";
}

TEST(PlaceMesh, AMoveTakesTheOriginAlongAndBoundsStayBounds) {
  MeshFile mesh = oneTriangle();
  mesh.frame.origin = Vec3{1, 2, 3};
  mesh.frame.rounding = {1, 2, 4};
  mesh.triangleErrors = {0.1F, 2, 0};
  ASSERT_TRUE(placeMesh(mesh, Similarity(Turn{.heading = 90}, 0.3, {4e5, 5e6, 0})));
  EXPECT_EQ(*mesh.frame.origin, mesh.mesh.positions[0]);
  EXPECT_EQ(mesh.frame.rounding, (Vec3{0.6, 0.3, 1.2})) << "its x is what was along y";
  EXPECT_EQ(mesh.mesh.vertexAttributes[0].numbers(0), (std::vector<double>{0.6f, 0, 0.8f}));
  EXPECT_GE(double(mesh.triangleErrors[0]), 0.3 * double(0.1F));
  EXPECT_FLOAT_EQ(mesh.triangleErrors[0], 0.03F);
  EXPECT_GE(double(mesh.triangleErrors[1]), 0.6);
  EXPECT_EQ(mesh.triangleErrors[2], 0);

  MeshFile sixty = oneTriangle();
  sixty.frame.rounding = {1, 0, 0};
  ASSERT_TRUE(placeMesh(sixty, Similarity(Turn{.heading = 60}, 1, {})));
  EXPECT_NEAR(sixty.frame.rounding.x, 0.5, 1e-12);
  EXPECT_NEAR(sixty.frame.rounding.y, 0.866025404, 1e-9);

  MeshFile wide = oneTriangle();
  wide.triangleErrors = {3e38F};
  ASSERT_TRUE(placeMesh(wide, Similarity(Turn{}, 10, {})));
  EXPECT_TRUE(wide.triangleErrors.empty()) << "no float is as large";
}

TEST(PlaceMesh, RefusesWhatContradictsTheFile) {
  MeshFile withCrs = oneTriangle();
  withCrs.crsWkt = "EPSG:32611";
  withCrs.up = MeshUp::z;
  MeshFile framed = oneTriangle();
  framed.up = MeshUp::z;
  MeshFile inFeet = oneTriangle();
  inFeet.verticalUnit = "ft";
  struct Case {
    MeshFile mesh;
    MeshPlacing placing;
    const char* culprit;
  };
  for (Case& c : std::vector<Case>{{withCrs, {.up = MeshUp::y}, "up y"},
                                   {framed, {.up = MeshUp::y}, "up y"},
                                   {withCrs, {.unit = "mm"}, "unit mm"},
                                   {inFeet, {.unit = "mm"}, "unit mm"},
                                   {oneTriangle(), {.unit = "furlong"}, "unit furlong"}}) {
    const Status placed = placeMesh(c.mesh, c.placing, MeshUp::z);
    ASSERT_FALSE(placed);
    EXPECT_EQ(placed.error().code, ErrorCode::usage);
    EXPECT_EQ(placed.error().culprit, c.culprit);
  }
  EXPECT_TRUE(placeMesh(withCrs, {.up = MeshUp::z}, MeshUp::y));
  EXPECT_EQ(withCrs.mesh.positions[0], (Vec3{1, 2, 3})) << "the writer turns it by its frame";
  MeshFile wide = oneTriangle();
  wide.mesh.positions[0].x = 1e307;
  EXPECT_EQ(placeMesh(wide, {.unit = "km"}, MeshUp::z).error().code, ErrorCode::invalidData);
}

}  // namespace
}  // namespace arete
