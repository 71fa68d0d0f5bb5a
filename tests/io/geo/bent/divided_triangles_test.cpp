// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/bent/divided_triangles.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>
#include <vector>

namespace arete {
namespace {

double areaOf(const std::vector<Vec3>& p, const ThreeIds& t) {
  return norm(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) / 2;
}

// A grid of 2 * n * n triangles of which each edge is split or not, by chance.
TEST(DividedTriangles, ConformAndCoverTheirParents) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    constexpr std::uint32_t n = 6;
    std::vector<Vec3> p;
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i)
        p.push_back({i + 0.3 * double(random() % 100) / 100, double(j), double(random() % 5)});
    std::vector<ThreeIds> triangles;
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t v = j * (n + 1) + i;
        triangles.push_back({v, v + 1, v + n + 2});
        triangles.push_back({v, v + n + 2, v + n + 1});
      }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middleOf;
    std::vector<ThreeIds> middles;
    for (const ThreeIds& t : triangles) {
      ThreeIds& m = middles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto edge = std::minmax(t[k], t[(k + 1) % 3]);
        const auto [at, isNew] = middleOf.try_emplace({edge.first, edge.second}, kUnsplit);
        if (isNew && random() % 2 == 0) {
          at->second = static_cast<std::uint32_t>(p.size());
          p.push_back(0.5 * (p[edge.first] + p[edge.second]));
        }
        m[k] = at->second;
      }
    }
    const DividedTriangles divided = divideTriangles(triangles, middles, p);
    ASSERT_EQ(divided.triangles.size(), divided.parents.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    std::vector<double> area(triangles.size(), 0);
    for (std::size_t t = 0; t < divided.triangles.size(); ++t) {
      const ThreeIds& v = divided.triangles[t];
      area[divided.parents[t]] += areaOf(p, v);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(++sides[std::pair(v[k], v[(k + 1) % 3])], 1);
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) EXPECT_NEAR(area[t], areaOf(p, triangles[t]), 1e-9);
    // No edge that is split is left whole, and an inner edge has both its triangles.
    for (const auto& [edge, middle] : middleOf)
      if (middle != kUnsplit) {
        EXPECT_EQ(sides.count(edge) + sides.count({edge.second, edge.first}), 0u);
        EXPECT_EQ(sides.count({edge.first, middle}) + sides.count({middle, edge.first}),
                  sides.count({edge.second, middle}) + sides.count({middle, edge.second}));
      }
  }
}

}  // namespace
}  // namespace arete
