// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/topology/edges.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "surface/shapes.h"

namespace arete {
namespace {

TEST(MeshEdges, AreThoseOfASearchThroughAllTriangles) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh mesh = shapes::anything(seed, 12, 40, 5);
    const MeshEdges edges(mesh.triangles, mesh.positions.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> expected;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
        expected[{std::min(a, b), std::max(a, b)}].push_back(3 * t + i);
      }
    ASSERT_EQ(edges.size(), expected.size());
    std::size_t e = 0;
    for (const auto& [ends, sides] : expected) {
      const MeshEdges::Edge edge = edges[e];
      EXPECT_EQ(edge.low.index(), ends.first);
      EXPECT_EQ(edge.high.index(), ends.second);
      std::vector<std::uint32_t> found;
      for (const CornerId side : edge.sides) {
        found.push_back(side.index());
        EXPECT_EQ(edges.edgeOf(side), e);
        const CornerId across = edges.across(side);
        EXPECT_EQ(across.isValid(), sides.size() == 2);
        if (across.isValid()) {
          EXPECT_EQ(across.index(), sides[0] + sides[1] - side.index());
        }
      }
      EXPECT_EQ(found, sides);
      ++e;
    }
  }
}

TEST(MeshEdges, OfNoTriangleAreNone) {
  EXPECT_EQ(MeshEdges({}, 0).size(), 0u);
  EXPECT_EQ(MeshEdges({}, 7).size(), 0u);
}

}  // namespace
}  // namespace arete
