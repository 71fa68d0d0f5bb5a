// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/floor_joins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace arete {
namespace {

HoleTriangulation anyTriangulation(int corners, std::mt19937& random) {
  HoleTriangulation floor;
  std::vector<std::pair<int, int>> open{{0, corners - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const int m = std::uniform_int_distribution<int>(i + 1, j - 1)(random);
    floor.triangles[floor.size++] = {std::uint8_t(i), std::uint8_t(m), std::uint8_t(j)};
    open.push_back({i, m});
    open.push_back({m, j});
  }
  return floor;
}

TEST(FloorJoins, EverySideOfEveryTriangleIsFoundOnce) {
  std::mt19937 random(20260);
  for (int corners = 3; corners <= kMaxHoleCorners; ++corners)
    for (int repeat = 0; repeat < 50; ++repeat) {
      HoleTriangulation floor = anyTriangulation(corners, random);
      std::shuffle(floor.triangles.begin(), floor.triangles.begin() + floor.size, random);
      std::map<std::pair<int, int>, std::pair<int, int>> sideOf;  // by the corners it runs from and to
      for (int f = 0; f < floor.size; ++f)
        for (int c = 0; c < 3; ++c) sideOf[{floor.triangles[f][c], floor.triangles[f][(c + 1) % 3]}] = {f, c};
      const FloorJoins joins(floor);
      const auto expectSide = [&](FloorJoins::Side side, int from, int to) {
        const auto found = sideOf.find({from, to});
        ASSERT_NE(found, sideOf.end()) << corners << " corners, from " << from << " to " << to;
        EXPECT_EQ(found->second, std::pair(int(side.triangle), int(side.side)));
        sideOf.erase(found);
      };
      for (int i = 0; i < corners; ++i) expectSide(joins.rim[i], i, (i + 1) % corners);
      ASSERT_EQ(joins.diagonalCount, corners - 3);
      for (int d = 0; d < joins.diagonalCount; ++d) {
        const FloorJoins::Diagonal& diagonal = joins.diagonals[d];
        EXPECT_LT(diagonal.from, diagonal.to);
        expectSide(diagonal.forth, diagonal.from, diagonal.to);
        expectSide(diagonal.back, diagonal.to, diagonal.from);
      }
      EXPECT_TRUE(sideOf.empty());
    }
}

}  // namespace
}  // namespace arete
