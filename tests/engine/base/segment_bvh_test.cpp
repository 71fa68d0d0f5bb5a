// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle is a plain scan over all segments.
#include "engine/base/segment_bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace arete {
namespace {

using Numbers = std::array<double, 4>;

Numbers numbersOf(const Segment2& s) {
  return {s.a.x, s.a.y, s.b.x, s.b.y};
}

bool boxMeets(const Segment2& s, const Box2& box) {
  return std::max(s.a.x, s.b.x) >= box.xMin && std::min(s.a.x, s.b.x) <= box.xMax &&
         std::max(s.a.y, s.b.y) >= box.yMin && std::min(s.a.y, s.b.y) <= box.yMax;
}

std::vector<Segment2> randomSegments(std::size_t count, bool onGrid, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Segment2> segments;
  for (std::size_t i = 0; i < count; ++i) {
    const auto coordinate = [&] { return onGrid ? double(random() % 8) : 100 * unit(random); };
    const Vec2 a{coordinate(), coordinate()};
    const Vec2 b = random() % 4 == 0 ? a : Vec2{a.x + 10 * unit(random) - 5, coordinate()};
    segments.push_back({a, b});
  }
  return segments;
}

TEST(SegmentBvh, VisitsEverySegmentWhoseBoxMeetsTheQueryAndNoOther) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const std::size_t count : {1u, 2u, 4u, 5u, 8u, 9u, 63u, 64u, 65u, 1000u}) {
      const std::vector<Segment2> segments = randomSegments(count, seed == 2, random);
      const SegmentBvh tree(segments);
      for (int round = 0; round < 50; ++round) {
        const double x = 110 * unit(random) - 5, y = 110 * unit(random) - 5, size = 40 * unit(random);
        const Box2 box = seed == 2 ? Box2{double(random() % 8), double(random() % 8), 8, 8}
                                   : Box2{x, y, x + size, y + size * unit(random)};
        std::vector<Numbers> found, expected;
        EXPECT_FALSE(tree.anyIn(box, [&](const Segment2& s) {
          found.push_back(numbersOf(s));
          return false;
        }));
        for (const Segment2& s : segments)
          if (boxMeets(s, box)) expected.push_back(numbersOf(s));
        std::ranges::sort(found);
        std::ranges::sort(expected);
        EXPECT_EQ(found, expected) << count << " segments";
      }
    }
  }
}

TEST(SegmentBvh, StopsAtTheFirstVisitThatReturnsTrue) {
  std::mt19937_64 random(4);
  const SegmentBvh tree(randomSegments(500, false, random));
  for (const int last : {1, 7, 100}) {
    int visits = 0;
    EXPECT_TRUE(tree.anyIn({-1e9, -1e9, 1e9, 1e9}, [&](const Segment2&) { return ++visits == last; }));
    EXPECT_EQ(visits, last);
  }
}

TEST(SegmentBvh, HasTheBoxOfAllItsSegments) {
  const SegmentBvh tree({{{3, 1}, {-2, 5}}, {{0, 9}, {1, -4}}});
  EXPECT_EQ(tree.bounds().xMin, -2);
  EXPECT_EQ(tree.bounds().yMin, -4);
  EXPECT_EQ(tree.bounds().xMax, 3);
  EXPECT_EQ(tree.bounds().yMax, 9);
}

TEST(SegmentBvh, WithoutSegmentsVisitsNothing) {
  EXPECT_TRUE(SegmentBvh().isEmpty());
  EXPECT_TRUE(SegmentBvh(std::vector<Segment2>()).isEmpty());
  EXPECT_FALSE(SegmentBvh().anyIn({-1, -1, 1, 1}, [](const Segment2&) { return true; }));
}

}  // namespace
}  // namespace arete
