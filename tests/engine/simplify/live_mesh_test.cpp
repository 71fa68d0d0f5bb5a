// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh against searches through all of its triangles: twins, fans, stars, and what removals leave.
#include "engine/simplify/live_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "engine/ids_of.h"

namespace arete {
namespace {

using test::after;
using test::idsBelow;

using Edge = std::pair<VertexId, VertexId>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// A grid of squares, each split by one of its diagonals; some squares are left out.
Triangles someTriangles(std::uint32_t columns, std::uint32_t rows, unsigned holes, unsigned seed) {
  std::mt19937 random(seed);
  Triangles triangles;
  for (std::uint32_t row = 0; row + 1 < rows; ++row)
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      if (random() % 100 < holes) continue;
      const std::uint32_t ul = row * columns + column, ur = ul + 1, ll = ul + columns, lr = ll + 1;
      if (random() % 2 == 0) {
        triangles.push_back({ul, ur, lr});
        triangles.push_back({ul, lr, ll});
      } else {
        triangles.push_back({ul, ur, ll});
        triangles.push_back({ur, lr, ll});
      }
    }
  std::shuffle(triangles.begin(), triangles.end(), random);
  return triangles;
}

/// By directed edge: the slot of the live triangle on its left.
std::map<Edge, SlotId> edgesOf(const LiveMesh& mesh) {
  std::map<Edge, SlotId> edges;
  for (const SlotId t : idsBelow<SlotId>(mesh.triangles.size())) {
    if (mesh.triangles[t].isDead()) continue;
    const auto& c = mesh.triangles[t].corners;
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(edges.insert({{c[i], c[(i + 1) % 3]}, t}).second);
  }
  return edges;
}

/// Every twin is the reverse edge of the neighbour; every vertex refers to a half-edge that leaves it, and to
/// one of its border half-edges if it has any.
void expectConsistent(const LiveMesh& mesh) {
  const auto edges = edgesOf(mesh);
  std::set<VertexId> used, onBorder;
  for (const auto& [edge, t] : edges) {
    used.insert(edge.first);
    for (std::uint32_t side = 0; side < 3; ++side) {
      const HalfedgeId h = LiveMesh::halfedge(t, side);
      if (mesh.origin(h) != edge.first) continue;
      ASSERT_EQ(mesh.origin(LiveMesh::nextInTriangle(h)), edge.second);
      ASSERT_EQ(LiveMesh::previousInTriangle(LiveMesh::nextInTriangle(h)), h);
      const auto reverse = edges.find({edge.second, edge.first});
      ASSERT_EQ(mesh.twinOf(h).isValid(), reverse != edges.end());
      if (reverse == edges.end()) {
        onBorder.insert(edge.first);
        continue;
      }
      ASSERT_EQ(LiveMesh::slotOf(mesh.twinOf(h)), reverse->second);
      ASSERT_EQ(mesh.origin(mesh.twinOf(h)), edge.second);
    }
  }
  for (const VertexId v : idsBelow<VertexId>(mesh.vertexCount())) {
    ASSERT_EQ(mesh.isInTriangle(v), used.contains(v)) << v.index();
    if (!mesh.isInTriangle(v)) continue;
    const HalfedgeId h = mesh.vertexHalfedge[v];
    ASSERT_EQ(mesh.origin(h), v);
    ASSERT_EQ(mesh.twinOf(h).isValid(), !onBorder.contains(v)) << v.index();
  }
}

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

/// A fan from the first corner: any triangulation will do, as nothing here depends on coordinates.
HoleTriangulation fan(int corners) {
  HoleTriangulation floor;
  for (int m = 1; m + 1 < corners; ++m) floor.add(0, m, m + 1);
  return floor;
}

/// Vertices whose stars share no triangle, in the interior of the grid.
std::vector<VertexId> someIndependent(const LiveMesh& mesh, std::uint32_t columns, unsigned seed) {
  std::mt19937 random(seed);
  const auto all = idsBelow<VertexId>(mesh.vertexCount());
  std::vector<VertexId> order(all.begin(), all.end());
  std::shuffle(order.begin(), order.end(), random);
  std::set<VertexId> blocked;
  std::vector<VertexId> chosen;
  Star star;
  for (const VertexId v : order) {
    const std::uint32_t column = v.index() % columns;
    if (column == 0 || column + 1 == columns || blocked.contains(v)) continue;
    if (!star.gather(mesh, v, kMaxHoleCorners) || star.isOpen || star.linkSize < 3) continue;
    const auto edges = edgesOf(mesh);
    bool isFree = true;  // a fan must not repeat an edge that exists elsewhere
    for (int m = 2; m + 1 < star.linkSize; ++m)
      isFree = isFree && !edges.contains({star.link[0], star.link[m]}) &&
               !edges.contains({star.link[m], star.link[0]});
    if (!isFree) continue;
    chosen.push_back(v);
    for (const VertexId u : star.linkView()) blocked.insert(u);
    if (chosen.size() == 6) break;
  }
  return chosen;
}

TEST(LiveMesh, IsConsistentAfterABatchOfRemovalsHoweverItIsSewn) {
  for (const bool isBatch : {false, true})
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
      SCOPED_TRACE(testing::Message() << (isBatch ? "a batch" : "one by one") << ", seed " << seed);
      std::vector<VertexId> pinched;
      LiveMesh mesh = LiveMesh::fromTriangles(someTriangles(12, 8, 0, seed), 12 * 8, pinched);
      const std::size_t before = mesh.triangles.size();
      const std::vector<VertexId> chosen = someIndependent(mesh, 12, seed);
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
