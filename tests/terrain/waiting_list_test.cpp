// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/waiting_list.h"

#include <gtest/gtest.h>

#include <algorithm>
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
    float least = WaitingList::kNever;
    for (const auto& [v, threshold] : dueAt) least = std::min(least, threshold);
    return least;
  }
};

TEST(WaitingList, FindsWhoIsDueInOrderHoweverManyHaveGone) {
  for (const std::uint32_t seed : {1u, 2u}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    constexpr std::uint32_t kVertices = 20'000;
    Ledger ledger;
    for (std::uint32_t v = 0; v < kVertices; ++v)
      if (random() % 8 != 0) ledger.order.push_back(v);
    std::shuffle(ledger.order.begin(), ledger.order.end(), random);
    for (const std::uint32_t v : ledger.order) ledger.dueAt[v] = WaitingList::kNow;

    WaitingList list;
    list.assign(ledger.order, kVertices);
    for (std::uint32_t v = 0; v < kVertices; ++v) list.wakeIf(true, v);  // some of whom are not in the list
    std::vector<std::uint32_t> due;
    list.collect(0, due);
    EXPECT_EQ(due, ledger.order) << "all are due at first";

    double threshold = 1;
    while (!ledger.dueAt.empty()) {
      list.collect(threshold, due);
      ASSERT_EQ(due, ledger.due(threshold)) << "threshold " << threshold;
      ASSERT_EQ(list.least(), ledger.least());
      std::vector<std::uint32_t> gone;
      for (const std::uint32_t v : due) {
        const unsigned fate = random() % 4;
        const float later =
            fate == 0 ? WaitingList::kNever : static_cast<float>(threshold * (1 + random() % 5));
        if (fate == 1) {
          gone.push_back(v);
          ledger.dueAt.erase(v);
        } else {
          list.set(v, later);
          ledger.dueAt[v] = later;
        }
      }
      list.remove(gone);
      for (const std::uint32_t v : ledger.order)
        if (random() % 32 == 0) {  // those that have gone stay away
          list.wakeIf(true, v);
          if (ledger.dueAt.count(v) != 0) ledger.dueAt[v] = WaitingList::kNow;
        }
      ASSERT_EQ(list.size(), ledger.dueAt.size());
      threshold = std::min(threshold * 4, 1e30);
    }
    list.collect(1e30, due);
    EXPECT_TRUE(list.empty() && due.empty());
  }
}

TEST(WaitingList, OfNobodyIsEmpty) {
  WaitingList list;
  list.assign({}, 10);
  std::vector<std::uint32_t> due{1};
  list.collect(1, due);
  EXPECT_TRUE(due.empty() && list.empty());
  EXPECT_EQ(list.least(), WaitingList::kNever);
}

}  // namespace
}  // namespace arete
