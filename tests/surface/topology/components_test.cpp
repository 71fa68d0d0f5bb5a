// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/topology/components.h"

#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace arete {
namespace {

TEST(MeshComponents, AreJoinedAcrossEdgesNotVertices) {
  TriangleMesh mesh = shapes::sheet(3, 3);
  shapes::append(mesh, shapes::tetrahedron({9, 9, 9}));
  mesh.triangles.push_back({0, 16, 17});  // shares vertex 0 with the sheet, and an edge with the tetrahedron
  const MeshComponents components(MeshEdges(mesh.triangles, mesh.positions.size()));
  EXPECT_EQ(components.count, 2u);
  EXPECT_EQ(components.componentOf.front(), 0u);
  EXPECT_EQ(components.componentOf.back(), 1u);
}

TEST(MeshOrientation, FindsTheTurnsThatWereMixed) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    TriangleMesh mesh = shapes::sheet(6, 5, true, true);
    std::mt19937_64 random(seed);
    std::vector<std::uint8_t> wasTurned;
    for (auto& t : mesh.triangles) {
      wasTurned.push_back(random() % 2 == 0 ? 1 : 0);
      if (wasTurned.back() != 0) std::swap(t[1], t[2]);
    }
    const MeshEdges edges(mesh.triangles, mesh.positions.size());
    const MeshOrientation orientation(edges);
    ASSERT_EQ(orientation.contradiction.size(), 1u);
    EXPECT_TRUE(orientation.isOrientable(0, edges));
    for (std::size_t t = 0; t < wasTurned.size(); ++t)
      EXPECT_EQ(orientation.isTurned[t] != 0, wasTurned[t] != wasTurned[0]);
  }
}

TEST(MeshOrientation, KnowsAMoebiusStripHoweverItsTrianglesTurn) {
  for (std::uint64_t seed = 0; seed <= 5; ++seed) {
    TriangleMesh mesh = shapes::sheet(9, 2, true, false, true);
    std::mt19937_64 random(seed);
    for (auto& t : mesh.triangles)
      if (seed != 0 && random() % 2 == 0) std::swap(t[0], t[1]);
    const MeshEdges edges(mesh.triangles, mesh.positions.size());
    const MeshOrientation orientation(edges);
    EXPECT_FALSE(orientation.isOrientable(0, edges)) << seed;
  }
}

}  // namespace
}  // namespace arete
