// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/threshold_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace arete {
namespace {

/// What the list should know, kept in the plainest way: the order, and a threshold for each that is left.
struct Ledger {
  std::vector<std::uint32_t> order;
  std::map<std::uint32_t, float> dueAt;

  std::vector<std::uint32_t> due(double threshold) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t v : order)
      if (const auto found = dueAt.find(v); found != dueAt.end() && found->second <= threshold)
        result.push_back(v);
    return result;
  }
  float least() const {
    float least = ThresholdList::kNever;
    for (const auto& [v, threshold] : dueAt) least = std::min(least, threshold);
    return least;
  }
  /// The part of those that will ever be due for whom the threshold has come; 1 where there are none.
  double partDue(double threshold) const {
    double ever = 0, now = 0;
    for (const auto& [v, own] : dueAt) {
      ever += own < ThresholdList::kNever ? 1 : 0;
      now += own <= threshold && own < ThresholdList::kNever ? 1 : 0;
    }
    return ever == 0 ? 1 : now / ever;
  }
};

TEST(ThresholdList, FindsWhoIsDueInOrderHoweverManyHaveGone) {
  for (const std::uint32_t seed : {1u, 2u}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    constexpr std::uint32_t kVertices = 20'000;
    Ledger ledger;
    for (std::uint32_t v = 0; v < kVertices; ++v)
      if (random() % 8 != 0) ledger.order.push_back(v);
    std::shuffle(ledger.order.begin(), ledger.order.end(), random);
    for (const std::uint32_t v : ledger.order) ledger.dueAt[v] = ThresholdList::kNow;

    ThresholdList list;
    std::vector<std::uint8_t> isStaying(kVertices, 0);
    std::vector<std::uint32_t> all = ledger.order;
    for (std::size_t i = 0; i < ledger.order.size(); i += 7) {
      isStaying[ledger.order[i]] = 1;
      ledger.dueAt.erase(ledger.order[i]);
    }
    std::erase_if(ledger.order, [&](std::uint32_t v) { return isStaying[v] != 0; });
    list.assign(all, isStaying);
    for (std::uint32_t v = 0; v < kVertices; ++v)
      list.wakeIf(isStaying[v] == 0, v);  // some of whom are not in the list
    std::vector<std::uint32_t> due;
    ThresholdList::Space space;
    const auto collect = [&](double threshold) {
      list.forgetGone();
      list.collect(threshold, due, space);
    };
    collect(0);
    EXPECT_EQ(due, ledger.order) << "all are due at first";

    double threshold = 1;
    while (!ledger.dueAt.empty()) {
      collect(threshold);
      ASSERT_EQ(due, ledger.due(threshold)) << "threshold " << threshold;
      // By pieces it is the same.
      std::vector<std::uint32_t> byPieces, ofSome;
      UninitializedVector<std::uint32_t> ofPiece;
      const ThresholdList::Piece everything = list.everything();
      for (std::uint32_t from = everything.begin; from < everything.end; from += 1000) {
        const ThresholdList::Piece piece{from, std::min(from + 1000, everything.end)};
        list.collect(piece, threshold, ofPiece);
        for (const std::uint32_t v : ofPiece) ASSERT_TRUE(list.isWithin(piece, v));
        byPieces.insert(byPieces.end(), ofPiece.begin(), ofPiece.end());
      }
      ASSERT_EQ(byPieces, due);
      // And of some vertices, however they are listed.
      std::vector<std::uint32_t> shuffled = due;
      shuffled.insert(shuffled.end(), due.begin(), due.begin() + std::ptrdiff_t(due.size() / 2));
      std::shuffle(shuffled.begin(), shuffled.end(), random);
      list.sort(shuffled);
      ASSERT_EQ(shuffled, due);
      list.collect(shuffled, threshold, ofSome, space);
      ASSERT_EQ(ofSome, due);
      ASSERT_EQ(list.least(), ledger.least());
      // A sample tells a tenth from a fifth.
      const float tenth = list.thresholdOf(0.1), fifth = list.thresholdOf(0.2);
      if (fifth > ThresholdList::kNow) {
        ASSERT_GT(ledger.partDue(fifth), 0.1);
        ASSERT_LT(ledger.partDue(std::nextafter(tenth, 0.0f)), 0.2);
      }
      for (const std::uint32_t v : due) ASSERT_EQ(list.vertices()[list.placeOf(v) - everything.begin], v);
      std::vector<std::uint32_t> gone;
      for (const std::uint32_t v : due) {
        const unsigned fate = random() % 4;
        const float later =
            fate == 0 ? ThresholdList::kNever : static_cast<float>(threshold * (1 + random() % 5));
        if (fate == 1) {
          gone.push_back(v);
          ledger.dueAt.erase(v);
        } else {
          list.set(v, later);
          ledger.dueAt[v] = later;
        }
      }
      list.remove(gone, gone.size() % 2 == 0 ? LoopThreads::all : LoopThreads::caller);
      for (const std::uint32_t v : ledger.order)
        if (random() % 32 == 0) {  // those that have gone stay away
          list.wakeIf(true, v);
          if (ledger.dueAt.count(v) != 0) ledger.dueAt[v] = ThresholdList::kNow;
        }
      ASSERT_EQ(list.size(), ledger.dueAt.size());
      threshold = std::min(threshold * 4, 1e30);
    }
    collect(1e30);
    EXPECT_TRUE(list.empty() && due.empty());
  }
}

TEST(ThresholdList, OfNobodyIsEmpty) {
  ThresholdList list;
  list.assign({}, std::vector<std::uint8_t>(10, 0));
  std::vector<std::uint32_t> due{1};
  ThresholdList::Space space;
  list.collect(1, due, space);
  EXPECT_TRUE(due.empty() && list.empty());
  EXPECT_EQ(list.least(), ThresholdList::kNever);
  EXPECT_EQ(list.thresholdOf(0.5), ThresholdList::kNow);
}

}  // namespace
}  // namespace arete
