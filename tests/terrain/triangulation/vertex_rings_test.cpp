// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/triangulation/vertex_rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "datasets/families.h"
#include "engine/ids_of.h"
#include "terrain/triangulation/finest_points.h"

namespace arete {
namespace {

TEST(VertexRings, HoldTheNeighboursOfEveryVertexInTheOrderOfItsTriangles) {
  for (const PointFamily& family : pointFamilies()) {
    const PointHeightfield field = family.make(300, 5);
    const auto finest = finestPoints(field);
    ASSERT_TRUE(finest) << family.name;
    const auto triangles = finest->trianglesOfPoints();
    std::map<std::pair<VertexId, VertexId>, VertexId> after;  // around a vertex
    for (const auto& corners : triangles) {
      const VertexId a(corners[0]), b(corners[1]), c(corners[2]);
      after[{a, b}] = c;
      after[{b, c}] = a;
      after[{c, a}] = b;
    }
    std::vector<VertexId> pinched;
    const VertexRings rings(
        LiveMesh::fromTriangles(triangles, static_cast<std::uint32_t>(field.size()), pinched));
    std::size_t edges = 0;
    for (const VertexId v : test::idsBelow<VertexId>(field.size())) {
      const auto ring = rings.of(v);
      const bool isOnBorder = !ring.empty() && !ring.back().isValid();
      const std::size_t neighbours = ring.size() - (isOnBorder ? 1 : 0);
      for (std::size_t i = 0; i < neighbours; ++i) {
        const auto next = after.find({v, ring[i]});
        const bool isLast = isOnBorder && i + 1 == neighbours;
        ASSERT_EQ(next == after.end(), isLast) << family.name << " vertex " << v.index();
        if (isLast) continue;
        const VertexId expected = ring[i + 1 < neighbours ? i + 1 : 0];
        EXPECT_EQ(next->second, expected) << family.name << " vertex " << v.index();
        RingPlace place(rings, v, ring[i]);
        EXPECT_EQ(place.next(), expected);
        EXPECT_EQ(place.previous(), ring[i]);
        ++edges;
      }
      if (isOnBorder) {
        EXPECT_FALSE(RingPlace(rings, v, ring.front()).previous().isValid());
        EXPECT_FALSE(RingPlace(rings, v, ring[neighbours - 1]).next().isValid());
      }
    }
    EXPECT_EQ(edges, 3 * triangles.size()) << family.name;
  }
}

TEST(VertexRings, HoldTheNeighboursOfAHubWhicheverOfItsTrianglesComesFirst) {
  const std::uint32_t spokes = 5000;
  const VertexId middle(0);
  std::vector<std::array<std::uint32_t, 3>> triangles;  // around it
  for (std::uint32_t i = 0; i < spokes; ++i) triangles.push_back({0, i + 1, (i + 1) % spokes + 1});
  for (const bool isTurned : {false, true}) {
    if (isTurned) std::ranges::reverse(triangles);
    std::vector<VertexId> pinched;
    const VertexRings rings(LiveMesh::fromTriangles(triangles, spokes + 1, pinched));
    EXPECT_TRUE(pinched.empty());
    const auto hub = rings.of(middle);
    ASSERT_EQ(hub.size(), spokes);
    for (std::uint32_t i = 0; i < spokes; ++i) {
      EXPECT_EQ(hub[(i + 1) % spokes], VertexId(hub[i].index() % spokes + 1));
      const auto rim = rings.of(hub[i]);  // the next one, the hub, the one before, the border
      ASSERT_EQ(rim.size(), 4u);
      EXPECT_EQ(rim[1], middle);
      EXPECT_FALSE(rim[3].isValid());
    }
  }
}

}  // namespace
}  // namespace arete
