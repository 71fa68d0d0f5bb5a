// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets/asteroid.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace arete {
namespace {

TEST(Asteroid, IsClosedOrientedAndOfGenusZero) {
  for (const std::uint32_t vertices : {8u, 600u, 20'000u}) {
    const TriangleMesh mesh = generateAsteroid({.vertices = vertices, .seed = 3});
    ASSERT_TRUE(mesh.validate());
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
    EXPECT_EQ(mesh.positions.size() - edges.size() / 2 + mesh.triangles.size(), 2u);
    double volume = 0;
    for (const auto& t : mesh.triangles)
      volume += dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6;
    EXPECT_GT(volume, 0.5);
  }
}

TEST(Asteroid, HasAboutAsManyVerticesAsAskedForAndIsTheSameForTheSameSeed) {
  const TriangleMesh mesh = generateAsteroid({.vertices = 50'000, .seed = 2});
  EXPECT_NEAR(double(mesh.positions.size()), 50'000, 1500);
  EXPECT_EQ(mesh.positions, generateAsteroid({.vertices = 50'000, .seed = 2}).positions);
  EXPECT_NE(mesh.positions, generateAsteroid({.vertices = 50'000, .seed = 4}).positions);
}

}  // namespace
}  // namespace arete
