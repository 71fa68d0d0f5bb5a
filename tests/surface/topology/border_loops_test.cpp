// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/topology/border_loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "surface/shapes.h"

namespace arete {
namespace {

std::vector<BorderLoop> loopsOf(const TriangleMesh& mesh) {
  const MeshEdges edges(mesh.triangles, mesh.positions.size());
  return findBorderLoops(edges, MeshFans(edges));
}

TEST(BorderLoops, ASheetHasOneATubeTwoATorusNoneAMoebiusStripOne) {
  EXPECT_EQ(loopsOf(shapes::sheet(5, 4)).size(), 1u);
  EXPECT_EQ(loopsOf(shapes::sheet(5, 4))[0].sides.size(), 18u);
  EXPECT_EQ(loopsOf(shapes::sheet(5, 4, true)).size(), 2u);
  EXPECT_EQ(loopsOf(shapes::sheet(5, 4, true, true)).size(), 0u);
  EXPECT_EQ(loopsOf(shapes::sheet(5, 4, true, false, true)).size(), 1u);
}

TEST(BorderLoops, DoNotDependOnTheTurnsOfTheTriangles) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    TriangleMesh mesh = shapes::sheet(6, 5, true);
    std::mt19937_64 random(seed);
    for (auto& t : mesh.triangles)
      if (random() % 2 == 0) std::swap(t[1], t[2]);
    const auto loops = loopsOf(mesh);
    ASSERT_EQ(loops.size(), 2u) << seed;
    for (const BorderLoop& loop : loops) {
      EXPECT_TRUE(loop.isClosed);
      EXPECT_EQ(loop.sides.size(), 6u);
    }
  }
}

TEST(BorderLoops, PassTwoHolesThatTouchAsOne) {
  // Without the squares (1, 1) and (2, 2) of a sheet of 5 x 5, which share the vertex (2, 2).
  TriangleMesh mesh = shapes::sheet(5, 5);
  const std::set<std::size_t> gone = {2 * 6, 2 * 6 + 1, 2 * 12, 2 * 12 + 1};
  TriangleMesh holes{mesh.positions, {}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!gone.contains(t)) holes.triangles.push_back(mesh.triangles[t]);
  std::multiset<std::size_t> sizes;
  std::size_t closed = 0;
  for (const BorderLoop& loop : loopsOf(holes)) {
    sizes.insert(loop.sides.size());
    closed += loop.isClosed ? 1 : 0;
  }
  // The fans of the shared vertex join the two holes to one loop of eight: from hole to hole and back.
  EXPECT_EQ(sizes, (std::multiset<std::size_t>{8, 20}));
  EXPECT_EQ(closed, 2u);
}

TEST(BorderLoops, EveryBorderSideIsInOneAndNeighboursShareAVertex) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    TriangleMesh mesh = shapes::anything(seed, 10, 12, 5);
    std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    const MeshEdges edges(mesh.triangles, mesh.positions.size());
    std::set<CornerId> expected, found;
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (edges[e].isBorder()) expected.insert(edges[e].sides[0]);
    for (const BorderLoop& loop : findBorderLoops(edges, MeshFans(edges))) {
      for (std::size_t i = 0; i < loop.sides.size(); ++i) {
        EXPECT_TRUE(found.insert(loop.sides[i]).second);
        if (i + 1 == loop.sides.size() && !loop.isClosed) continue;
        const CornerId next = loop.sides[(i + 1) % loop.sides.size()];
        const std::set<VertexId> ends = {edges.origin(loop.sides[i]), edges.target(loop.sides[i])};
        EXPECT_TRUE(ends.contains(edges.origin(next)) || ends.contains(edges.target(next)));
      }
    }
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace arete
