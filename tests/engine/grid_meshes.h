// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small meshes without coordinates, what can be removed from them, and searches through all of their
// triangles.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "engine/ids_of.h"
#include "engine/simplify/live_mesh.h"

namespace arete::test {

using Edge = std::pair<VertexId, VertexId>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// A grid of squares, each split by one of its diagonals; some squares are left out.
inline Triangles someTriangles(std::uint32_t columns, std::uint32_t rows, unsigned holes, unsigned seed) {
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
inline std::map<Edge, SlotId> edgesOf(const LiveMesh& mesh) {
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
inline void expectConsistent(const LiveMesh& mesh) {
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

/// A fan from the first corner: any triangulation will do, as nothing here depends on coordinates.
inline HoleTriangulation fan(int corners) {
  HoleTriangulation floor;
  for (int m = 1; m + 1 < corners; ++m) floor.add(0, m, m + 1);
  return floor;
}

/// At most so many vertices whose stars share no triangle; their fans make no edge that exists elsewhere.
/// @param openToo also vertices on borders.
inline std::vector<VertexId> someIndependent(const LiveMesh& mesh, bool openToo, std::size_t most,
                                             unsigned seed) {
  std::mt19937 random(seed);
  std::vector<VertexId> order = idsBelow<VertexId>(mesh.vertexCount());
  std::shuffle(order.begin(), order.end(), random);
  std::set<Edge> edges;
  for (const auto& [edge, t] : edgesOf(mesh)) edges.insert({edge, {edge.second, edge.first}});
  std::set<VertexId> blocked;
  std::vector<VertexId> chosen;
  Star star;
  for (const VertexId v : order) {
    if (chosen.size() == most) break;
    if (blocked.contains(v) || !star.gather(mesh, v, kMaxHoleCorners)) continue;
    if (star.linkSize < 3 || (star.isOpen && !openToo)) continue;
    std::set<Edge> added;
    for (int m = 2; m < star.linkSize - (star.isOpen ? 0 : 1); ++m)
      added.insert({{star.link[0], star.link[m]}, {star.link[m], star.link[0]}});
    if (std::ranges::any_of(added, [&](const Edge& edge) { return edges.contains(edge); })) continue;
    edges.merge(added);
    chosen.push_back(v);
    for (const VertexId u : star.linkView()) blocked.insert(u);
  }
  return chosen;
}

}  // namespace arete::test
