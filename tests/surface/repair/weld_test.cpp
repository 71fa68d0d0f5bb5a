// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/repair/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "surface/diagnosis/diagnosis.h"
#include "surface/shapes.h"

namespace arete {
namespace {

/// Every triangle with corners of its own, in some order, each position moved by at most `noise` in each
/// coordinate.
TriangleMesh soupOf(const TriangleMesh& mesh, std::uint64_t seed, double noise = 0) {
  std::mt19937_64 random(seed);
  std::vector<shapes::Triangle> triangles(mesh.triangles.begin(), mesh.triangles.end());
  std::ranges::shuffle(triangles, random);
  const auto off = [&] { return noise * (double(random() >> 11) * 0x1p-52 - 1); };
  TriangleMesh soup;
  for (const auto& t : triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    soup.triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t v : t) soup.positions.push_back(mesh.positions[v] + Vec3{off(), off(), off()});
  }
  return soup;
}

TEST(Weld, MakesOfASoupTheSurfaceThatItWas) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const TriangleMesh& whole :
         {shapes::sheet(7, 5), shapes::sheet(8, 6, true), shapes::sheet(9, 7, true, true),
          shapes::tetrahedron(), shapes::sheet(12, 2, true, false, true)}) {
      const auto expected = diagnose(whole);
      for (const double noise : {0.0, 1e-6}) {
        const TriangleMesh soup = soupOf(whole, seed, noise);
        const auto welded = weld(soup, {.distance = noise * 4});
        ASSERT_TRUE(welded);
        const auto found = diagnose(welded->mesh);
        EXPECT_EQ(welded->mesh.positions.size(), whole.positions.size());
        EXPECT_EQ(welded->joinedVertices, soup.positions.size() - whole.positions.size());
        ASSERT_EQ(found->components.size(), 1u);
        EXPECT_EQ(found->components[0].eulerNumber, expected->components[0].eulerNumber);
        EXPECT_EQ(found->components[0].genus, expected->components[0].genus);
        EXPECT_EQ(found->borders.size(), expected->borders.size());
        EXPECT_EQ(found->nonManifoldEdges.count, 0u);
        EXPECT_LE(welded->farthestMove, noise * 4);
        for (std::size_t v = 0; v < welded->vertexOf.size(); ++v)
          EXPECT_EQ(welded->mesh.positions[v], soup.positions[welded->vertexOf[v]]);
      }
    }
}

/// A cube's surface with outward turns.
TriangleMesh cube(const Vec3& at) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(at + Vec3{double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(Weld, LeavesPartsThatOnlyTouchApart) {
  for (const Vec3& second : {Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{1, 0, 0}}) {  // an edge, a vertex, a face
    TriangleMesh two = cube({});
    shapes::append(two, cube(second));
    const auto kept = weld(two);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->joinedVertices, 0u) << "whole parts have no borders to join";
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " at " << second.x << second.y << second.z);
      const auto welded = weld(soupOf(two, seed));
      ASSERT_TRUE(welded);
      const auto found = diagnose(welded->mesh);
      EXPECT_EQ(found->components.size(), 2u);
      EXPECT_TRUE(found->borders.empty());
      EXPECT_EQ(found->nonManifoldEdges.count + found->nonManifoldVertices.count, 0u);
      EXPECT_EQ(welded->mesh.positions.size(), 16u);
    }
  }
}

TEST(Weld, KeepsTheTwoSidesOfASheetApart) {
  TriangleMesh sheet = shapes::sheet(5, 5);
  const auto count = sheet.triangles.size();
  for (std::size_t t = 0; t < count; ++t)
    sheet.triangles.push_back({sheet.triangles[t][0], sheet.triangles[t][2], sheet.triangles[t][1]});
  const auto welded = weld(soupOf(sheet, 1));
  ASSERT_TRUE(welded);
  const auto found = diagnose(welded->mesh);
  EXPECT_EQ(found->components.size(), 1u) << "front and back meet along the outline only";
  EXPECT_TRUE(found->borders.empty());
  EXPECT_EQ(welded->mesh.positions.size(), 36u + 16u) << "inner vertices are two";
  EXPECT_EQ(found->nonManifoldEdges.count, 2u) << "the two inner edges that have both ends on the outline";
}

TEST(Weld, JoinsNothingAcrossParts) {
  const TriangleMesh whole = shapes::sheet(4, 4);
  const TriangleMesh soup = soupOf(whole, 3);
  std::vector<std::uint32_t> partOf;
  for (const auto& t : soup.triangles)
    partOf.push_back(soup.positions[t[0]].x + soup.positions[t[1]].x < 4 ? 0 : 1);
  const auto welded = weld(soup, {.partOf = partOf});
  ASSERT_TRUE(welded);
  const auto found = diagnose(welded->mesh);
  for (std::size_t a = 0; a < partOf.size(); ++a)
    for (std::size_t b = 0; b < partOf.size(); ++b)
      EXPECT_TRUE(partOf[a] == partOf[b] || found->componentOf[a] != found->componentOf[b]);
}

TEST(Weld, DoesNotFoldAWallThinnerThanTheDistance) {
  // A strip of width 0.01: its two long borders are nearer than the distance.
  TriangleMesh strip = shapes::sheet(40, 1);
  for (Vec3& p : strip.positions) p.y *= 0.01;
  const auto welded = weld(strip, {.distance = 0.02});
  ASSERT_TRUE(welded);
  EXPECT_EQ(welded->mesh.triangles, strip.triangles);
  // A shell of that thickness, open at one end, as a soup.
  TriangleMesh shell = shapes::sheet(24, 6, true);
  TriangleMesh inner = shell;
  for (Vec3& p : inner.positions) p = {p.x * 0.99, p.y * 0.99, p.z};
  for (auto& t : inner.triangles) std::swap(t[1], t[2]);
  shapes::append(shell, inner);
  const auto both = weld(soupOf(shell, 2), {.distance = 0.02});
  ASSERT_TRUE(both);
  const auto found = diagnose(both->mesh);
  EXPECT_EQ(found->triangles, shell.triangles.size());
  EXPECT_EQ(found->nonManifoldEdges.count, 0u);
  EXPECT_EQ(found->duplicateTriangles.count + found->doubleSided.count + found->degenerateTriangles.count,
            0u);
}

TEST(Weld, RefusesWhatIsNoDistance) {
  for (const double d :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(weld(shapes::tetrahedron(), {.distance = d}).error().culprit, "distance");
}

}  // namespace
}  // namespace arete
