// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/repair/repair.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "surface/shapes.h"

namespace arete {
namespace {

TEST(Repair, TwiceChangesNothingMore) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
    for (const bool splits : {false, true}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << (splits ? ", sheets split" : ""));
      const TriangleMesh mesh = shapes::anything(seed, 6 + seed % 20, 5 + seed % 60, seed % 3 == 0 ? 3 : 50);
      const RepairOptions options{.splitsSheets = splits, .mostHoleEdges = seed % 4 == 0 ? 6u : 0u};
      const auto once = repair(mesh, options);
      ASSERT_TRUE(once);
      const auto twice = repair(once->mesh, options);
      ASSERT_TRUE(twice);
      EXPECT_TRUE(twice->counts.isNothing());
      EXPECT_EQ(twice->mesh.triangles, once->mesh.triangles);
      EXPECT_EQ(once->diagnosis.duplicateTriangles.count, 0u);
      EXPECT_EQ(once->diagnosis.unusedVertices.count, 0u);
    }
}

TEST(Repair, MovesNoVertexAndKnowsWhereEachComesFrom) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh mesh = shapes::anything(seed, 20, 40, 4);
    const auto repaired = repair(mesh, {.splitsSheets = true});
    ASSERT_TRUE(repaired);
    ASSERT_EQ(repaired->vertexOf.size(), repaired->mesh.positions.size());
    ASSERT_EQ(repaired->triangleOf.size(), repaired->mesh.triangles.size());
    for (std::size_t v = 0; v < repaired->vertexOf.size(); ++v)
      EXPECT_EQ(repaired->mesh.positions[v], mesh.positions[repaired->vertexOf[v]]);
    for (const std::uint32_t t : repaired->triangleOf) EXPECT_LT(t, mesh.triangles.size());
  }
}

TEST(Repair, MakesTurnsAgreeByTurningTheFewer) {
  TriangleMesh mesh = shapes::sheet(6, 5, true, true);
  const auto whole = mesh.triangles;
  for (const std::size_t t : {3u, 17u, 30u, 0u}) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  const auto repaired = repair(mesh);
  ASSERT_TRUE(repaired);
  EXPECT_EQ(repaired->counts.turnedTriangles, 4u);
  EXPECT_EQ(repaired->mesh.triangles, whole);
}

TEST(Repair, LeavesWhatIsNotOrientable) {
  const TriangleMesh strip = shapes::sheet(9, 2, true, false, true);
  const auto repaired = repair(strip);
  ASSERT_TRUE(repaired);
  EXPECT_TRUE(repaired->counts.isNothing());
  EXPECT_EQ(repaired->diagnosis.nonOrientable.count, 1u);
}

/// The boundary modulo 2 of a mesh as a set of undirected edges between positions, the edges cut at all
/// positions of vertices that lie on them. On whole coordinates, exactly.
std::set<std::pair<std::array<double, 3>, std::array<double, 3>>> boundary(const TriangleMesh& mesh,
                                                                           const std::vector<Vec3>& cuts) {
  std::set<std::pair<std::array<double, 3>, std::array<double, 3>>> odd;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = mesh.positions[t[i]], b = mesh.positions[t[(i + 1) % 3]];
      if (a == b) continue;
      std::map<double, Vec3> on = {{0, a}, {1, b}};
      for (const Vec3& p : cuts) {
        const Vec3 off = cross(p - a, b - a);
        const double s = dot(p - a, b - a) / dot(b - a, b - a);
        if (dot(off, off) == 0 && s > 0 && s < 1) on[s] = p;
      }
      for (auto from = on.begin(), to = std::next(from); to != on.end(); ++from, ++to) {
        std::array<double, 3> u{from->second.x, from->second.y, from->second.z},
            w{to->second.x, to->second.y, to->second.z};
        if (w < u) std::swap(u, w);
        if (const auto [it, isNew] = odd.insert({u, w}); !isNew) odd.erase(it);
      }
    }
  return odd;
}

TEST(Repair, OpensNothingAndClosesNothingAsASetOfPoints) {
  // Duplicates change the boundary modulo 2, so there are none here; degenerate triangles and T-junctions
  // abound.
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    TriangleMesh mesh = shapes::anything(seed, 25, 20, 3);
    std::set<std::set<std::uint32_t>> seen;
    std::erase_if(mesh.triangles, [&](const auto& t) { return !seen.insert({t[0], t[1], t[2]}).second; });
    for (const bool splits : {false, true}) {
      const auto repaired = repair(mesh, {.splitsSheets = splits});
      ASSERT_TRUE(repaired);
      if (repaired->counts.duplicateTriangles == 0) {
        EXPECT_EQ(boundary(mesh, mesh.positions), boundary(repaired->mesh, mesh.positions));
      }
    }
  }
}

}  // namespace
}  // namespace arete
