// SPDX-License-Identifier: GPL-3.0-or-later
//
// A level of all threads and a level of a tile make the same promises about what they remove.
#include "terrain/simplify/level.h"

#include <gtest/gtest.h>

#include "engine/ids_of.h"
#include "terrain/simplify/tile.h"
#include "terrain/simplify_fixture.h"

namespace arete {
namespace {

using Workers = LevelWorkers<LatticePlan, RasterError>;
using Costs = IdArray<VertexId, std::vector<RemovalRecord>>;
using Links = IdArray<VertexId, std::vector<std::set<VertexId>>>;
constexpr double kThreshold = 4;

/// The costs of all vertices before a level, by evaluations to the end.
Costs costsOf(SmallSimplification& small) {
  Costs costs(small.field.size());
  const RemovalCost<LatticePlan, RasterError> cost(small.state);
  Star star;
  for (const VertexId v : small.vertices()) {
    costs[v] = {};
    if (small.isFixed()[v] == 0 && small.mesh.isInTriangle(v))
      cost.evaluate(v, star, SmallSimplification::kRange, costs[v]);
  }
  return costs;
}

Links linksOf(const SmallSimplification& small) {
  Links links;
  for (const VertexId v : small.vertices()) links.push_back(small.linkOf(v));
  return links;
}

TEST(LevelWorkers, RemoveAMaximalIndependentSetOfTheVerticesUnderTheThreshold) {
  for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
    SmallSimplification small(17, 13, 1, shape);
    const auto costs = costsOf(small);
    const Links links = linksOf(small);
    Workers workers(small.state, nullptr);
    const std::size_t count = workers.levelOfAll(kThreshold, 1, {1, 0});
    const std::set<VertexId> left = small.verticesLeft();
    EXPECT_EQ(left.size(), small.field.size() - count);
    EXPECT_GT(count, 10u);
    EXPECT_TRUE(small.isWhole());
    EXPECT_EQ(small.state.thresholds.size(), small.field.size() - 4 - count);
    for (const VertexId v : small.vertices()) {
      const bool isCandidate = costs[v].state == RemovalRecord::State::exact && costs[v].cost <= kThreshold;
      const bool hasRemovedNeighbour =
          std::ranges::any_of(links[v], [&](VertexId u) { return !left.contains(u); });
      if (!left.contains(v)) {
        EXPECT_TRUE(isCandidate) << v.index();
        EXPECT_FALSE(hasRemovedNeighbour) << v.index();
      } else if (isCandidate) {
        EXPECT_TRUE(hasRemovedNeighbour) << v.index() << ": nothing prevents its removal";
      }
    }
  }
}

TEST(LevelWorkers, RemoveNothingAboveTheThreshold) {
  SmallSimplification small(9, 9, 2, HoleShape::delaunay);
  Workers workers(small.state, nullptr);
  EXPECT_EQ(workers.levelOfAll(0, 1, {1, 0}), 0u);
  EXPECT_EQ(small.verticesLeft().size(), small.field.size());
}

TEST(LevelWorkers, OfSomeVerticesRemoveNoOther) {
  SmallSimplification small(17, 13, 3, HoleShape::delaunay);
  const std::vector<VertexId> some = test::idsOf<VertexId>({40, 41, 42, 100, 130, 200});
  Workers workers(small.state, nullptr);
  const std::size_t count = workers.levelOf(some, 100, 1, {1, 0});
  EXPECT_GE(count, 4u) << "41 is between two others";
  for (const VertexId v : small.vertices())
    if (!small.mesh.isInTriangle(v)) {
      EXPECT_NE(std::ranges::find(some, v), some.end()) << v.index();
    }
}

TEST(TileWorker, RemovesVerticesOfItsTileAndHoldsThoseWithNeighboursOutside) {
  for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
    SmallSimplification small(17, 13, 1, shape);
    const auto costs = costsOf(small);
    const Links links = linksOf(small);
    const ThresholdList::Tile all = small.state.thresholds.all();
    const ThresholdList::Tile tile{all.begin + all.size() / 4, all.begin + 3 * all.size() / 4};
    std::vector<VertexId> inTile;
    for (const VertexId v : small.vertices())
      if (small.state.thresholds.isWithin(tile, v)) inTile.push_back(v);
    const auto isIn = [&](VertexId v) { return std::ranges::binary_search(inTile, v); };

    TileWorker<LatticePlan, RasterError> worker(small.state);
    const std::size_t count = worker.levelOf(tile, kThreshold, 1, {1, 0});
    EXPECT_GT(count, 5u);
    EXPECT_TRUE(small.isWhole());
    std::size_t removed = 0;
    for (const VertexId v : small.vertices()) {
      if (small.mesh.isInTriangle(v)) continue;
      ++removed;
      EXPECT_TRUE(isIn(v)) << v.index();
      EXPECT_LE(costs[v].cost, kThreshold);
      for (const VertexId u : links[v]) {
        EXPECT_TRUE(isIn(u)) << "a removed vertex has all its neighbours in the tile";
        EXPECT_TRUE(small.mesh.isInTriangle(u)) << "and none of them is removed in the same level";
      }
    }
    EXPECT_EQ(removed, count);
    EXPECT_FALSE(worker.held().empty());
    for (const VertexId v : worker.held()) {
      EXPECT_TRUE(isIn(v) && small.mesh.isInTriangle(v));
      EXPECT_FALSE(std::ranges::all_of(links[v], isIn)) << v.index();
    }
  }
}

}  // namespace
}  // namespace arete
