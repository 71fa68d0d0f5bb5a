// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a fit is made of: samples, nearest points, least squares.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "surface/fit/least_squares.h"
#include "surface/fit/source_samples.h"

namespace arete {
namespace {

TEST(SourceSamples, AreAsManyAsWantedEachForAsMuchArea) {
  // Two squares, one nine times as large as the other; the border is 4 and 12 long.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 0, 0}, {8, 0, 0}, {8, 3, 0}, {5, 3, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  const SourceSamples samples = sampleSource(mesh, 10'000);
  EXPECT_EQ(samples.ofArea.size(), 10'000u);
  std::size_t inSmall = 0;
  Vec3 middle{0, 0, 0};
  for (const Vec3& p : samples.ofArea) {
    if (p.x > 2) continue;
    ++inSmall;
    middle = middle + p;
    EXPECT_TRUE(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1 && p.z == 0);
  }
  EXPECT_NEAR(double(inSmall), 1000, 2);
  EXPECT_NEAR(middle.x / double(inSmall), 0.5, 0.01);
  EXPECT_NEAR(middle.y / double(inSmall), 0.5, 0.01);
  // A sample of the area stands for 0.001, a square of 0.0316.
  EXPECT_NEAR(double(samples.ofBorder.size()), 16 / std::sqrt(0.001), 2);
  for (const Vec3& p : samples.ofBorder)
    EXPECT_TRUE(p.x == 0 || p.x == 1 || p.x == 5 || p.x == 8 || p.y == 0 || p.y == 1 || p.y == 3) << p.x;
}

TEST(SourceSamples, AreNoneWithoutArea) {
  TriangleMesh mesh;
  EXPECT_TRUE(sampleSource(mesh, 100).ofArea.empty());
  mesh.positions = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_TRUE(sampleSource(mesh, 100).ofArea.empty());
}

TEST(MoveProblem, IsSolvedAsTheNormalEquationsAre) {
  // One triangle and samples that pull in all directions: the moves that make every residual vanish.
  const std::vector<std::array<std::uint32_t, 3>> elements = {{0, 1, 2}, {2, 1, 3}};
  const std::vector<Vec3> wanted = {{1, 2, 3}, {-1, 0.5, 0}, {0, 0, 2}, {4, -4, 1}};
  MoveProblem problem(4, elements);
  std::mt19937_64 random(2);
  for (int i = 0; i < 200; ++i) {
    const auto e = static_cast<std::uint32_t>(i % 2);
    const double u = double(random() % 1000) / 1000, v = (1 - u) * double(random() % 1000) / 1000;
    const std::array<double, 3> shares = {1 - u - v, u, v};
    Vec3 residual{0, 0, 0};
    for (std::size_t c = 0; c < 3; ++c) residual = residual + shares[c] * wanted[elements[e][c]];
    problem.add(e, shares, {2, 0.5, 0, 1, 0.25, 3}, residual);
  }
  const std::vector<std::uint8_t> none(4, 0), first = {1, 0, 0, 0};
  const std::vector<Vec3> moves = problem.solve(none);
  for (std::size_t v = 0; v < 4; ++v) EXPECT_LT(norm(moves[v] - wanted[v]), 0.05) << v;
  EXPECT_EQ(problem.solve(first)[0], (Vec3{0, 0, 0}));
}

}  // namespace
}  // namespace arete
