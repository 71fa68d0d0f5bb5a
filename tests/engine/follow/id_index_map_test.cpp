// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/follow/id_index_map.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace arete {
namespace {

TEST(IdIndexMap, DoesWhatAMapDoesWithIdsThatComeInRuns) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    IdIndexMap table;
    std::map<std::uint32_t, std::uint32_t> map;
    for (int step = 0; step < 20000; ++step) {
      const std::uint32_t begin = random() % 5000 * 4 + (random() % 50 == 0 ? 0xFFFF0000u : 0);
      const bool isGrowing = step / 4000 % 2 == 0;
      for (std::uint32_t id = begin; id < begin + 6; ++id) {
        ASSERT_EQ(table.contains(id), map.contains(id));
        if (map.contains(id) && random() % 3 == 0) table[id] = map[id] = std::uint32_t(step);
        if (map.contains(id)) {
          ASSERT_EQ(table[id], map[id]);
        }
        if (!map.contains(id) && (isGrowing || random() % 4 == 0)) {
          map[id] = random();
          table.insert(id, map[id]);
        } else if (map.contains(id) && (!isGrowing || random() % 4 == 0)) {
          ASSERT_EQ(table.erase(id), map[id]);
          map.erase(id);
        }
      }
    }
    for (const auto& [id, place] : map) ASSERT_EQ(table[id], place);
    while (!map.empty()) {
      ASSERT_EQ(table.erase(map.begin()->first), map.begin()->second);
      map.erase(map.begin());
    }
    EXPECT_FALSE(table.contains(4));
  }
}

}  // namespace
}  // namespace arete
