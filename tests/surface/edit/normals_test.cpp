// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "surface/edit/joined_surface.h"

namespace arete {
namespace {

/// A strip of squares around a cylinder, each corner with a wedge of its own.
SurfaceMesh cylinder(std::uint32_t sides) {
  SurfaceMesh mesh;
  for (std::uint32_t i = 0; i < sides; ++i)
    for (const double z : {0., 1.}) {
      const double angle = 2 * std::acos(-1.0) * i / sides;
      mesh.positions.push_back({std::cos(angle), std::sin(angle), z});
    }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.wedges.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  mesh.wedgeCount = 3 * static_cast<std::uint32_t>(mesh.triangles.size());
  return mesh;
}

template <class NormalOf>
void addNormals(SurfaceMesh& mesh, ScalarType type, const NormalOf& normalOf) {
  Attribute normal{.name = "normal", .meaning = AttributeMeaning::normal, .type = type, .components = 3};
  normal.isNormalized = !isFloat(type);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 n = normalOf(t, mesh.positions[mesh.triangles[t][k]]);
      const double unit = type == ScalarType::int8 ? 127 : type == ScalarType::int16 ? 32767 : 1;
      normal.append(std::vector<double>{unit * n.x, unit * n.y, unit * n.z});
    }
  mesh.wedgeAttributes.push_back(std::move(normal));
}

Vec3 outwards(const Vec3& p) {
  return Vec3{p.x, p.y, 0} / std::hypot(p.x, p.y);
}

TEST(AgreeingNormals, ThoseThatDifferInLastDigitsAreOne) {
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u, 5u})
    for (const double noise : {0.0, 1e-7, 1e-6, 1e-5}) {
      std::mt19937 random(seed);
      std::normal_distribution<double> scatter(0, noise / 2);
      SurfaceMesh mesh = cylinder(6 + seed);
      addNormals(mesh, ScalarType::float32, [&](std::size_t, const Vec3& p) {
        return outwards(p) + (noise > 0 ? Vec3{scatter(random), scatter(random), scatter(random)} : Vec3{});
      });
      joinAgreeingNormals(mesh);
      ASSERT_TRUE(mesh.validate());
      EXPECT_EQ(countSeamEdges(mesh), 0u) << "seed " << seed << ", noise " << noise;
    }
}

TEST(AgreeingNormals, CreasesStay) {
  for (const double angle : {0.001, 0.01, 0.1, 1.0}) {
    SurfaceMesh mesh = cylinder(8);
    // Every second side is turned.
    addNormals(mesh, ScalarType::float32, [&](std::size_t t, const Vec3& p) {
      const Vec3 n = outwards(p);
      const double by = t / 2 % 2 == 0 ? 0 : angle;
      return Vec3{n.x * std::cos(by) - n.y * std::sin(by), n.x * std::sin(by) + n.y * std::cos(by), 0};
    });
    joinAgreeingNormals(mesh);
    EXPECT_EQ(countSeamEdges(mesh), 8u) << angle;
  }
}

TEST(AgreeingNormals, TextureSeamsStayWhereNormalsAgree) {
  SurfaceMesh mesh = cylinder(8);
  addNormals(mesh, ScalarType::float32, [](std::size_t, const Vec3& p) { return outwards(p); });
  Attribute uv{.name = "texcoord", .meaning = AttributeMeaning::textureCoords, .components = 2};
  for (std::uint32_t w = 0; w < mesh.wedgeCount; ++w)
    uv.append(std::vector<double>{w / 6 == 0 ? 1.0 : 0.0, 0.0});  // the first square is a chart
  mesh.wedgeAttributes.push_back(std::move(uv));
  joinAgreeingNormals(mesh);
  EXPECT_EQ(countSeamEdges(mesh), 2u);
}

TEST(AgreeingNormals, AWedgeThatSeveralVerticesShareStays) {
  SurfaceMesh mesh = cylinder(8);
  addNormals(mesh, ScalarType::float32, [](std::size_t, const Vec3& p) { return outwards(p); });
  for (auto& wedges : mesh.wedges) wedges = {0, 0, 0};
  joinAgreeingNormals(mesh);
  EXPECT_TRUE(mesh.validate());
}

TEST(AgreeingNormals, SmallIntegersStandForFractions) {
  SurfaceMesh mesh = cylinder(8);
  addNormals(mesh, ScalarType::int16,
             [](std::size_t t, const Vec3& p) { return outwards(p) * (1 - 3e-5 * double(t % 2)); });
  joinAgreeingNormals(mesh);
  EXPECT_EQ(countSeamEdges(mesh), 0u);
}

/// A bumpy height field of n x n squares, each corner with a wedge of its own.
SurfaceMesh bumps(std::uint32_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(0, 0.5);
  SurfaceMesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) mesh.positions.push_back({double(x), double(y), height(random)});
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + n + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.wedges.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  mesh.wedgeCount = 3 * static_cast<std::uint32_t>(mesh.triangles.size());
  return mesh;
}

TEST(AgreeingNormals, ThoseOfFlatFacesAreLeftOutAndSmoothOnesStay) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    SurfaceMesh flat = bumps(8, seed), smooth = flat;
    addNormals(flat, ScalarType::float32, [&](std::size_t t, const Vec3&) {
      const auto& [a, b, c] = flat.triangles[t];
      const Vec3 n = cross(flat.positions[b] - flat.positions[a], flat.positions[c] - flat.positions[a]);
      return n / norm(n);
    });
    // Of a smooth surface, with more noise than a picture hides: seams at every edge.
    std::mt19937 random(seed);
    std::normal_distribution<double> scatter(0, 0.02);
    addNormals(smooth, ScalarType::float32, [&](std::size_t, const Vec3& p) {
      const Vec3 n{std::sin(p.x) + scatter(random), std::cos(p.y) + scatter(random), 1};
      return n / norm(n);
    });
    EXPECT_TRUE(dropFlatNormals(flat)) << "seed " << seed;
    EXPECT_TRUE(flat.wedgeAttributes.empty() && flat.validate());
    EXPECT_FALSE(dropFlatNormals(smooth)) << "seed " << seed;
    EXPECT_EQ(smooth.wedgeAttributes.size(), 1u);
  }
}

TEST(AgreeingNormals, TheAttributesThatMakeSeamsAreNamed) {
  SurfaceMesh mesh = bumps(2, 1);
  addNormals(mesh, ScalarType::float32, [](std::size_t, const Vec3&) { return Vec3{0, 0, 1}; });
  Attribute chart{.name = "texcoord", .meaning = AttributeMeaning::textureCoords, .components = 2};
  for (std::uint32_t w = 0; w < mesh.wedgeCount; ++w)
    chart.append(std::vector<double>{w < 3 ? 1.0 : 0.0, 0.0});
  mesh.wedgeAttributes.push_back(std::move(chart));
  const std::vector<SeamAttribute> seams = seamAttributes(mesh);
  ASSERT_EQ(seams.size(), 1u);
  EXPECT_EQ(seams[0].name, "texcoord");
  EXPECT_EQ(seams[0].edges, 2u);  // the first triangle has one edge on the border
}

}  // namespace
}  // namespace arete
