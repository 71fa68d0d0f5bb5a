// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle computes with rational numbers and knows nothing of cases: it clips one triangle by the other,
// as polygons in space, and looks whether anything is left besides the vertices and the edge that they share.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "surface/diagnosis/parts.h"
#include "surface/shapes.h"

namespace arete::diagnosis {
namespace {

using Rational = mpq_class;
using Point = std::array<Rational, 3>;

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Rational dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The part of a convex polygon (a point, a segment or more) where a linear function is not negative.
template <class Function>
std::vector<Point> clip(const std::vector<Point>& polygon, const Function& f) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Rational fa = f(a), fb = f(b);
    if (fa >= 0) kept.push_back(a);
    if (polygon.size() > 1 && ((fa > 0 && fb < 0) || (fa < 0 && fb > 0))) {
      const Rational t = fa / (fa - fb);
      kept.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
    }
  }
  std::vector<Point> different;
  for (const Point& p : kept)
    if (std::ranges::find(different, p) == different.end()) different.push_back(p);
  return different;
}

/// The corners of what two triangles have in common.
std::vector<Point> commonPart(const std::array<Point, 3>& s, const std::array<Point, 3>& t) {
  const Point normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  std::vector<Point> part(s.begin(), s.end());
  part = clip(part, [&](const Point& p) { return Rational(dot(normal, minus(p, t[0]))); });
  part = clip(part, [&](const Point& p) { return Rational(-dot(normal, minus(p, t[0]))); });
  for (int i = 0; i < 3; ++i) {
    const Point inwards = cross(normal, minus(t[(i + 1) % 3], t[i]));
    part = clip(part, [&](const Point& p) { return Rational(dot(inwards, minus(p, t[i]))); });
  }
  return part;
}

bool doMeet(const TriangleMesh& mesh, const Triangle& s, const Triangle& t) {
  const auto exact = [&](std::uint32_t v) {
    const Vec3& p = mesh.positions[v];
    return Point{Rational(p.x), Rational(p.y), Rational(p.z)};
  };
  const auto part =
      commonPart({exact(s[0]), exact(s[1]), exact(s[2])}, {exact(t[0]), exact(t[1]), exact(t[2])});
  std::vector<Point> shared;
  for (const std::uint32_t v : s)
    if (std::ranges::find(t, v) != t.end()) shared.push_back(exact(v));
  if (shared.size() == 3) return true;
  // The shared part is convex: a point or a segment. All corners of the common part must be among its ends.
  for (const Point& p : part)
    if (std::ranges::find(shared, p) == shared.end()) return true;
  return false;
}

void expectPairsOfTheOracle(const TriangleMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
  const auto isDegenerate = [&](const Triangle& t) {
    return areCollinear(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
  };
  for (std::uint32_t a = 0; a < mesh.triangles.size(); ++a)
    for (std::uint32_t b = a + 1; b < mesh.triangles.size(); ++b)
      if (!isDegenerate(mesh.triangles[a]) && !isDegenerate(mesh.triangles[b]) &&
          doMeet(mesh, mesh.triangles[a], mesh.triangles[b]))
        expected.push_back({a, b});
  const auto found = findSelfIntersections(mesh, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, expected);
}

TEST(SelfIntersections, AreThoseOfRationalClippingOnAThousandMeshes) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    SCOPED_TRACE(seed);
    // Few coordinates give coplanar and touching triangles, many give general ones.
    expectPairsOfTheOracle(shapes::anything(seed, 8, 7, seed % 3 == 0 ? 2 : seed % 3 == 1 ? 4 : 1000));
  }
}

TEST(SelfIntersections, AGoodSurfaceHasNone) {
  for (const TriangleMesh& mesh : {shapes::sheet(20, 10), shapes::sheet(20, 10, true, true),
                                   shapes::tetrahedron(), shapes::sheet(30, 2, true, false, true)})
    EXPECT_TRUE(findSelfIntersections(mesh, {})->empty());
}

TEST(SelfIntersections, OfTetrahedraInEachOtherAreFound) {
  TriangleMesh mesh = shapes::tetrahedron();
  shapes::append(mesh, shapes::tetrahedron({0.1, 0.1, 0.1}));
  EXPECT_FALSE(findSelfIntersections(mesh, {})->empty());
  expectPairsOfTheOracle(mesh);
}

TEST(SelfIntersections, CanBeInterrupted) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  EXPECT_FALSE(findSelfIntersections(shapes::anything(1, 30, 60, 5), context));
}

/// Triangles at one vertex, some of them twice, in several turns or with vertices of their own.
TriangleMesh burr(std::uint64_t seed, std::uint32_t triangles, int coordinates) {
  std::mt19937_64 random(seed);
  const auto coordinate = [&] { return double(random() % std::uint64_t(coordinates)) - coordinates / 2; };
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}};
  for (std::uint32_t v = 0; v < triangles / 2; ++v)
    mesh.positions.push_back({coordinate(), coordinate(), coordinate()});
  const auto vertex = [&] { return std::uint32_t(1 + random() % (triangles / 2)); };
  for (std::uint32_t t = 0; t < triangles; ++t) {
    mesh.triangles.push_back({0, vertex(), vertex()});
    if (t % 10 == 3) mesh.triangles.push_back({mesh.triangles.back()[1], 0, mesh.triangles.back()[2]});
    if (t % 10 == 6)
      for (int copy = 0; copy < 2; ++copy) {
        Triangle own{};
        for (std::size_t i = 0; i < 3; ++i) {
          own[i] = std::uint32_t(mesh.positions.size());
          mesh.positions.push_back(mesh.positions[mesh.triangles[t][i]]);
        }
        mesh.triangles.push_back(own);
      }
  }
  return mesh;
}

TEST(SelfIntersections, AtAVertexOfManyTrianglesAreThoseOfRationalClipping) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE(seed);
    expectPairsOfTheOracle(burr(seed, 132, seed % 2 == 0 ? 7 : 1000));
  }
}

TEST(SelfIntersections, AreCountedAndTheFirstListed) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh mesh = seed % 20 == 0
                                  ? burr(seed, 140, 9)
                                  : shapes::anything(seed, 6 + seed % 9, 5 + seed % 30, 2 + seed % 4);
    const auto all = findSelfIntersections(mesh, {});
    for (const std::size_t most : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{50}}) {
      const auto found = countSelfIntersections(mesh, most, {});
      ASSERT_TRUE(found);
      EXPECT_EQ(found->count, all->size());
      ASSERT_EQ(found->pairs.size(), std::min(most, all->size()));
      EXPECT_TRUE(std::equal(found->pairs.begin(), found->pairs.end(), all->begin()));
    }
  }
}

TEST(SelfIntersections, OfManyTrianglesInOnePlaceAreNotListed) {
  // The square of their number would take hours and all memory.
  constexpr std::uint64_t kMany = 300'000;
  TriangleMesh same;
  same.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  same.triangles.assign(kMany, {0, 1, 2});
  TriangleMesh apart;
  for (std::uint32_t t = 0; t < kMany; ++t) {
    apart.positions.insert(apart.positions.end(), same.positions.begin(), same.positions.end());
    apart.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  for (const TriangleMesh& mesh : {same, apart}) {
    const auto found = countSelfIntersections(mesh, 10, {});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->count, kMany * (kMany - 1) / 2);
    for (std::uint32_t i = 0; i < 10; ++i) EXPECT_EQ(found->pairs[i], std::pair(0u, i + 1));
  }
}

TEST(SelfIntersections, OfAFanOfManyTrianglesAreNone) {
  constexpr std::uint32_t kMany = 100'000;
  for (const double tilt : {0.0, 0.5, 1.0}) {
    TriangleMesh fan;
    for (std::uint32_t i = 0; i < kMany; ++i) {
      const double angle = 2 * 3.14159265358979 * i / kMany;
      const Vec3 p{std::cos(angle), std::sin(angle), 0.01 * std::sin(9 * angle)};
      fan.positions.push_back(
          {p.x, p.y * std::cos(tilt) - p.z * std::sin(tilt), p.y * std::sin(tilt) + p.z * std::cos(tilt)});
      fan.triangles.push_back({i, (i + 1) % kMany, kMany});
    }
    fan.positions.push_back({0, -0.5 * std::sin(tilt), 0.5 * std::cos(tilt)});
    const auto found = countSelfIntersections(fan, 10, {});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->count, 0u);
  }
}

}  // namespace
}  // namespace arete::diagnosis
