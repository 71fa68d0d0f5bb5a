// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/laws/front_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "engine/family_models.h"

namespace arete {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Each edge's sides, of a map.
std::map<Edge, std::vector<std::uint32_t>> expectedEdges(const Cut& front) {
  std::map<Edge, std::vector<std::uint32_t>> edges;
  for (std::uint32_t t = 0; t < front.triangles.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i)
      edges[std::minmax(front.triangles[t][i], front.triangles[t][(i + 1) % 3])].push_back(3 * t + i);
  return edges;
}

void expectEdges(const Cut& front) {
  const FrontEdges edges(front);
  ASSERT_EQ(edges.vertices(), front.vertices.size());
  const auto expected = expectedEdges(front);
  auto next = expected.begin();
  for (std::uint32_t low = 0; low < edges.vertices(); ++low)
    edges.visitFrom(low, [&](std::span<const FrontEdges::Side> sides) {
      ASSERT_NE(next, expected.end());
      ASSERT_EQ(Edge(low, sides[0].high), next->first);
      ASSERT_EQ(sides.size(), next->second.size());
      for (std::size_t i = 0; i < sides.size(); ++i) {
        EXPECT_EQ(sides[i].number, next->second[i]);
        EXPECT_EQ(sides[i].triangle(), next->second[i] / 3);
        EXPECT_EQ(sides[i].corner(), next->second[i] % 3);
      }
      ++next;
    });
  EXPECT_EQ(next, expected.end());
}

TEST(FrontEdges, AreEachThereWithItsSidesInOrder) {
  for (const FamilyModel& family : familyModels()) {
    SCOPED_TRACE(family.name);
    const MultiTriangulation& mt = family.model.mt;
    for (const std::uint32_t nodes : {0u, mt.nodeCount() / 3, mt.nodeCount()})
      expectEdges(frontOfPrefix(mt, nodes));
  }
}

TEST(FrontEdges, AreThoseOfTrianglesThatMakeNoSurfaceToo) {
  std::mt19937 random(7);
  Cut front;
  front.vertices.resize(40);
  for (int t = 0; t < 20'000; ++t) {
    std::array<std::uint32_t, 3> corners;
    for (std::uint32_t& c : corners) c = random() % 40;
    front.triangles.push_back(corners);
  }
  expectEdges(front);
}

TEST(FrontEdges, OfNoTrianglesAreNone) {
  Cut front;
  front.vertices.resize(3);
  expectEdges(front);
}

}  // namespace
}  // namespace arete
