// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/topology/fans.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "surface/shapes.h"

namespace arete {
namespace {

/// By repeated passes over all pairs of corners: corners at one vertex whose triangles share an edge there
/// that no third triangle has are in one fan.
std::vector<std::size_t> slowFans(const TriangleMesh& mesh) {
  const auto at = [&](std::size_t corner) { return mesh.triangles[corner / 3][corner % 3]; };
  const auto sides = [&](std::uint32_t a, std::uint32_t b) {
    std::size_t count = 0;
    for (const auto& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        if ((t[i] == a && t[(i + 1) % 3] == b) || (t[i] == b && t[(i + 1) % 3] == a)) ++count;
    return count;
  };
  std::vector<std::size_t> fan(3 * mesh.triangles.size());
  for (std::size_t c = 0; c < fan.size(); ++c) fan[c] = c;
  for (bool isChanged = true; isChanged;) {
    isChanged = false;
    for (std::size_t c = 0; c < fan.size(); ++c)
      for (std::size_t d = 0; d < fan.size(); ++d) {
        if (c / 3 == d / 3 || at(c) != at(d) || fan[c] <= fan[d]) continue;
        for (std::size_t i = 1; i < 3; ++i)
          for (std::size_t j = 1; j < 3; ++j) {
            const std::uint32_t u = at(c / 3 * 3 + (c + i) % 3), w = at(d / 3 * 3 + (d + j) % 3);
            if (u == w && sides(at(c), u) == 2) {
              isChanged = isChanged || fan[c] > fan[d];
              fan[c] = std::min(fan[c], fan[d]);
            }
          }
      }
  }
  return fan;
}

TEST(MeshFans, AreThoseOfASearchThroughAllPairsOfCorners) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE(seed);
    TriangleMesh mesh = shapes::anything(seed, 9, 14, 5);
    std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    const MeshEdges edges(mesh.triangles, mesh.positions.size());
    const MeshFans fans(edges);
    const std::vector<std::size_t> slow = slowFans(mesh);
    for (std::size_t c = 0; c < slow.size(); ++c)
      for (std::size_t d = 0; d < slow.size(); ++d)
        EXPECT_EQ(fans.fanOf[c] == fans.fanOf[d], slow[c] == slow[d]) << c << " " << d;
    std::vector<std::uint32_t> count(mesh.positions.size(), 0);
    for (const VertexId v : fans.vertexOf) ++count[v.index()];
    EXPECT_EQ(count, fans.fanCount);
  }
}

TEST(MeshFans, OfTwoTetrahedraThatTouchInAVertexAreTwoThere) {
  TriangleMesh mesh = shapes::tetrahedron();
  mesh.positions.insert(mesh.positions.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  mesh.triangles.insert(mesh.triangles.end(), {{0, 5, 4}, {0, 4, 6}, {4, 5, 6}, {5, 0, 6}});
  const MeshFans fans(MeshEdges(mesh.triangles, mesh.positions.size()));
  EXPECT_EQ(fans.fanCount, (std::vector<std::uint32_t>{2, 1, 1, 1, 1, 1, 1}));
}

}  // namespace
}  // namespace arete
