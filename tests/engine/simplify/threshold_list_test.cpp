// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/threshold_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "engine/ids_of.h"

namespace arete {
namespace {

using test::idsBelow;
using test::idsOf;

/// The oracle: the order, and a threshold for each vertex that is left.
struct Ledger {
  std::vector<VertexId> order;
  std::map<VertexId, float> thresholds;

  std::vector<VertexId> due(double threshold) const {
    std::vector<VertexId> result;
    for (const VertexId v : order)
      if (const auto found = thresholds.find(v); found != thresholds.end() && found->second <= threshold)
        result.push_back(v);
    return result;
  }
  float least() const {
    float least = ThresholdList::kNever;
    for (const auto& [v, threshold] : thresholds) least = std::min(least, threshold);
    return least;
  }
  /// The fraction of the vertices with a finite threshold that are due; 1 if there are none.
  double partDue(double threshold) const {
    double ever = 0, now = 0;
    for (const auto& [v, own] : thresholds) {
      ever += own < ThresholdList::kNever ? 1 : 0;
      now += own <= threshold && own < ThresholdList::kNever ? 1 : 0;
    }
    return ever == 0 ? 1 : now / ever;
  }
};

TEST(ThresholdList, FindsTheDueVerticesInOrderHoweverManyAreRemoved) {
  for (const std::uint32_t seed : {1u, 2u}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    constexpr std::uint32_t kVertices = 20'000;
    Ledger ledger;
    for (const VertexId v : idsBelow<VertexId>(kVertices))
      if (random() % 8 != 0) ledger.order.push_back(v);
    std::shuffle(ledger.order.begin(), ledger.order.end(), random);
    for (const VertexId v : ledger.order) ledger.thresholds[v] = ThresholdList::kNow;

    ThresholdList list;
    IdArray<VertexId, std::vector<std::uint8_t>> isFixed(kVertices, 0);
    const std::vector<VertexId> listed = ledger.order;
    for (std::size_t i = 0; i < ledger.order.size(); i += 7) {
      isFixed[ledger.order[i]] = 1;
      ledger.thresholds.erase(ledger.order[i]);
    }
    std::erase_if(ledger.order, [&](VertexId v) { return isFixed[v] != 0; });
    list.assign(listed, isFixed);
    for (const VertexId v : idsBelow<VertexId>(kVertices))
      list.makeDueIf(isFixed[v] == 0, v);  // some are not in the list
    std::vector<VertexId> due;
    ThresholdList::Scratch scratch;
    const auto collect = [&](double threshold) {
      list.compact();
      list.collect(threshold, due, scratch);
    };
    collect(0);
    EXPECT_EQ(due, ledger.order) << "all are due at first";

    double threshold = 1;
    while (!ledger.thresholds.empty()) {
      collect(threshold);
      ASSERT_EQ(due, ledger.due(threshold)) << "threshold " << threshold;
      // Tile by tile the result is the same.
      std::vector<VertexId> inTiles, ofSome;
      UninitializedVector<VertexId> ofTile;
      const ThresholdList::Tile all = list.all();
      for (std::uint32_t from = all.begin; from < all.end; from += 1000) {
        const ThresholdList::Tile tile{from, std::min(from + 1000, all.end)};
        list.collect(tile, threshold, ofTile);
        for (const VertexId v : ofTile) ASSERT_TRUE(list.isWithin(tile, v));
        inTiles.insert(inTiles.end(), ofTile.begin(), ofTile.end());
      }
      ASSERT_EQ(inTiles, due);
      // And of some vertices, however they are listed.
      std::vector<VertexId> shuffled = due;
      shuffled.insert(shuffled.end(), due.begin(), due.begin() + std::ptrdiff_t(due.size() / 2));
      std::shuffle(shuffled.begin(), shuffled.end(), random);
      list.sort(shuffled);
      ASSERT_EQ(shuffled, due);
      list.collect(shuffled, threshold, ofSome, scratch);
      ASSERT_EQ(ofSome, due);
      ASSERT_EQ(list.least(), ledger.least());
      // A sample tells a tenth from a fifth.
      const float tenth = list.quantile(0.1), fifth = list.quantile(0.2);
      if (fifth > ThresholdList::kNow) {
        ASSERT_GT(ledger.partDue(fifth), 0.1);
        ASSERT_LT(ledger.partDue(std::nextafter(tenth, 0.0f)), 0.2);
      }
      for (const VertexId v : due) ASSERT_EQ(list.vertices()[list.indexOf(v) - all.begin], v);
      std::vector<VertexId> removed;
      for (const VertexId v : due) {
        const unsigned fate = random() % 4;
        const float later =
            fate == 0 ? ThresholdList::kNever : static_cast<float>(threshold * (1 + random() % 5));
        if (fate == 1) {
          removed.push_back(v);
          ledger.thresholds.erase(v);
        } else {
          list.set(v, later);
          ledger.thresholds[v] = later;
        }
      }
      list.remove(removed, removed.size() % 2 == 0 ? LoopThreads::all : LoopThreads::caller);
      for (const VertexId v : ledger.order)
        if (random() % 32 == 0) {  // those that have removed stay away
          list.makeDueIf(true, v);
          if (ledger.thresholds.count(v) != 0) ledger.thresholds[v] = ThresholdList::kNow;
        }
      ASSERT_EQ(list.size(), ledger.thresholds.size());
      threshold = std::min(threshold * 4, 1e30);
    }
    collect(1e30);
    EXPECT_TRUE(list.empty() && due.empty());
  }
}

TEST(ThresholdList, WithoutVerticesIsEmpty) {
  ThresholdList list;
  list.assign({}, std::vector<std::uint8_t>(10, 0));
  std::vector<VertexId> due = idsOf<VertexId>({1});
  ThresholdList::Scratch scratch;
  list.collect(1, due, scratch);
  EXPECT_TRUE(due.empty() && list.empty());
  EXPECT_EQ(list.least(), ThresholdList::kNever);
  EXPECT_EQ(list.quantile(0.5), ThresholdList::kNow);
}

}  // namespace
}  // namespace arete
