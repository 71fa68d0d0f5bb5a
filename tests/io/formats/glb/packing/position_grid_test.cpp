// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/packing/position_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace arete {
namespace {

TEST(PositionGrid, PutsEveryPositionWithinHalfAStepAndUsesItsBits) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const float size = std::ldexp(1.F, static_cast<int>(random() % 40) - 20);
    std::uniform_real_distribution<float> number(-size, size);
    std::vector<Float3> positions(200);
    for (Float3& p : positions) p = {number(random), number(random) / 3, number(random) + 5 * size};
    const int bits = 1 + static_cast<int>(random() % 16);
    const PositionGrid grid = PositionGrid::of(positions, bits);
    int largest = 0;
    for (const Float3& p : positions) {
      const PositionGrid::Point point = grid.nearest(p);
      for (std::size_t k = 0; k < 3; ++k) {
        const double back = double{grid.low[k]} + double{grid.step} * point[k];
        EXPECT_LE(std::abs(back - double{p[k]}), double{grid.step} / 2 * (1 + 1e-12));
        largest = std::max(largest, int{point[k]});
      }
    }
    EXPECT_EQ(largest, (1 << bits) - 1);
  }
}

TEST(PositionGrid, AddsHalfADiagonalToDistancesAndASlopeToHeights) {
  // A roof of slope 2, seen from above: y is up, and z points to the south.
  const std::vector<Float3> roof = {{0, 0, 0}, {1, 2, 0}, {0, 0, -1}};
  const TriangleMesh fromAbove{.positions = {{}, {}, {}}, .triangles = {{0, 1, 2}}};
  EXPECT_NEAR(errorOfGrid(fromAbove, roof, 1), 0.5 * (1 + 2 * std::sqrt(2)), 1e-12);
  const TriangleMesh fromBelow{.positions = {{}, {}, {}}, .triangles = {{0, 2, 1}}};
  EXPECT_NEAR(errorOfGrid(fromBelow, roof, 1), std::sqrt(3) / 2, 1e-12);
}

TEST(PositionGrid, CountsPlacesNotVerticesThatFallTogether) {
  const std::vector<Float3> positions = {{0, 0, 0}, {0, 0, 0}, {10, 0, 0}, {9.9F, 0, 0}};
  const PositionGrid grid = PositionGrid::of(positions, 2);
  std::vector<PositionGrid::Point> points;
  for (const Float3& p : positions) points.push_back(grid.nearest(p));
  EXPECT_EQ(countFallenTogether(positions, points), 1u);
}

}  // namespace
}  // namespace arete
