// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/simplified_root.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <span>
#include <vector>

#include "engine/grid_meshes.h"

namespace arete {
namespace {

/// Removes some vertices, one after the other; `firstId` counts the ids of the new triangles.
void removeSome(LiveMesh& mesh, std::uint32_t& firstId, unsigned seed) {
  for (const VertexId v : test::someIndependent(mesh, true, 20, seed)) {
    Star star;
    ASSERT_TRUE(star.gather(mesh, v, kMaxHoleCorners));
    const HoleTriangulation floor = test::fan(star.linkSize);
    std::array<Seam, kMaxHoleCorners> all;
    const std::span<Seam> seams(all.data(), std::size_t(star.linkSize));
    refill(mesh, star, floor, FloorJoins(floor), RecorderId(firstId), RemovalId(0), seams);
    for (const Seam& seam : seams) sewAlone(mesh, seam);
    mesh.vertexHalfedge[v] = HalfedgeId();
    firstId += static_cast<std::uint32_t>(floor.size);
  }
}

TEST(RootOf, HasTheLiveTrianglesBySlotAndTheirVerticesById) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    std::vector<VertexId> pinched;
    LiveMesh mesh = LiveMesh::fromTriangles(test::someTriangles(9, 14, 0, seed), 9 * 14, pinched);
    auto firstId = static_cast<std::uint32_t>(mesh.triangles.size());
    for (const unsigned round : {1u, 2u, 3u}) removeSome(mesh, firstId, seed + round);

    const SimplifiedRoot root = rootOf(mesh, 17);
    EXPECT_EQ(root.levels, 17u);
    std::set<VertexId> vertices;
    std::size_t next = 0, dead = 0;
    for (const LiveMesh::Triangle& t : mesh.triangles) {
      if (t.isDead()) {
        ++dead;
        continue;
      }
      ASSERT_LT(next, root.triangles.size());
      EXPECT_EQ(root.triangles[next].id, t.recorderId);
      EXPECT_EQ(root.triangles[next].corners, t.corners);
      vertices.insert(t.corners.begin(), t.corners.end());
      ++next;
    }
    EXPECT_EQ(next, root.triangles.size());
    EXPECT_GT(dead, 40u);
    EXPECT_LT(vertices.size(), mesh.vertexCount());
    EXPECT_EQ(root.vertices, std::vector<VertexId>(vertices.begin(), vertices.end()));
  }
}

}  // namespace
}  // namespace arete
