// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle computes with rational numbers and knows nothing of cases: it clips one triangle by the other,
// as polygons in space, and looks whether anything is left besides the vertices and the edge that they share.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
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

}  // namespace
}  // namespace arete::diagnosis
