// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/normals/made_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "surface/model/wedges.h"

namespace arete {
namespace {

using Quads = std::vector<std::array<std::uint32_t, 4>>;

/// Quads cut along one diagonal or the other, by the bits of a seed.
SurfaceMesh ofQuads(const std::vector<Vec3>& positions, const Quads& quads, std::uint32_t seed) {
  SurfaceMesh mesh;
  mesh.positions = positions;
  std::mt19937 random(seed);
  for (const auto& [a, b, c, d] : quads)
    if (seed == 0 || random() % 2 == 0) {
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    } else {
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({b, c, d});
    }
  return mesh;
}

SurfaceMesh cube(std::uint32_t seed = 0) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({double(i & 1), double((i >> 1) & 1), double(i >> 2)});
  return ofQuads(corners,
                 {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}, seed);
}

/// A tube of `sides` plane quads, as floats.
SurfaceMesh tube(std::uint32_t sides, std::uint32_t seed = 0) {
  std::vector<Vec3> ring;
  Quads quads;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double a = 2 * std::numbers::pi * i / sides;
    for (const double z : {0.0, 3.0})
      ring.push_back({double(float(std::cos(a))), double(float(std::sin(a))), z});
    const std::uint32_t next = (i + 1) % sides;
    quads.push_back({2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
  }
  return ofQuads(ring, quads, seed);
}

SurfaceMesh smooth(SurfaceMesh mesh, double crease = kCreaseDegrees) {
  EXPECT_TRUE(makeNormals(mesh, {NormalsKind::smooth, crease}));
  EXPECT_TRUE(mesh.validate());
  return mesh;
}

Vec3 numbersOf(const Attribute& a, std::size_t i) {
  const auto n = a.numbers(i);
  return {n[0], n[1], n[2]};
}

/// The normal of a corner.
Vec3 at(const SurfaceMesh& mesh, std::size_t t, std::size_t k) {
  for (const Attribute& a : mesh.wedgeAttributes)
    if (a.name == kNormalName) return numbersOf(a, mesh.wedges[t][k]);
  for (const Attribute& a : mesh.vertexAttributes)
    if (a.name == kNormalName) return numbersOf(a, mesh.triangles[t][k]);
  ADD_FAILURE() << "no normals";
  return {};
}

double degreesBetween(const Vec3& a, const Vec3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

Vec3 faceNormal(const SurfaceMesh& mesh, std::size_t t) {
  const auto& v = mesh.triangles[t];
  const Vec3 n =
      cross(mesh.positions[v[1]] - mesh.positions[v[0]], mesh.positions[v[2]] - mesh.positions[v[0]]);
  return n / norm(n);
}

TEST(MadeNormals, OfACubeAreItsFaces) {
  for (const SurfaceMesh& mesh : {smooth(cube()), smooth(cube(7))}) {
    ASSERT_TRUE(mesh.hasWedges());
    EXPECT_EQ(mesh.wedgeCount, 24u);
    for (std::size_t t = 0; t < 12; ++t)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LT(degreesBetween(at(mesh, t, k), faceNormal(mesh, t)), 1e-5);
  }
}

TEST(MadeNormals, BeyondTheCreaseAngleACubeIsRoundAndSymmetric) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const SurfaceMesh mesh = smooth(cube(seed), 91);
    EXPECT_FALSE(mesh.hasWedges());
    for (std::size_t t = 0; t < 12; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 out = mesh.positions[mesh.triangles[t][k]] - Vec3{.5, .5, .5};
        EXPECT_LT(degreesBetween(at(mesh, t, k), out), 1e-5) << "seed " << seed;
      }
  }
}

TEST(MadeNormals, DoNotDependOnDiagonalsAndAreTheTubesOwn) {
  for (const std::uint32_t sides : {8u, 9u, 31u})
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
      const SurfaceMesh mesh = smooth(tube(sides, seed));
      EXPECT_FALSE(mesh.hasWedges()) << sides << " sides, seed " << seed;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
          Vec3 out = mesh.positions[mesh.triangles[t][k]];
          out.z = 0;
          EXPECT_LT(norm(at(mesh, t, k) - out / norm(out)), 1e-6) << sides << " sides, seed " << seed;
        }
    }
}

TEST(MadeNormals, AreHardFromTheAngleOn) {
  // The sides of a prism of eight are 45 degrees apart, but for the rounding to floats.
  EXPECT_FALSE(smooth(tube(8), 45).hasWedges());
  EXPECT_EQ(smooth(tube(8), 44.9).wedgeCount, 32u);
}

TEST(MadeNormals, GoOnAcrossVerticesAtOnePlace) {
  // Every face has vertices of its own, as behind a seam of texture coordinates.
  SurfaceMesh whole = tube(12), parts;
  for (const auto& triangle : whole.triangles) {
    const auto first = std::uint32_t(parts.positions.size());
    for (const std::uint32_t v : triangle) parts.positions.push_back(whole.positions[v]);
    parts.triangles.push_back({first, first + 1, first + 2});
  }
  whole = smooth(whole);
  parts = smooth(parts);
  for (std::size_t t = 0; t < whole.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(norm(at(whole, t, k) - at(parts, t, k)), 1e-6);
}

TEST(MadeNormals, OfFansThatMeetInAPointAreApart) {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0.5}, {0, -1, 0.5}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  mesh = smooth(mesh, 180);
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(degreesBetween(at(mesh, t, k), faceNormal(mesh, t)), 1e-4);
}

TEST(MadeNormals, OfSheetsWithTwoSidesPointAwayOnEach) {
  SurfaceMesh sheet = tube(16), both = sheet;
  for (const auto& [a, b, c] : sheet.triangles) both.triangles.push_back({a, c, b});
  sheet = smooth(sheet);
  both = smooth(both);
  const std::size_t n = sheet.triangles.size();
  for (std::size_t t = 0; t < n; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT(norm(at(both, t, k) - at(sheet, t, k)), 1e-6);
      EXPECT_LT(norm(at(both, n + t, k) + at(sheet, t, k == 0 ? 0 : 3 - k)), 1e-6);
    }
}

TEST(MadeNormals, OfDoubleFacesAreThoseOfOne) {
  SurfaceMesh once = tube(16), twice = once;
  twice.triangles.insert(twice.triangles.end(), once.triangles.begin(), once.triangles.end());
  once = smooth(once);
  twice = smooth(twice);
  for (std::size_t t = 0; t < once.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(norm(at(twice, t, k) - at(once, t, k)), 1e-6);
}

TEST(MadeNormals, OfFacesWithoutAreaAreThoseAround) {
  // A vertex in the middle of an edge, on the other side a triangle without area and one of nothing at all.
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {1, 0, 0}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {0, 4, 1}, {0, 3, 4}, {4, 3, 1}, {3, 3, 3}};
  mesh = smooth(mesh, 10);
  EXPECT_FALSE(mesh.hasWedges());
  for (std::size_t t = 0; t < 5; ++t)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(norm(at(mesh, t, k) - Vec3{0, 0, 1}), 1e-6);
  EXPECT_EQ(numbersOf(mesh.vertexAttributes[0], 5), (Vec3{0, 0, 1})) << "a vertex without a face";
}

TEST(MadeNormals, OfMirroredPlacesAreMirrored) {
  SurfaceMesh mesh = tube(10), mirrored = mesh;
  for (Vec3& p : mirrored.positions) p.x = -p.x;
  for (auto& t : mirrored.triangles) std::swap(t[1], t[2]);
  mesh = smooth(mesh);
  mirrored = smooth(mirrored);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 n = at(mesh, t, 0), m = at(mirrored, t, 0);
    EXPECT_LT(norm(m - Vec3{-n.x, n.y, n.z}), 1e-6);
  }
}

TEST(MadeNormals, OfFacesThatAreTurnedAgainstEachOtherAreTheirOwn) {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 2}};
  mesh = smooth(mesh, 180);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(at(mesh, 0, k), (Vec3{0, 0, 1}));
    EXPECT_EQ(at(mesh, 1, k), (Vec3{0, 0, -1}));
  }
}

TEST(MadeNormals, StayHardWhereTheFilesAre) {
  // A tube whose file has an edge from ring to ring, of less than the crease angle.
  SurfaceMesh mesh = smooth(tube(16));
  moveToWedges(mesh);
  SurfaceMesh plain = tube(16);
  Attribute& normals = mesh.wedgeAttributes[0];
  const Attribute before = normals;
  const auto edge = [](std::uint32_t v) { return v < 2; };
  mesh.wedgeCount += 2;
  for (const double turn : {0.2, 0.2}) {
    const std::array<double, 3> n{std::cos(turn), std::sin(turn), 0};
    normals.append(std::span<const double>(n));
  }
  for (std::size_t t = 0; t < 2; ++t)  // the quad behind the edge
    for (std::size_t k = 0; k < 3; ++k)
      if (edge(mesh.triangles[t][k])) mesh.wedges[t][k] = 32 + mesh.triangles[t][k];
  ASSERT_TRUE(mesh.validate());
  const SurfaceMesh made = smooth(mesh);
  for (std::size_t t = 0; t < made.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!edge(made.triangles[t][k])) continue;
      EXPECT_LT(degreesBetween(at(made, t, k), faceNormal(made, t)), 1e-3);
    }
}

TEST(MadeNormals, OfAFileWithFlatOnesBecomeSmooth) {
  SurfaceMesh mesh = tube(16);
  ASSERT_TRUE(makeNormals(mesh, {NormalsKind::flat}));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(norm(at(mesh, t, k) - faceNormal(mesh, t)), 1e-6);
  EXPECT_FALSE(smooth(mesh).hasWedges());
}

TEST(MadeNormals, LeaveOtherAttributesAndTakeTangentsOut) {
  SurfaceMesh mesh = cube();
  Attribute number{.name = "number", .type = ScalarType::int32};
  Attribute tangent{.name = std::string(kTangentName), .meaning = AttributeMeaning::tangent, .components = 4};
  mesh.wedges = mesh.triangles;
  mesh.wedgeCount = 8;
  for (double v = 0; v < 8; ++v) {
    const std::array<double, 1> one{v};
    const std::array<double, 4> four{1, 0, 0, 1};
    number.append(std::span<const double>(one));
    tangent.append(std::span<const double>(four));
  }
  mesh.wedgeAttributes = {number};
  mesh.vertexAttributes = {tangent};
  const auto made = makeNormals(mesh, {NormalsKind::smooth});
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->leavesOutTangents);
  ASSERT_TRUE(mesh.validate());
  const auto* list = &mesh.vertexAttributes;
  auto found = std::ranges::find(*list, "number", &Attribute::name);
  ASSERT_NE(found, list->end());
  for (std::size_t v = 0; v < 8; ++v) EXPECT_EQ(found->numbers(v)[0], double(v));
  EXPECT_EQ(std::ranges::find(*list, std::string(kTangentName), &Attribute::name), list->end());
}

TEST(MadeNormals, RefuseAnAngleThatIsNone) {
  SurfaceMesh mesh = cube();
  for (const double angle : {-1.0, 181.0, std::nan("")}) {
    const auto made = makeNormals(mesh, {NormalsKind::smooth, angle});
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::usage);
  }
}

}  // namespace
}  // namespace arete
