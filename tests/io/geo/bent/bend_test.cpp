// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/bent/bend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace arete {
namespace {

Georeference wgs84() {
  return georeferenceOf("EPSG:4326", "m").value();
}

/// A grid of triangles over degrees, with heights of their own.
TriangleMesh grid(double west, double south, double step, int columns, int rows, unsigned seed,
                  double relief) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(0, relief);
  TriangleMesh mesh;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      mesh.positions.push_back({west + c * step, south + r * step, height(random)});
  const auto at = [&](int c, int r) { return static_cast<std::uint32_t>(r * columns + c); };
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < columns; ++c) {
      mesh.triangles.push_back({at(c, r), at(c + 1, r), at(c + 1, r + 1)});
      mesh.triangles.push_back({at(c, r), at(c + 1, r + 1), at(c, r + 1)});
    }
  return mesh;
}

BentMesh bent(const TriangleMesh& mesh, const PlaceTarget& target, double tolerance) {
  const PlaceMap map = PlaceMap::of(wgs84(), target, mesh.positions, mesh.positions[0]).value();
  auto result = bendMesh(mesh, {}, map, {.tolerance = tolerance});
  EXPECT_TRUE(result) << result.error().describe();
  return result ? std::move(*result) : BentMesh{};
}

/// Every edge has two triangles, in both directions, or is on the rim; the rim has as many ends as edges.
void expectConforming(const TriangleMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(sides.emplace(t[k], t[(k + 1) % 3]).second) << "a side twice";
  std::map<std::uint32_t, int> ends;
  for (const auto& [a, b] : sides)
    if (!sides.contains({b, a})) {
      ++ends[a];
      --ends[b];
    }
  for (const auto& [v, sum] : ends) EXPECT_EQ(sum, 0) << "the rim is open at " << v;
}

TEST(Bend, SplitsUntilATenthOfTheToleranceIsKept) {
  for (const double tolerance : {5.0, 20.0, 100.0})
    for (const PlaceTarget& target : {PlaceTarget{.isMetric = true}, PlaceTarget{.crs = "utm"}}) {
      SCOPED_TRACE(tolerance);
      const TriangleMesh mesh = grid(7, 45, 0.25, 5, 4, 7, 500);
      const BentMesh result = bent(mesh, target, tolerance);
      EXPECT_LE(result.added, 0.1 * tolerance);
      EXPECT_TRUE(result.addedTriangles > 0 || tolerance > 5);
      EXPECT_EQ(result.mesh.triangles.size(), mesh.triangles.size() + result.addedTriangles);
      EXPECT_EQ(result.mesh.positions.size(), mesh.positions.size() + result.addedVertices);
      EXPECT_EQ(result.errors.size(), result.mesh.triangles.size());
      expectConforming(result.mesh);
      double area = 0, before = 0;
      const auto areaOf = [](const TriangleMesh& m, const std::array<std::uint32_t, 3>& t) {
        const Vec3 &a = m.positions[t[0]], &b = m.positions[t[1]], &c = m.positions[t[2]];
        return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
      };
      for (const auto& t : result.source.triangles) {
        EXPECT_GT(areaOf(result.source, t), 0);
        EXPECT_GT(areaOf(result.mesh, t), 0) << "folded over";
        area += areaOf(result.source, t);
      }
      for (const auto& t : mesh.triangles) before += areaOf(mesh, t);
      EXPECT_NEAR(area, before, 1e-9);
    }
}

// The bound is for every point of a triangle: random points are led by the map, and the straight triangle
// that is there is looked up by brute force.
TEST(Bend, BoundsWhatBendingAddsAtRandomPoints) {
  const TriangleMesh mesh = grid(10, 68, 0.4, 4, 4, 3, 800);
  const PlaceMap map = PlaceMap::of(wgs84(), {.crs = "utm"}, mesh.positions, mesh.positions[0]).value();
  const BentMesh result = bendMesh(mesh, {}, map, {.tolerance = 30}).value();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  double largest = 0;
  for (int i = 0; i < 400; ++i) {
    const std::size_t t = random() % result.source.triangles.size();
    double u = part(random), v = part(random);
    if (u + v > 1) std::tie(u, v) = std::pair(1 - u, 1 - v);
    const auto corner = [&](int k) { return result.source.positions[result.source.triangles[t][k]]; };
    const Vec3 place = map(corner(0) + u * (corner(1) - corner(0)) + v * (corner(2) - corner(0)));
    for (const auto& c : result.mesh.triangles) {
      const Vec3 &a = result.mesh.positions[c[0]], &b = result.mesh.positions[c[1]],
                 &d = result.mesh.positions[c[2]];
      const double area = (b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x);
      const double s = ((place.x - a.x) * (d.y - a.y) - (place.y - a.y) * (d.x - a.x)) / area;
      const double r = ((b.x - a.x) * (place.y - a.y) - (b.y - a.y) * (place.x - a.x)) / area;
      if (s < 0 || r < 0 || s + r > 1) continue;
      const double off = std::abs(a.z + s * (b.z - a.z) + r * (d.z - a.z) - place.z);
      EXPECT_LE(off, result.errors[t] + 1e-9) << "triangle " << t;
      largest = std::max(largest, off);
    }
  }
  EXPECT_GT(largest, 0.02);  // something bends
}

TEST(Bend, LeavesAMapWithStraightAxesAlone) {
  const Georeference utm = georeferenceOf("EPSG:32632", "m").value();
  TriangleMesh mesh = grid(0, 0, 1, 3, 3, 1, 10);
  for (Vec3& p : mesh.positions) p = {500'000 + 1000 * p.x, 5'000'000 + 1000 * p.y, p.z};
  const PlaceMap map = PlaceMap::of(utm, {.isMetric = true}, mesh.positions, mesh.positions[4]).value();
  EXPECT_TRUE(map.isLinear());
  const BentMesh result = bendMesh(mesh, {}, map, {.tolerance = 1}).value();
  EXPECT_EQ(result.addedVertices, 0U);
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
  EXPECT_DOUBLE_EQ(result.mesh.positions[5].x, 1000);
}

TEST(Bend, KeepsALongitudeInOnePieceAcrossTheAntimeridian) {
  const TriangleMesh mesh = grid(178.5, -18, 0.5, 8, 4, 2, 300);
  for (const char* crs : {"EPSG:3857", "EPSG:4269", "EPSG:3832", "EPSG:32701"}) {
    SCOPED_TRACE(crs);
    const BentMesh result = bent(mesh, {.crs = crs}, 10);
    double widest = 0, all = 0;
    const auto [west, east] = std::ranges::minmax_element(result.mesh.positions, {}, &Vec3::x);
    all = east->x - west->x;
    for (const auto& t : result.mesh.triangles)
      for (int k = 0; k < 3; ++k)
        widest = std::max(widest,
                          std::abs(result.mesh.positions[t[k]].x - result.mesh.positions[t[(k + 1) % 3]].x));
    EXPECT_LT(widest, all / 4);
  }
}

TEST(Bend, RefusesBySeamAndPlaceWhatATargetCannotHold) {
  const auto refusal = [](const TriangleMesh& mesh, const PlaceTarget& target) {
    const auto map = PlaceMap::of(wgs84(), target, mesh.positions, mesh.positions[0]);
    if (!map) return map.error();
    const auto result = bendMesh(mesh, {}, *map, {.tolerance = 10});
    return result ? Error{} : result.error();
  };
  // Mercator has no pole.
  const Error pole = refusal(grid(0, 80, 5, 3, 3, 1, 10), {.crs = "EPSG:3857"});
  EXPECT_EQ(pole.culprit, "toCrs EPSG:3857");
  EXPECT_NE(pole.message.find("near"), std::string::npos) << pole.message;
  const Error unknown = refusal(grid(0, 0, 1, 3, 3, 1, 10), {.crs = "EPSG:999999"});
  EXPECT_EQ(unknown.code, ErrorCode::usage);
  EXPECT_EQ(unknown.culprit, "toCrs EPSG:999999");
  EXPECT_EQ(refusal(grid(0, 0, 1, 3, 3, 1, 10), {.crs = "EPSG:4326+5773"}).code, ErrorCode::usage);
  EXPECT_EQ(refusal(grid(0, 0, 1, 3, 3, 1, 10), {.crs = "EPSG:4978"}).culprit, "toCrs EPSG:4978");
  EXPECT_EQ(refusal(grid(0, 0, 1, 3, 3, 1, 10), {.crs = "utm", .isMetric = true}).code, ErrorCode::usage);
}

TEST(Bend, DoesNotDependOnTheOrderOfTriangles) {
  TriangleMesh mesh = grid(7, 45, 0.5, 4, 4, 11, 500);
  const BentMesh first = bent(mesh, {.isMetric = true}, 5);
  std::ranges::reverse(mesh.triangles);
  const BentMesh second = bent(mesh, {.isMetric = true}, 5);
  EXPECT_EQ(first.mesh.positions, second.mesh.positions);
  EXPECT_EQ(first.mesh.triangles.size(), second.mesh.triangles.size());
}

}  // namespace
}  // namespace arete
