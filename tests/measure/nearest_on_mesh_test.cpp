// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nearest points of soups, sheets and spheres against the oracle of measure_meshes.h.
#include "measure/nearest_on_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "terrain/measure_meshes.h"

namespace arete {
namespace {

using namespace measuring_test;

TEST(NearestOnMesh, FindsTheNearestPointOfAllTriangles) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> spread(0, 1);
  const auto bumpy = [](double u, double v) { return Vec3{u, v, 0.2 * std::sin(9 * u) * std::cos(7 * v)}; };
  for (const auto& [name, mesh] : std::map<std::string, TriangleMesh>{{"one triangle", soup(2, 3)},
                                                                      {"soup", soup(300, 1)},
                                                                      {"more soup", soup(301, 2)},
                                                                      {"sheet", sheet(20, bumpy)},
                                                                      {"sphere", sphere(16, 1)}}) {
    const NearestOnMesh tree(mesh);
    for (int i = 0; i < 400; ++i) {
      const double far = std::pow(10.0, i % 5 - 2);
      Vec3 p{far * spread(random), far * spread(random), far * spread(random)};
      if (i % 7 == 0) p = mesh.positions[random() % mesh.positions.size()];
      SCOPED_TRACE(testing::Message() << name << ", query " << i << ": " << p.x << ' ' << p.y << ' ' << p.z);
      const NearestOnMesh::Answer answer = tree.nearest(p);
      const auto expected = static_cast<double>(distanceTo(p, mesh));
      ASSERT_NEAR(answer.distance, expected, 1e-9 + 1e-12 * expected);
      ASSERT_LT(answer.triangle, mesh.triangles.size());
      const auto& t = mesh.triangles[answer.triangle];
      const auto [a, b, c] = std::array{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
      ASSERT_NEAR(static_cast<double>(distanceTo(answer.point, a, b, c)), 0, 1e-9);
      const auto there = minus(p, answer.point);
      ASSERT_NEAR(static_cast<double>(std::sqrt(dot(there, there))), answer.distance, 1e-12 + 1e-12 * far);
    }
  }
}

TEST(NearestOnMesh, LooksAtFewAroundAVertexOfManyTriangles) {
  for (const double height : {0.0, 0.4, 3.0}) {
    std::vector<double> looks;
    for (const std::uint32_t n : {500u, 5000u, 20'000u}) {
      const TriangleMesh mesh = fans(n, height);
      const NearestOnMesh tree(mesh);
      std::mt19937_64 random(n);
      double sum = 0;
      for (int i = 0; i < 500; ++i) {
        const auto& t = mesh.triangles[random() % mesh.triangles.size()];
        const double u = double(random() % 1000) / 2000, v = double(random() % 1000) / 2000;
        const Vec3 p =
            (1 - u - v) * mesh.positions[t[0]] + u * mesh.positions[t[1]] + v * mesh.positions[t[2]];
        const NearestOnMesh::Answer answer = tree.nearest(p);
        EXPECT_LT(answer.distance, 1e-12);
        sum += answer.looks;
      }
      looks.push_back(sum / 500);
    }
    EXPECT_LT(looks[0], 60) << "height " << height;
    EXPECT_LT(looks[2], 2.5 * looks[0]) << "height " << height << ": 40 times as many triangles";
  }
}

}  // namespace
}  // namespace arete
