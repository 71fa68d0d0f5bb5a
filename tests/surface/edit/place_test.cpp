// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/place.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "surface/families.h"

namespace arete {
namespace {

/// A triangle with an attribute of each kind of element and meaning.
SurfaceMesh withDirections(ScalarType type, bool isNormalized) {
  SurfaceMesh mesh;
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  const auto made = [&](const char* name, AttributeMeaning meaning, std::vector<double> numbers) {
    Attribute attribute{.name = name,
                        .meaning = meaning,
                        .type = type,
                        .components = std::uint8_t(numbers.size()),
                        .isNormalized = isNormalized};
    for (int i = 0; i < 3; ++i) attribute.append(numbers);
    return attribute;
  };
  const double one = isNormalized ? 127 : 1;
  mesh.vertexAttributes = {made("normal", AttributeMeaning::normal, {0, one, 0}),
                           made("tangent", AttributeMeaning::tangent, {one, 0, 0, -one}),
                           made("texcoord", AttributeMeaning::textureCoords, {one, 0}),
                           made("speed", AttributeMeaning::other, {0, one, 0})};
  return mesh;
}

TEST(Place, ScalesThenTurnsThenMovesAndTurnsDirectionsAlone) {
  for (const bool isNormalized : {false, true}) {
    SurfaceMesh mesh = withDirections(isNormalized ? ScalarType::int8 : ScalarType::float32, isNormalized);
    const double one = isNormalized ? 127 : 1;
    ASSERT_TRUE(place(mesh, Similarity(Turn{.heading = 90}, 2, {10, 20, 30})));
    EXPECT_EQ(mesh.positions[0], (Vec3{10, 18, 30}));
    EXPECT_EQ(mesh.positions[1], (Vec3{12, 20, 30}));
    EXPECT_EQ(mesh.positions[2], (Vec3{10, 20, 32}));
    EXPECT_EQ(mesh.vertexAttributes[0].numbers(1), (std::vector<double>{one, 0, 0}));
    EXPECT_EQ(mesh.vertexAttributes[1].numbers(1), (std::vector<double>{0, -one, 0, -one}))
        << "the sign of the third direction stays";
    EXPECT_EQ(mesh.vertexAttributes[2].numbers(1), (std::vector<double>{one, 0}));
    EXPECT_EQ(mesh.vertexAttributes[3].numbers(1), (std::vector<double>{0, one, 0}));
  }
}

TEST(Place, WithoutATurnAttributesStayToTheBit) {
  SurfaceMesh mesh = withDirections(ScalarType::float32, false);
  const auto before = mesh.vertexAttributes;
  ASSERT_TRUE(place(mesh, Similarity(Turn{}, 3, {1, 2, 3})));
  EXPECT_EQ(mesh.vertexAttributes, before);
}

TEST(Place, KeepsLengthsAnglesAndTheSideThatFacesOutwards) {
  for (const auto& family : shapes::families(4)) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> angle(-180, 180);
    SurfaceMesh mesh{family.mesh};
    const SurfaceMesh before = mesh;
    const Similarity placing(Turn{angle(random), angle(random), angle(random)}, 2.5, {7, -8, 9});
    ASSERT_TRUE(place(mesh, placing));
    EXPECT_EQ(mesh.triangles, before.triangles) << family.name;
    double volume = 0, volumeBefore = 0;
    for (const auto& [a, b, c] : before.triangles) {
      const auto part = [&](const SurfaceMesh& m) {
        const Vec3 o = m.positions[before.triangles[0][0]];
        return dot(cross(m.positions[a] - o, m.positions[b] - o), m.positions[c] - o);
      };
      volume += part(mesh);
      volumeBefore += part(before);
    }
    EXPECT_NEAR(volume, 2.5 * 2.5 * 2.5 * volumeBefore, 1e-9 * (1 + std::abs(volume))) << family.name;
  }
}

TEST(Place, OfAFileWithYUpHeadsAboutItsY) {
  const Similarity headed = withYUp(Similarity(Turn{.heading = 90}, 1, {}));
  // With y up, in front is -z and x is on the right.
  EXPECT_EQ(headed({0, 0, -1}), (Vec3{1, 0, 0}));
  EXPECT_EQ(headed({0, 5, 0}), (Vec3{0, 5, 0}));
  EXPECT_EQ(withYUp(Similarity(Turn{.pitch = 90}, 1, {}))({0, 0, -1}), (Vec3{0, 1, 0}));
}

TEST(Place, BeyondAllNumbersIsAnErrorThatNamesTheVertex) {
  SurfaceMesh mesh = withDirections(ScalarType::float32, false);
  mesh.positions[1] = {1e308, 0, 0};
  const Status placed = place(mesh, Similarity(Turn{}, 1000, {}));
  ASSERT_FALSE(placed);
  EXPECT_EQ(placed.error().culprit, "vertex 1");
}

}  // namespace
}  // namespace arete
