// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "surface/repair/measured.h"
#include "surface/repair/repair.h"
#include "surface/repair/weld.h"
#include "surface/shapes.h"

namespace arete {
namespace {

TEST(Repair, SplitsLongEdgesWhereOthersEnd) {
  // A coarse row of squares above a fine one: sixteen small edges on each of three long ones.
  TriangleMesh mesh = shapes::sheet(3, 1);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i <= 48; ++i) {
    mesh.positions.push_back({i / 16.0, -1, 0});
    if (i % 16 != 0) mesh.positions.push_back({i / 16.0, 0, 0});
  }
  const auto at = [&](std::uint32_t i, bool isUpper) {
    if (isUpper && i % 16 == 0) return i / 16;
    const std::uint32_t before =
        2 * i - (i + 15) / 16;  // upper vertices at multiples of 16 are the coarse row's
    return first + before + (isUpper ? 1u : 0u);
  };
  for (std::uint32_t i = 0; i < 48; ++i) {
    mesh.triangles.push_back({at(i, false), at(i + 1, false), at(i + 1, true)});
    mesh.triangles.push_back({at(i, false), at(i + 1, true), at(i, true)});
  }
  ASSERT_EQ(diagnose(mesh)->tJunctions.count, 45u);
  const auto repaired = repair(mesh);
  ASSERT_TRUE(repaired);
  EXPECT_EQ(repaired->counts.tJunctions, 45u);
  EXPECT_EQ(repaired->diagnosis.tJunctions.count, 0u);
  EXPECT_EQ(repaired->diagnosis.components.size(), 1u);
  EXPECT_EQ(repaired->diagnosis.borders.size(), 1u);
  for (std::size_t t = 0; t < repaired->mesh.triangles.size(); ++t)
    EXPECT_LT(repaired->triangleOf[t], mesh.triangles.size());
}

TEST(Repair, SplitsAllThreeSidesOfATriangle) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {4, 0, 0},  {0, 4, 0}, {2, 0, 0}, {2, 2, 0},
                    {0, 2, 0}, {2, -2, 0}, {4, 4, 0}, {-2, 2, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 6, 3}, {3, 6, 1}, {1, 7, 4}, {4, 7, 2}, {2, 8, 5}, {5, 8, 0}};
  const auto repaired = repair(mesh);
  ASSERT_TRUE(repaired);
  EXPECT_EQ(repaired->counts.tJunctions, 3u);
  EXPECT_EQ(repaired->diagnosis.borders.size(), 1u);
  EXPECT_EQ(repaired->diagnosis.borders[0].edgeCount, 6u);
  double area = 0;
  for (const auto& t : repaired->mesh.triangles) {
    const Vec3 &a = repaired->mesh.positions[t[0]], &b = repaired->mesh.positions[t[1]],
               &c = repaired->mesh.positions[t[2]];
    area += cross(b - a, c - a).z / 2;
  }
  EXPECT_DOUBLE_EQ(area, 8 + 4 + 8 + 4);
}

/// A cube of n x n squares a side but for its top, of two triangles.
TriangleMesh cubeWithACoarseTop(int n) {
  TriangleMesh mesh = measured::box(n);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return mesh.positions[t[0]].z == 1 && mesh.positions[t[1]].z == 1 && mesh.positions[t[2]].z == 1;
  });
  const auto at = [&](double x, double y) {
    std::uint32_t v = 0;
    while (!(mesh.positions[v] == Vec3{x, y, 1})) ++v;
    return v;
  };
  mesh.triangles.push_back({at(-1, -1), at(1, -1), at(1, 1)});
  mesh.triangles.push_back({at(-1, -1), at(1, 1), at(-1, 1)});
  return mesh;
}

TEST(Repair, SplitsAtTJunctionsWithinTheRoundingOfFloats) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    measured::Random random(seed);
    const double scale = seed % 3 == 0 ? 1 : 20, far = seed % 4 == 0 ? 5000 : 40;
    TriangleMesh mesh = measured::placed(cubeWithACoarseTop(2 + int(seed % 5)), 6 * random.unit(),
                                         6 * random.unit(), scale, {far, 3 * random.unit(), -7});
    const double whole = measured::volume(mesh);
    mesh = measured::asFloats(mesh);
    if (seed % 2 == 0) mesh = weld(measured::soup(mesh))->mesh;
    double largest = 0;
    for (const Vec3& p : mesh.positions)
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const double rounding = std::sqrt(3.0) * largest * 0x1p-24;
    EXPECT_GT(diagnose(mesh, {.rounding = rounding})->tJunctions.count, 0u);
    const auto repaired = repair(mesh, {.rounding = rounding});
    ASSERT_TRUE(repaired);
    EXPECT_EQ(measured::edges(repaired->mesh), measured::EdgesByPosition());
    EXPECT_TRUE(repaired->diagnosis.borders.empty());
    EXPECT_EQ(repaired->diagnosis.tJunctions.count, 0u);
    EXPECT_NEAR(measured::volume(repaired->mesh), whole, 1e-3 * whole);
    EXPECT_TRUE(repair(repaired->mesh, {.rounding = rounding})->counts.isNothing());
  }
}

TEST(Diagnosis, FindsBordersThatAreOneButForRounding) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    measured::Random random(seed);
    // Two halves of a sheet whose common border was rounded twice.
    TriangleMesh right = shapes::sheet(4, 5);
    for (Vec3& p : right.positions) p.x += 3;
    const double rounding = 1e-5;
    TriangleMesh mesh = shapes::sheet(3, 5);
    const auto first = std::uint32_t(mesh.positions.size());
    shapes::append(mesh, right);
    for (std::size_t v = first; v < mesh.positions.size(); ++v)
      mesh.positions[v] = mesh.positions[v] + Vec3{random.unit() * rounding, random.unit() * rounding, 0};
    const auto found = diagnose(mesh, {.selfIntersections = false, .rounding = rounding});
    EXPECT_EQ(found->nearBorders.count, 10u);  // five edges, from both sides
    EXPECT_GT(found->farthestNear, 0);
    EXPECT_LE(found->farthestNear, 2 * rounding * (1 + 1e-8));
    EXPECT_EQ(diagnose(mesh, {.selfIntersections = false})->nearBorders.count, 0u);
    const auto joined = weld(mesh, {.distance = found->farthestNear});
    EXPECT_EQ(joined->joinedEdges, 5u);
  }
}

}  // namespace
}  // namespace arete
