// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/displacement/reach.h"

#include <gtest/gtest.h>

#include <random>

#include "surface/model/displacement.h"

namespace arete {
namespace {

/// A triangle of the plan, and a small face above its middle that it stands for.
struct BelowAFace {
  std::vector<Vec3> positions = {{0.9, 0.9, 1}, {1.1, 0.9, 1}, {1, 1.1, 1}};
  std::vector<std::array<std::uint32_t, 3>> faces = {{0, 1, 2}};
  OriginalSurface original{positions, faces, 1.1};
  PieceList pieces;
  SpaceTriangle triangle = {Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{0, 3, 0}};

  BelowAFace() {
    PieceList::Builder builder;
    builder.add(0, 0, wholeFace());
    pieces = builder.finish();
  }
  int reach(const Vec3& direction, double error) const {
    return reachOf(original, pieces, triangle, {direction, direction, direction}, error);
  }
};

TEST(Reach, IsWholeTowardsTheSource) {
  EXPECT_EQ(BelowAFace().reach({0, 0, 1}, 1.01), 254);  // rounded down
}

TEST(Reach, EndsWhereThePieceWouldBeFartherThanTheError) {
  // The face is 1 above, and 1.25 are allowed: 0.25 away from it.
  EXPECT_EQ(BelowAFace().reach({0, 0, -1}, 1.25), 50);
  EXPECT_EQ(BelowAFace().reach({0, 0, -2}, 1.25), 25);
  EXPECT_EQ(BelowAFace().reach({0, 0, -1}, 1), 0);
}

TEST(Reach, EndsWherePassingBeyondThePieceWouldBeFartherThanTheError) {
  // At most 1.25 beyond: 2.25 of 1.25 * 3.
  EXPECT_EQ(BelowAFace().reach({0, 0, 3}, 1.25), 152);
}

TEST(Reach, IsNoneWhereThePieceIsFartherThanTheErrorAlready) {
  EXPECT_EQ(BelowAFace().reach({0, 0, 1}, 0.9), 0);
}

TEST(Reach, IsNoneOfATriangleWithoutArea) {
  BelowAFace at;
  at.triangle[2] = {6, 0, 0};
  EXPECT_EQ(at.reach({0, 0, 1}, 5), 0);
}

TEST(Reach, HoldsForWhateverScalesTheCornersHave) {
  std::mt19937_64 random(1);
  const auto number = [&] { return double(random() % 20001) / 10000 - 1; };
  int checked = 0;
  for (int i = 0; i < 2000; ++i) {
    BelowAFace at;
    for (Vec3& p : at.positions) p = {1 + number(), 1 + number(), number()};
    for (Vec3& p : at.triangle) p = p + Vec3{number(), number(), number()};
    std::array<Vec3, 3> directions;
    for (Vec3& d : directions) d = Vec3{number(), number(), number()} * 2.0;
    double error = 0;
    for (const Vec3& p : at.positions) error = std::max(error, distanceToTriangle(p, at.triangle));
    error *= 1 + std::abs(number());
    const double reach =
        error * reachOf(at.original, at.pieces, at.triangle, directions, error) / SurfaceDisplacement::kWhole;
    for (int k = 0; k < 10; ++k) {
      SpaceTriangle displaced = at.triangle;
      for (std::size_t c = 0; c < 3; ++c)
        displaced[c] = displaced[c] + (k < 8 ? (k >> c & 1) : std::abs(number())) * reach * directions[c];
      for (const Vec3& p : at.positions)
        ASSERT_LE(distanceToTriangle(p, displaced), error * (1 + 1e-12)) << "seed 1, case " << i;
    }
    checked += reach > 0 ? 1 : 0;
  }
  EXPECT_GT(checked, 500);
}

}  // namespace
}  // namespace arete
