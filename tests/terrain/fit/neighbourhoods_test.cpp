// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/fit/neighbourhoods.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "terrain/fit_fixture.h"

namespace arete {
namespace {

using namespace fit_test;

TEST(FitNeighbourhoods, GroupsHaveEveryVertexThatMayMoveOnceAndNoTwoOfOneTriangle) {
  for (const CutOfModel& c : cutsOfAllFamilies(5)) {
    SCOPED_TRACE(c.name);
    FitMesh mesh = meshOf(c, c.maxError);
    for (std::uint32_t v = 0; v < mesh.vertexCount(); v += 5) mesh.fix(v);
    std::vector<std::uint32_t> groupOf(mesh.vertexCount(), FitMesh::kNone);
    const auto groups = independentVertices(mesh);
    for (std::uint32_t g = 0; g < groups.size(); ++g)
      for (const std::uint32_t v : groups[g]) {
        EXPECT_EQ(groupOf[v], FitMesh::kNone);
        groupOf[v] = g;
      }
    for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v)
      EXPECT_EQ(groupOf[v] == FitMesh::kNone, mesh.isFixed(v)) << v;
    for (std::uint32_t t = 0; t < mesh.slotCount(); ++t) {
      std::multiset<std::uint32_t> at;
      for (const std::uint32_t v : mesh.triangle(t).corners)
        if (!mesh.isFixed(v)) at.insert(groupOf[v]);
      for (const std::uint32_t g : at) EXPECT_EQ(at.count(g), 1u);
    }
  }
}

TEST(FitNeighbourhoods, CellsHoldVerticesThatAreNear) {
  for (const CutOfModel& c : cutsOfAllFamilies(6)) {
    SCOPED_TRACE(c.name);
    const FitMesh mesh = meshOf(c, c.maxError);
    Vec2 low = mesh.plan(mesh.mtVertex(0)), high = low;
    for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
      const Vec2 p = mesh.plan(mesh.mtVertex(v));
      low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y)};
      high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y)};
    }
    for (const std::uint32_t across : {1u, 2u, 5u, 64u}) {
      const double side = std::fmax(high.x - low.x, high.y - low.y) / across;
      const FitCells cells = cellsOf(mesh, across);
      EXPECT_LE(cells.count, across * across);
      ASSERT_EQ(cells.ofVertex.size(), mesh.vertexCount());
      ASSERT_EQ(cells.ofSlot.size(), mesh.slotCount());
      std::map<std::uint32_t, std::vector<Vec2>> in;
      for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
        EXPECT_LT(cells.ofVertex[v], cells.count);
        in[cells.ofVertex[v]].push_back(mesh.plan(mesh.mtVertex(v)));
      }
      for (const auto& [cell, places] : in)
        for (const Vec2& p : places) {
          EXPECT_LE(std::fabs(p.x - places[0].x), side * (1 + 1e-9));
          EXPECT_LE(std::fabs(p.y - places[0].y), side * (1 + 1e-9));
        }
      for (const std::uint32_t cell : cells.ofSlot) EXPECT_LT(cell, cells.count);
    }
  }
}

}  // namespace
}  // namespace arete
