// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "surface/repair/repair.h"
#include "surface/shapes.h"

namespace arete {
namespace {

/// Splits an edge of a closed mesh on one side only, at a vertex exactly in its middle, and closes the gap
/// with a triangle of no area.
void addNeedle(TriangleMesh& mesh, std::size_t triangle, std::size_t side) {
  const auto t = mesh.triangles[triangle];
  const std::uint32_t a = t[side], b = t[(side + 1) % 3], d = t[(side + 2) % 3];
  const auto c = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(mesh.positions[a] / 2 + mesh.positions[b] / 2);
  mesh.triangles[triangle] = {a, c, d};
  mesh.triangles.push_back({c, b, d});
  mesh.triangles.push_back({a, b, c});
}

/// A closed surface at whole coordinates, so that the middles of edges are exact: a block of cubes' surface.
TriangleMesh block() {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 8; ++i)
    mesh.positions.push_back({double(i & 1) * 64, double(i >> 1 & 1) * 64, double(i >> 2) * 64});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(Repair, LeavesOutTrianglesOfNoAreaAndOpensNothing) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    TriangleMesh mesh = block();
    for (int i = 0; i < 6; ++i) {
      // Not at a needle: then the vertex in the middle would be double.
      std::size_t t = random() % mesh.triangles.size();
      while (norm(cross(mesh.positions[mesh.triangles[t][1]] - mesh.positions[mesh.triangles[t][0]],
                        mesh.positions[mesh.triangles[t][2]] - mesh.positions[mesh.triangles[t][0]])) == 0)
        t = random() % mesh.triangles.size();
      addNeedle(mesh, t, random() % 3);
    }
    const auto before = diagnose(mesh);
    ASSERT_TRUE(before && before->borders.empty() && before->degenerateTriangles.count == 6);
    const auto repaired = repair(mesh);
    ASSERT_TRUE(repaired);
    EXPECT_TRUE(repaired->diagnosis.borders.empty());
    EXPECT_EQ(repaired->diagnosis.degenerateTriangles.count + 0u, 0u);
    EXPECT_EQ(repaired->diagnosis.nonManifoldEdges.count, 0u);
    ASSERT_EQ(repaired->diagnosis.components.size(), 1u);
    EXPECT_EQ(repaired->diagnosis.components[0].eulerNumber, 2);
  }
}

TEST(Repair, JoinsTwoVerticesAtOnePositionThatATriangleOfNoAreaLinks) {
  TriangleMesh mesh = shapes::sheet(4, 4);
  // Vertex 12 (the middle) becomes two, 12 and 25, with the triangles of its star shared out and two slivers
  // between.
  const auto copy = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(mesh.positions[12]);
  for (auto& t : mesh.triangles) {
    const bool isBelow = std::ranges::all_of(t, [](std::uint32_t v) { return v / 5 <= 2; });
    if (isBelow) std::ranges::replace(t, 12u, copy);
  }
  mesh.triangles.push_back({11, copy, 12});
  mesh.triangles.push_back({12, copy, 13});
  ASSERT_EQ(diagnose(mesh)->borders.size(), 1u);
  const auto repaired = repair(mesh);
  ASSERT_TRUE(repaired);
  EXPECT_EQ(repaired->counts.joinedVertices, 1u);
  EXPECT_EQ(repaired->counts.degenerateTriangles, 2u);
  EXPECT_EQ(repaired->mesh.positions.size(), 25u);
  EXPECT_EQ(repaired->diagnosis.borders.size(), 1u);
  EXPECT_EQ(repaired->diagnosis.components[0].eulerNumber, 1);
}

TEST(Repair, KeepsSheetsWithTwoSides) {
  TriangleMesh mesh = shapes::sheet(3, 3);
  const auto count = mesh.triangles.size();
  for (std::size_t t = 0; t < count; ++t)
    mesh.triangles.push_back({mesh.triangles[t][0], mesh.triangles[t][2], mesh.triangles[t][1]});
  const auto repaired = repair(mesh);
  ASSERT_TRUE(repaired);
  EXPECT_EQ(repaired->mesh.triangles.size(), 2 * count);
  EXPECT_EQ(repaired->counts.duplicateTriangles, 0u);
}

TEST(Repair, KeepsTheFirstOfEqualTriangles) {
  TriangleMesh mesh = shapes::sheet(3, 3);
  const auto whole = mesh.triangles;
  for (const auto& t : whole) mesh.triangles.push_back({t[1], t[2], t[0]});
  const auto repaired = repair(mesh);
  ASSERT_TRUE(repaired);
  EXPECT_EQ(repaired->mesh.triangles, whole);
  EXPECT_EQ(repaired->counts.duplicateTriangles, whole.size());
}

}  // namespace
}  // namespace arete
