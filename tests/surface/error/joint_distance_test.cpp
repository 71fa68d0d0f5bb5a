// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle searches a grid over the triangle, and a finer one around what it finds.
#include "surface/error/joint_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace arete {
namespace {

double searched(const SpaceTriangle& t, const AttributeField& field, const JointDistance::DrawnCorners& drawn,
                const Vec3& p, const std::vector<double>& wanted) {
  std::vector<double> found(field.components());
  const auto at = [&](double u, double v) {
    field.mean(drawn, {1 - u - v, u, v}, found);
    const Vec3 q = (1 - u - v) * t[0] + u * t[1] + v * t[2];
    return squaredDistance(p, q) + field.weighedSquares(wanted, found);
  };
  double least = std::numeric_limits<double>::infinity(), bestU = 0, bestV = 0;
  double middleU = 0.5, middleV = 0.5, half = 0.5;
  for (int round = 0; round < 12; ++round) {
    for (int i = -10; i <= 10; ++i)
      for (int j = -10; j <= 10; ++j) {
        const double u = std::clamp(middleU + half * i / 10, 0.0, 1.0),
                     v = std::clamp(middleV + half * j / 10, 0.0, 1 - u);
        if (const double d = at(u, v); d < least) least = d, bestU = u, bestV = v;
      }
    middleU = bestU;
    middleV = bestV;
    half *= 0.4;
  }
  return least;
}

TEST(JointDistance, IsTheLeastThatASearchOfTheTriangleFinds) {
  const std::uint64_t seed = 5;
  std::mt19937_64 random(seed);
  const auto number = [&] { return double(random() % 2001) / 1000 - 1; };
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    SurfaceMesh mesh;
    for (int v = 0; v < 6; ++v) mesh.positions.push_back({number(), number(), number()});
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    Attribute coords{.name = "texcoord",
                     .meaning = AttributeMeaning::textureCoords,
                     .type = ScalarType::float64,
                     .components = 2},
        heat{.name = "heat", .type = ScalarType::float64};
    for (int v = 0; v < 6; ++v) {
      coords.append(std::array{number(), number()});
      heat.append(std::array{number()});
    }
    mesh.vertexAttributes = {coords, heat};
    const AttributeField field(mesh, 2);
    const SpaceTriangle t{mesh.positions[0], mesh.positions[1],
                          // Also a triangle without an area.
                          round % 10 == 0 ? mesh.positions[1] : mesh.positions[2]};
    JointDistance distance(field);
    distance.add(t, {0, 1, 2});
    const auto wantedAt = field.at(3 + random() % 3);
    const std::vector<double> wanted(wantedAt.begin(), wantedAt.end());
    const Vec3 p = mesh.positions[3];
    const double found = distance.squared(0, p, wanted), least = searched(t, field, {0, 1, 2}, p, wanted);
    EXPECT_NEAR(found, least, 1e-4 * (1 + least));
    EXPECT_LE(found, least * (1 + 1e-9) + 1e-12);
  }
}

TEST(JointDistance, OfAttributesThatAreNotFiniteIsThatOfPlaces) {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  Attribute heat{.name = "heat", .type = ScalarType::float64};
  for (const double h : {0.0, 1.0, std::numeric_limits<double>::quiet_NaN()}) heat.append(std::array{h});
  mesh.vertexAttributes = {heat};
  const AttributeField field(mesh, 2);
  JointDistance distance(field);
  distance.add({mesh.positions[0], mesh.positions[1], mesh.positions[2]}, {0, 1, 2});
  EXPECT_NEAR(distance.squared(0, {0.2, 0.2, 0.5}, std::vector{7.0}), 0.25, 1e-12);
}

}  // namespace
}  // namespace arete
