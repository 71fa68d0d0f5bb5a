// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/independent_set.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <random>
#include <set>

#include "engine/ids_of.h"
#include "terrain/triangulation/finest_raster.h"

namespace arete {
namespace {

using test::idsBelow;

struct Grid {
  LiveMesh mesh;
  IndependentSet::Records records;
  std::vector<VertexId> candidates;
};

/// A grid of which some vertices are candidates; costs from few values, so that many are alike.
Grid someGrid(std::uint32_t columns, std::uint32_t rows, int distinctCosts, std::uint64_t seed) {
  RasterHeightfield field;
  field.columns = columns;
  field.rows = rows;
  field.heights.assign(std::size_t(columns) * rows, 0);
  std::vector<VertexId> pinched;
  Grid grid;
  grid.mesh = LiveMesh::fromTriangles(finestTriangulation(field), columns * rows, pinched);
  grid.records.assign(std::size_t(columns) * rows, RemovalRecord{});
  std::mt19937_64 random(seed);
  for (const VertexId v : idsBelow<VertexId>(grid.records.size())) {
    grid.records[v].cost = static_cast<float>(random() % static_cast<unsigned>(distinctCosts));
    if (random() % 4 != 0) grid.candidates.push_back(v);
  }
  return grid;
}

std::set<VertexId> linkOf(const LiveMesh& mesh, VertexId v) {
  std::set<VertexId> link;
  for (const LiveMesh::Triangle& t : mesh.triangles)
    if (std::find(t.corners.begin(), t.corners.end(), v) != t.corners.end())
      for (const VertexId u : t.corners)
        if (u != v) link.insert(u);
  return link;
}

/// The definition, word for word.
std::vector<VertexId> greedy(const Grid& grid, const IndependentSet& set) {
  std::vector<VertexId> order = grid.candidates;
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return set.precedes(a, b); });
  std::set<VertexId> blocked, chosen;
  for (const VertexId v : order) {
    if (blocked.contains(v)) continue;
    chosen.insert(v);
    for (const VertexId u : linkOf(grid.mesh, v)) blocked.insert(u);
  }
  return {chosen.begin(), chosen.end()};
}

TEST(IndependentSet, IsTheOneAGreedyPassTakesForAnyNumberOfThreads) {
  for (const int distinctCosts : {1, 3, 1000})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", costs " + std::to_string(distinctCosts));
      for (const int threads : {1, 2, 4}) {
        Grid grid = someGrid(23, 17, distinctCosts, seed);
        IndependentSet set(grid.mesh, grid.records);
        for (const VertexId v : grid.candidates) set.enter(v, 7);
        std::vector<VertexId> chosen;
        tbb::task_arena(threads).execute([&] { set.choose(grid.candidates, 7, chosen); });
        std::sort(chosen.begin(), chosen.end());
        EXPECT_EQ(chosen, greedy(grid, set));
      }
    }
}

TEST(IndependentSet, DecidesAChainLongerThanItsDepth) {
  // A strip whose costs rise along it: every vertex waits for the one before.
  Grid grid = someGrid(4000, 2, 1, 1);
  grid.candidates.clear();
  for (const VertexId v : idsBelow<VertexId>(grid.records.size())) {
    grid.records[v].cost = static_cast<float>(4000 - v.index() % 4000);
    grid.candidates.push_back(v);
  }
  IndependentSet set(grid.mesh, grid.records);
  for (const VertexId v : grid.candidates) set.enter(v, 1);
  std::vector<VertexId> chosen;
  set.choose(grid.candidates, 1, chosen);
  std::sort(chosen.begin(), chosen.end());
  EXPECT_EQ(chosen, greedy(grid, set));
}

TEST(IndependentSet, TakenInTurnItIsTheSameWhereNothingIsRefused) {
  Grid one = someGrid(23, 17, 5, 3), other = someGrid(23, 17, 5, 3);
  IndependentSet set(one.mesh, one.records), inTurn(other.mesh, other.records);
  for (const VertexId v : one.candidates) {
    set.enter(v, 2);
    inTurn.enter(v, 2);
  }
  std::vector<VertexId> chosen, chosenInTurn;
  set.choose(one.candidates, 2, chosen);
  inTurn.chooseInTurn(other.candidates, 2, chosenInTurn, [](VertexId) { return true; });
  EXPECT_EQ(chosen, chosenInTurn);
  EXPECT_FALSE(chosen.empty());
}

TEST(IndependentSet, ARejectedCandidateBlocksNoNeighbour) {
  Grid grid = someGrid(9, 9, 5, 3);
  IndependentSet set(grid.mesh, grid.records);
  for (const VertexId v : grid.candidates) set.enter(v, 2);
  const std::set<VertexId> accepted = {VertexId(0), VertexId(40)};
  std::vector<VertexId> chosen;
  set.chooseInTurn(grid.candidates, 2, chosen, [&](VertexId v) { return accepted.contains(v); });
  for (const VertexId v : chosen) EXPECT_TRUE(accepted.contains(v)) << v.index();
}

}  // namespace
}  // namespace arete
