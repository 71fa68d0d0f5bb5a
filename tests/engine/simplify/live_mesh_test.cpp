// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh against searches through all of its triangles: twins, fans, stars, and what removals leave.
#include "engine/simplify/live_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "engine/grid_meshes.h"
#include "engine/ids_of.h"

namespace arete {
namespace {

using test::after;
using test::edgesOf;
using test::expectConsistent;
using test::fan;
using test::idsBelow;
using test::someIndependent;
using test::someTriangles;
using test::Triangles;

TEST(LiveMesh, FindsTwinsAndBordersAsASearchThroughAllTrianglesDoes) {
  for (const unsigned holes : {0u, 10u, 50u})
    for (const unsigned seed : {1u, 2u, 3u}) {
      SCOPED_TRACE(testing::Message() << holes << " % left out, seed " << seed);
      std::vector<VertexId> pinched;
      const LiveMesh mesh = LiveMesh::fromTriangles(someTriangles(13, 9, holes, seed), 13 * 9, pinched);
      expectConsistent(mesh);
      // A vertex is pinched if more than one border half-edge leaves it.
      const auto edges = edgesOf(mesh);
      std::map<VertexId, int> borders;
      for (const auto& [edge, t] : edges)
        if (!edges.contains({edge.second, edge.first})) ++borders[edge.first];
      std::vector<VertexId> expected;
      for (const auto& [v, count] : borders)
        if (count > 1) expected.push_back(v);
      EXPECT_EQ(pinched, expected);
    }
}

TEST(LiveMesh, GathersTheStarOfEveryVertexThatIsNotPinched) {
  std::vector<VertexId> pinched;
  const LiveMesh mesh = LiveMesh::fromTriangles(someTriangles(13, 9, 12, 5), 13 * 9, pinched);
  const auto edges = edgesOf(mesh);
  Star star;
  for (const VertexId v : idsBelow<VertexId>(mesh.vertexCount())) {
    if (!mesh.isInTriangle(v)) {
      EXPECT_FALSE(star.gather(mesh, v, kMaxHoleCorners));
      continue;
    }
    if (std::ranges::find(pinched, v) != pinched.end()) continue;
    ASSERT_TRUE(star.gather(mesh, v, kMaxHoleCorners));
    std::set<VertexId> link;
    int triangles = 0;
    for (const auto& [edge, t] : edges) {
      if (edge.first == v) link.insert(edge.second), ++triangles;
      if (edge.second == v) link.insert(edge.first);
    }
    EXPECT_EQ(std::set<VertexId>(star.linkView().begin(), star.linkView().end()), link);
    EXPECT_EQ(star.triangleCount, triangles);
    EXPECT_EQ(star.linkSize, triangles + (star.isOpen ? 1 : 0));
    for (int i = 0; i < star.triangleCount; ++i) {
      const VertexId from = star.link[i], to = star.link[(i + 1) % star.linkSize];
      EXPECT_EQ(edges.at({from, to}), star.slot(i));
      EXPECT_EQ(mesh.origin(star.rim(i)), from);
      EXPECT_EQ(mesh.origin(star.outgoing[i]), v);
    }
    EXPECT_FALSE(star.gather(mesh, v, star.linkSize - 1)) << "one more than the limit";
    std::vector<VertexId> visited;
    forLink(mesh, v, [&](VertexId u) {
      visited.push_back(u);
      return true;
    });
    EXPECT_EQ(std::set<VertexId>(visited.begin(), visited.end()), link);
  }
}

TEST(LiveMesh, IsConsistentAfterABatchOfRemovalsHoweverItIsSewn) {
  for (const bool isBatch : {false, true})
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
      SCOPED_TRACE(testing::Message() << (isBatch ? "a batch" : "one by one") << ", seed " << seed);
      std::vector<VertexId> pinched;
      LiveMesh mesh = LiveMesh::fromTriangles(someTriangles(12, 8, 0, seed), 12 * 8, pinched);
      const std::size_t before = mesh.triangles.size();
      const std::vector<VertexId> chosen = someIndependent(mesh, false, 6, seed);
      ASSERT_GE(chosen.size(), 2u);
      const RemovalId first(7);
      std::vector<std::vector<Seam>> seams(chosen.size());
      for (std::uint32_t i = 0; i < chosen.size(); ++i) {
        Star star;
        ASSERT_TRUE(star.gather(mesh, chosen[i], kMaxHoleCorners));
        const HoleTriangulation floor = fan(star.linkSize);
        seams[i].resize(std::size_t(star.linkSize));
        const RecorderId firstId(1000 + 100 * i);
        refill(mesh, star, floor, FloorJoins(floor), firstId, after(first, i), seams[i]);
        mesh.vertexHalfedge[chosen[i]] = HalfedgeId();
        EXPECT_EQ(mesh.triangles[star.slot(0)].recorderId, firstId);
        EXPECT_EQ(mesh.triangles[star.slot(0)].creator, after(first, i));
        if (!isBatch)
          for (const Seam& seam : seams[i]) sewAlone(mesh, seam);
      }
      if (isBatch)
        for (const auto& of : seams)
          for (const Seam& seam : of)
            sew(mesh, seam, first,
                [&](RemovalId removal) { return std::span(seams[removal.index() - first.index()]); });
      expectConsistent(mesh);
      EXPECT_EQ(edgesOf(mesh).size(), 3 * (before - 2 * chosen.size()));

      const std::size_t live = before - 2 * chosen.size();
      const auto inOrder = mesh.verticesInOrder();
      EXPECT_EQ(inOrder.size(), 12u * 8 - chosen.size());
      std::set<LiveMesh::Corners> corners, kept;
      for (const auto& t : mesh.triangles)
        if (!t.isDead()) corners.insert(t.corners);
      const SlotMap moved = mesh.compact(inOrder);
      EXPECT_EQ(moved.liveCount(), live);
      ASSERT_EQ(mesh.triangles.size(), live);
      for (const auto& t : mesh.triangles) kept.insert(t.corners);
      EXPECT_EQ(kept, corners);
      expectConsistent(mesh);
    }
}

}  // namespace
}  // namespace arete
