// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "surface/repair/repair.h"
#include "surface/shapes.h"

namespace arete {
namespace {

/// Surfaces of unit cubes at whole places, one vertex for each position.
TriangleMesh cubes(const std::vector<Vec3>& places) {
  TriangleMesh mesh;
  const auto vertex = [&](const Vec3& p) {
    const auto found = std::ranges::find(mesh.positions, p);
    if (found == mesh.positions.end()) mesh.positions.push_back(p);
    return static_cast<std::uint32_t>(std::ranges::find(mesh.positions, p) - mesh.positions.begin());
  };
  constexpr std::array<std::array<int, 3>, 12> kFaces = {{{0, 2, 1},
                                                          {1, 2, 3},
                                                          {4, 5, 6},
                                                          {5, 7, 6},
                                                          {0, 1, 4},
                                                          {1, 5, 4},
                                                          {2, 6, 3},
                                                          {3, 6, 7},
                                                          {0, 4, 2},
                                                          {2, 4, 6},
                                                          {1, 3, 5},
                                                          {3, 7, 5}}};
  for (const Vec3& place : places)
    for (const auto& face : kFaces) {
      shapes::Triangle t{};
      for (std::size_t i = 0; i < 3; ++i)
        t[i] = vertex(place + Vec3{double(face[i] & 1), double(face[i] >> 1 & 1), double(face[i] >> 2)});
      mesh.triangles.push_back(t);
    }
  return mesh;
}

TEST(Repair, TakesCubesThatShareAnEdgeApartIfAsked) {
  const TriangleMesh mesh = cubes({{0, 0, 0}, {1, 1, 0}});
  const auto kept = repair(mesh);
  ASSERT_TRUE(kept);
  EXPECT_TRUE(kept->counts.isNothing());
  EXPECT_EQ(kept->diagnosis.nonManifoldEdges.count, 1u);
  for (const bool isTurned : {false, true}) {
    TriangleMesh source = mesh;
    if (isTurned)
      for (std::size_t t = 12; t < 24; ++t) std::swap(source.triangles[t][0], source.triangles[t][1]);
    const auto split = repair(source, {.splitsSheets = true});
    ASSERT_TRUE(split);
    EXPECT_EQ(split->counts.splitSheetEdges, 1u);
    EXPECT_EQ(split->diagnosis.components.size(), 2u);
    EXPECT_TRUE(split->diagnosis.borders.empty());
    for (const ComponentDiagnosis& c : split->diagnosis.components) EXPECT_EQ(c.genus, 0);
  }
}

TEST(Repair, TakesAChainOfCubesApart) {
  const TriangleMesh mesh =
      cubes({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}, {4, 4, 1}});  // the last touches in a vertex
  const auto split = repair(mesh, {.splitsSheets = true});
  ASSERT_TRUE(split);
  EXPECT_EQ(split->diagnosis.components.size(), 5u);
  EXPECT_TRUE(split->diagnosis.borders.empty());
  EXPECT_EQ(split->diagnosis.nonManifoldEdges.count + split->diagnosis.nonManifoldVertices.count, 0u);
}

TEST(Repair, GivesCubesThatShareAVertexOneEach) {
  const auto repaired = repair(cubes({{0, 0, 0}, {1, 1, 1}}));
  ASSERT_TRUE(repaired);
  EXPECT_EQ(repaired->counts.addedVertices, 1u);
  EXPECT_EQ(repaired->mesh.positions.size(), 16u);
  EXPECT_EQ(repaired->diagnosis.nonManifoldVertices.count, 0u);
  EXPECT_EQ(repaired->vertexOf.back(), 7u) << "the copy knows what it is a copy of";
}

TEST(Repair, AFinOnASheetGetsABorderIfAsked) {
  TriangleMesh mesh = shapes::sheet(4, 4);
  mesh.positions.push_back({2, 2, 3});
  mesh.triangles.push_back({12, 13, 25});
  const auto split = repair(mesh, {.splitsSheets = true});
  ASSERT_TRUE(split);
  EXPECT_EQ(split->diagnosis.nonManifoldEdges.count, 0u);
  EXPECT_EQ(split->diagnosis.components.size(), 2u);
  EXPECT_EQ(split->mesh.triangles.size(), mesh.triangles.size());
}

TEST(Repair, TakesDoubledFacesApart) {
  // Cards of two triangles, and fans of several on one edge, each face twice, in any order and anywhere.
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto number = [&] { return double(random() % 20001) / 1000 - 10; };
    TriangleMesh mesh;
    mesh.positions = {{number(), number(), number()}, {number(), number(), number()}};
    const std::size_t leaves = 2 + seed % 4;
    for (std::uint32_t i = 0; i < leaves; ++i) {
      mesh.positions.push_back({number(), number(), number()});
      mesh.triangles.push_back({0, 1, 2 + i});
      mesh.triangles.push_back({1, 0, 2 + i});
    }
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
    const auto split = repair(mesh, {.splitsSheets = true});
    ASSERT_TRUE(split);
    EXPECT_EQ(split->diagnosis.nonManifoldEdges.count, 0u);
    EXPECT_EQ(split->mesh.triangles.size(), mesh.triangles.size());
    EXPECT_TRUE(split->diagnosis.borders.empty());
  }
}

TEST(Repair, TakesSheetsWithTwoSidesApart) {
  // Each face of a surface twice: a card of many faces, whose inner edges have four.
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto step = [&] { return double(random() % 2001) / 1000 - 1; };
    TriangleMesh mesh = shapes::sheet(3, 3);
    for (Vec3& p : mesh.positions) p = p + Vec3{0.3 * step(), 0.3 * step(), step()};
    const std::size_t faces = mesh.triangles.size();
    for (std::size_t t = 0; t < faces; ++t)
      mesh.triangles.push_back({mesh.triangles[t][1], mesh.triangles[t][0], mesh.triangles[t][2]});
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
    const auto split = repair(mesh, {.splitsSheets = true});
    ASSERT_TRUE(split);
    EXPECT_EQ(split->diagnosis.nonManifoldEdges.count, 0u);
    EXPECT_EQ(split->mesh.triangles.size(), mesh.triangles.size());
  }
}

}  // namespace
}  // namespace arete
