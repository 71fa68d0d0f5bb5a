// SPDX-License-Identifier: GPL-3.0-or-later
//
// A floor of k triangles is a binary tree hung on each of a triangle's three edges: the shapes are counted,
// and their links held against a walk around explicit triangles.
#include "io/store/packed/nodes/shapes.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>
#include <vector>

#include "datasets/random.h"

namespace arete::packed {
namespace {

TEST(PackedShapes, ListEveryFloorOfUpToFiveTrianglesOnce) {
  std::array<int, kListedTriangles + 1> byTriangles{};
  std::set<std::vector<int>> seen;
  int last = 0;
  for (const Shape& shape : listedShapes()) {
    ASSERT_LE(shape.triangles, kListedTriangles);
    ASSERT_GE(shape.triangles, last);
    last = shape.triangles;
    ++byTriangles[shape.triangles];
    EXPECT_EQ(shape.corners, shape.triangles + 2);
    std::vector<int> key(shape.link.begin(), shape.link.begin() + shape.corners);
    EXPECT_TRUE(seen.insert(key).second);
  }
  EXPECT_EQ(byTriangles, (std::array<int, 6>{0, 1, 3, 9, 28, 90}));
}

/// A walk whose bits come from a number, the first bit the lowest.
std::optional<Shape> walkOf(std::uint64_t& bits) {
  return walkedShape([&](const Shape&, int, int count) {
    const auto taken = static_cast<unsigned>(bits & ((1u << count) - 1));
    bits >>= count;
    return taken;
  });
}

TEST(PackedShapes, HaveTheSymbolOfTheirBits) {
  unsigned listed = 0;
  for (std::uint64_t bits = 0; bits < 1u << (1 + 2 * kListedTriangles); ++bits) {
    std::uint64_t rest = bits;
    const auto shape = walkOf(rest);
    if (!shape || rest != 0 || shape->triangles > kListedTriangles) continue;
    const unsigned symbol = shapeSymbol(bits, shape->triangles);
    ASSERT_LT(symbol, kListedShapes);
    EXPECT_EQ(listedShapes()[symbol].link, shape->link);
    ++listed;
  }
  EXPECT_EQ(listed, kListedShapes);
  EXPECT_EQ(shapeSymbol(0, kListedTriangles + 1), kWalkedShape);
}

TEST(PackedShapes, PutTheCornersOfEveryTriangleWhereTheyAreInTheLink) {
  Random random(2);
  int large = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::uint64_t bits = random.next() & random.next();
    const auto shape = walkOf(bits);
    if (!shape) continue;
    large += shape->triangles > 8 ? 1 : 0;
    ASSERT_EQ(shape->corners, shape->triangles + 2);
    // Corner c of triangle t, by the places in the link; neighbours share the two corners of their edge.
    for (int t = 1; t < shape->triangles; ++t) {
      const auto& step = shape->steps[t];
      const auto& parent = shape->steps[step.from >> 3];
      const unsigned edge = step.from & 7;
      EXPECT_EQ(step.place[0], parent.place[(edge + 1) % 3]);
      EXPECT_EQ(step.place[1], parent.place[edge]);
    }
    // An edge of the link goes from its own place to the next one.
    for (int k = 0; k < shape->corners; ++k) {
      const auto& step = shape->steps[shape->link[k] >> 3];
      const unsigned edge = shape->link[k] & 7;
      EXPECT_EQ(step.place[edge], k);
      EXPECT_EQ(step.place[(edge + 1) % 3], (k + 1) % shape->corners);
    }
  }
  EXPECT_GT(large, 0);
}

TEST(PackedShapes, AreNoneOfMoreTrianglesThanAFloorCanHave) {
  EXPECT_FALSE(walkedShape([](const Shape&, int, int count) { return (1u << count) - 1; }));
}

}  // namespace
}  // namespace arete::packed
