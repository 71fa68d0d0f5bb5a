// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "surface/repair/repair.h"
#include "surface/shapes.h"

namespace arete {
namespace {

TEST(Repair, FillsHolesOfAtMostSoManyEdges) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    TriangleMesh mesh = shapes::sheet(24, 12, true, true);
    std::mt19937_64 random(seed);
    // Without all triangles of one vertex: a hole of six edges.
    const auto gone = static_cast<std::uint32_t>(random() % mesh.positions.size());
    std::erase_if(mesh.triangles, [&](const auto& t) { return std::ranges::find(t, gone) != t.end(); });
    EXPECT_EQ(repair(mesh, {.mostHoleEdges = 5})->counts.filledHoles, 0u);
    const auto filled = repair(mesh, {.mostHoleEdges = 6});
    ASSERT_TRUE(filled);
    EXPECT_EQ(filled->counts.filledHoles, 1u);
    EXPECT_EQ(filled->counts.fillingTriangles, 4u);
    EXPECT_TRUE(filled->diagnosis.borders.empty());
    EXPECT_EQ(filled->diagnosis.turnedEdges.count, 0u);
    EXPECT_EQ(filled->diagnosis.components[0].genus, 1);
    EXPECT_EQ(filled->triangleOf.back(), RepairedMesh::kNone);
  }
}

TEST(Repair, FillsNothingUnasked) {
  EXPECT_TRUE(repair(shapes::sheet(5, 4, true))->counts.isNothing());
}

TEST(Repair, DoesNotPutALidOnASingleTriangle) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(repair(mesh, {.mostHoleEdges = 100})->counts.filledHoles, 0u);
}

}  // namespace
}  // namespace arete
