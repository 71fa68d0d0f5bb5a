// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is painted on a mesh stays where it is, on its own side of seams, in its range.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "surface/decimate/decimate.h"
#include "surface/families.h"

namespace arete {
namespace {

DecimatedMesh made(const SurfaceMesh& mesh, DecimateOperator method, std::uint32_t triangles,
                   std::vector<AttributeWeight> weights) {
  DecimateOptions options;
  options.method = method;
  options.maxTriangles = triangles;
  options.attributeWeights = std::move(weights);
  Result<DecimatedMesh> result = decimate(mesh, options);
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

Attribute colours(ScalarType type = ScalarType::float32) {
  Attribute made{.name = "color", .meaning = AttributeMeaning::color, .type = type, .components = 3};
  made.isNormalized = !isFloat(type);
  return made;
}
Attribute texcoords(ScalarType type) {
  return {.name = "texcoord", .meaning = AttributeMeaning::textureCoords, .type = type, .components = 2};
}

/// A flat plate, red on the left and blue on the right, of floats or of bytes.
SurfaceMesh plate(ScalarType type) {
  SurfaceMesh mesh(shapes::sheet(24, 18));
  for (Vec3& p : mesh.positions) p.z = 0;
  Attribute color = colours(type);
  const double whole = isFloat(type) ? 1 : 255;
  for (const Vec3& p : mesh.positions)
    color.append(p.x < 11.5 ? std::vector<double>{whole, 0, 0} : std::vector<double>{0, 0, whole});
  mesh.vertexAttributes = {color};
  return mesh;
}

TEST(DecimateAttributes, APlateOfTwoColoursKeepsBothAndNoOther) {
  for (const ScalarType type : {ScalarType::float32, ScalarType::uint8})
    for (const DecimateOperator method : {DecimateOperator::edge, DecimateOperator::halfEdge,
                                          DecimateOperator::face, DecimateOperator::vertexPair}) {
      SCOPED_TRACE(int(method));
      const SurfaceMesh result = made(plate(type), method, 60, {{"color", 0.2}}).mesh;
      EXPECT_LE(result.triangles.size(), 60u);
      const double whole = isFloat(type) ? 1 : 255;
      for (std::uint32_t v = 0; v < result.positions.size(); ++v) {
        const std::vector<double> rgb = result.vertexAttributes[0].numbers(v);
        const double x = result.positions[v].x;
        EXPECT_NEAR(rgb[0], x <= 11.5 ? whole : 0, 1e-4 * whole) << x;
        EXPECT_NEAR(rgb[2], x <= 11.5 ? 0 : whole, 1e-4 * whole) << x;
        EXPECT_EQ(rgb[1], 0);
        EXPECT_TRUE(x <= 11 + 1e-6 || x >= 12 - 1e-6) << x;
      }
    }
}

TEST(DecimateAttributes, CoordinatesThatAreLinearStaySoToRounding) {
  SurfaceMesh mesh(shapes::sheet(20, 16));
  for (Vec3& p : mesh.positions) p.z = 0;
  Attribute uv = texcoords(ScalarType::float64);
  mesh.wedges = mesh.triangles;
  mesh.wedgeCount = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : mesh.positions) uv.append(std::vector<double>{p.x / 20 + 3, p.y / 10 - p.x / 7});
  mesh.wedgeAttributes = {uv};
  for (const DecimateOperator method :
       {DecimateOperator::edge, DecimateOperator::face, DecimateOperator::halfEdge, DecimateOperator::cluster,
        DecimateOperator::lindstromTurk}) {
    SCOPED_TRACE(int(method));
    const SurfaceMesh result = made(mesh, method, 60, {{"texcoord", 1}}).mesh;
    ASSERT_TRUE(result.validate());
    for (std::size_t t = 0; t < result.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3& p = result.positions[result.triangles[t][c]];
        const std::vector<double> is = result.wedgeAttributes[0].numbers(result.wedges[t][c]);
        EXPECT_NEAR(is[0], p.x / 20 + 3, 1e-6);
        EXPECT_NEAR(is[1], p.y / 10 - p.x / 7, 1e-6);
      }
    // Nothing differs at a vertex, so that corners there have one wedge.
    EXPECT_EQ(result.wedgeCount, result.positions.size());
  }
}

/// A tube around z whose texture runs once around it, with a seam where it meets itself.
SurfaceMesh tube(std::uint32_t around, std::uint32_t along) {
  SurfaceMesh mesh;
  Attribute uv = texcoords(ScalarType::float32);
  for (std::uint32_t j = 0; j <= along; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      mesh.positions.push_back({std::cos(angle), std::sin(angle), 3.0 * j / along});
    }
  for (std::uint32_t j = 0; j <= along; ++j)
    for (std::uint32_t i = 0; i <= around; ++i)
      uv.append(std::vector<double>{double(i) / around, double(j) / along});
  for (std::uint32_t j = 0; j < along; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const auto v = [&](std::uint32_t di, std::uint32_t dj) {
        return (j + dj) * around + (i + di) % around;
      };
      const auto w = [&](std::uint32_t di, std::uint32_t dj) { return (j + dj) * (around + 1) + i + di; };
      mesh.triangles.push_back({v(0, 0), v(1, 0), v(1, 1)});
      mesh.wedges.push_back({w(0, 0), w(1, 0), w(1, 1)});
      mesh.triangles.push_back({v(0, 0), v(1, 1), v(0, 1)});
      mesh.wedges.push_back({w(0, 0), w(1, 1), w(0, 1)});
    }
  mesh.wedgeCount = (around + 1) * (along + 1);
  mesh.wedgeAttributes = {uv};
  return mesh;
}

TEST(DecimateAttributes, NoTriangleHasThePictureBackwardsAcrossASeam) {
  const SurfaceMesh mesh = tube(48, 20);
  for (const DecimateOperator method :
       {DecimateOperator::edge, DecimateOperator::face, DecimateOperator::halfEdge, DecimateOperator::cluster,
        DecimateOperator::lindstromTurk}) {
    SCOPED_TRACE(int(method));
    const SurfaceMesh result = made(mesh, method, 300, {{"texcoord", 0.2}}).mesh;
    ASSERT_TRUE(result.validate());
    for (std::size_t t = 0; t < result.triangles.size(); ++t) {
      double low = 1, high = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3& p = result.positions[result.triangles[t][c]];
        const double u = result.wedgeAttributes[0].numbers(result.wedges[t][c])[0];
        low = std::min(low, u);
        high = std::max(high, u);
        // By turns, of the nearest of those that are the same place.
        double off = u - std::atan2(p.y, p.x) / (2 * std::numbers::pi);
        off -= std::round(off);
        EXPECT_NEAR(off, 0, 0.06);
      }
      EXPECT_LT(high - low, 0.5);
    }
  }
}

TEST(DecimateAttributes, NumbersThatAreNotFiniteNeitherSpreadNorChangeTheShape) {
  SurfaceMesh mesh(shapes::hills(24, 3));
  Attribute color = colours();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const double bad = std::numeric_limits<double>::quiet_NaN();
    color.append(v % 97 == 5 ? std::vector<double>{bad, bad, bad} : std::vector<double>{0.25, 0.5, 0.75});
  }
  mesh.vertexAttributes = {color};
  for (const DecimateOperator method :
       {DecimateOperator::edge, DecimateOperator::face, DecimateOperator::cluster}) {
    SCOPED_TRACE(int(method));
    const SurfaceMesh result = made(mesh, method, 200, {{"color", 1}}).mesh;
    for (const Vec3& p : result.positions) EXPECT_TRUE(isFinite(p));
    std::size_t bad = 0;
    for (std::uint32_t v = 0; v < result.positions.size(); ++v) {
      const std::vector<double> rgb = result.vertexAttributes[0].numbers(v);
      if (std::isnan(rgb[0])) {
        ++bad;
        continue;
      }
      EXPECT_NEAR(rgb[0], 0.25, 1e-6);
      EXPECT_NEAR(rgb[2], 0.75, 1e-6);
    }
    EXPECT_LE(bad, 7u);
  }
}

TEST(DecimateAttributes, ColoursStayInTheRangeOfTheSourceAndNormalsHaveTheirLength) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> level(0.2, 0.8), any(-1, 1);
  SurfaceMesh mesh(shapes::shaken(shapes::globe(40, 20), 3, 0.02));
  Attribute color = colours(), normal{.name = "normal", .meaning = AttributeMeaning::normal};
  normal.components = 3;
  for (const Vec3& p : mesh.positions) {
    color.append(std::vector<double>{level(random), level(random), level(random)});
    const Vec3 n = unit(p + 0.1 * Vec3{any(random), any(random), any(random)});
    normal.append(std::vector<double>{n.x, n.y, n.z});
  }
  mesh.vertexAttributes = {color, normal};
  for (const DecimateOperator method : {DecimateOperator::edge, DecimateOperator::face,
                                        DecimateOperator::cluster, DecimateOperator::lindstromTurk}) {
    SCOPED_TRACE(int(method));
    const SurfaceMesh result = made(mesh, method, 200, {{"color", 0.1}, {"normal", 0.1}}).mesh;
    for (std::uint32_t v = 0; v < result.positions.size(); ++v) {
      for (const double x : result.vertexAttributes[0].numbers(v)) {
        EXPECT_GE(x, 0.2 - 1e-6);
        EXPECT_LE(x, 0.8 + 1e-6);
      }
      const std::vector<double> n = result.vertexAttributes[1].numbers(v);
      EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-5);
    }
  }
}

TEST(DecimateAttributes, DirectionsOfBytesAndSignsOfTangentsStayWhole) {
  SurfaceMesh mesh(shapes::shaken(shapes::globe(30, 15), 5, 0.02));
  Attribute normal{.name = "normal", .meaning = AttributeMeaning::normal, .type = ScalarType::int8};
  normal.components = 3;
  normal.isNormalized = true;
  Attribute tangent{.name = "tangent", .meaning = AttributeMeaning::tangent};
  tangent.components = 4;
  for (const Vec3& p : mesh.positions) {
    const Vec3 n = unit(p), t = unit(Vec3{-n.y - 0.01, n.x, 0});
    normal.append(std::vector<double>{127 * n.x, 127 * n.y, 127 * n.z});
    tangent.append(std::vector<double>{t.x, t.y, t.z, n.z > 0.3 ? 1.0 : -1.0});
  }
  mesh.vertexAttributes = {normal, tangent};
  for (const DecimateOperator method : {DecimateOperator::edge, DecimateOperator::face,
                                        DecimateOperator::cluster, DecimateOperator::lindstromTurk}) {
    SCOPED_TRACE(int(method));
    const SurfaceMesh result = made(mesh, method, 120, {{"normal", 0.1}}).mesh;
    for (std::uint32_t v = 0; v < result.positions.size(); ++v) {
      const std::vector<double> n = result.vertexAttributes[0].numbers(v),
                                t = result.vertexAttributes[1].numbers(v);
      EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 127, 2);
      EXPECT_EQ(std::fabs(t[3]), 1);
    }
  }
}

TEST(DecimateAttributes, WithoutWeightsTheShapeIsThatOfTheShapeAlone) {
  SurfaceMesh mesh(shapes::shaken(shapes::globe(30, 15), 3, 0.02));
  const SurfaceMesh bare = mesh;
  Attribute color = colours();
  for (const Vec3& p : mesh.positions) color.append(std::vector<double>{p.x > 0 ? 1.0 : 0.0, 0, 0});
  mesh.vertexAttributes = {color};
  for (const DecimateOperator method : {DecimateOperator::edge, DecimateOperator::halfEdge,
                                        DecimateOperator::face, DecimateOperator::cluster}) {
    const auto placesWith = [&](const SurfaceMesh& of, std::vector<AttributeWeight> weights) {
      return made(of, method, 150, std::move(weights)).mesh.positions;
    };
    const std::vector<Vec3> shape = placesWith(bare, {});
    EXPECT_TRUE(placesWith(mesh, {}) == shape);
    EXPECT_TRUE(placesWith(mesh, {{"color", 0}}) == shape);
    EXPECT_FALSE(placesWith(mesh, {{"color", 1}}) == shape);
  }
}

TEST(DecimateAttributes, WeightsAreRelativeToTheDiagonal) {
  SurfaceMesh mesh(shapes::shaken(shapes::globe(30, 15), 3, 0.02));
  Attribute color = colours();
  for (const Vec3& p : mesh.positions)
    color.append(std::vector<double>{p.x > 0 ? 1.0 : 0.0, p.y > 0 ? 1.0 : 0.0, 0});
  mesh.vertexAttributes = {color};
  SurfaceMesh scaled = mesh;
  for (Vec3& p : scaled.positions) p = p * 0x1p20;
  for (const DecimateOperator method : {DecimateOperator::edge, DecimateOperator::face})
    EXPECT_EQ(made(mesh, method, 150, {{"color", 0.2}}).mesh.triangles,
              made(scaled, method, 150, {{"color", 0.2}}).mesh.triangles);
}

}  // namespace
}  // namespace arete
