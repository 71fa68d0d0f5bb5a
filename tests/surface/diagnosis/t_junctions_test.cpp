// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "surface/diagnosis/parts.h"

namespace arete::diagnosis {
namespace {

TEST(TJunctions, AreTheVerticesThatWereSetInsideEdges) {
  std::mt19937_64 random(7);
  const auto unit = [&] { return double(random() >> 11) * 0x1p-53; };
  for (int run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::uint32_t> vertices;
    std::vector<TJunction> expected;
    for (std::uint32_t e = 0; e < 40; ++e) {
      const auto first = static_cast<std::uint32_t>(positions.size());
      const Vec3 a{unit() * 10, unit() * 10, unit() * 10}, b{unit() * 10, unit() * 10, unit() * 10};
      positions.insert(positions.end(), {a, b});
      edges.push_back({first, first + 1});
      vertices.insert(vertices.end(), {first, first + 1});
      if (e % 3 == 0) continue;
      // Inside, or off the line by more than the distance, or near an end.
      const double t = 0.1 + 0.8 * unit();
      const Vec3 off = e % 3 == 1 ? Vec3{} : Vec3{1e-4, 0, 0};
      positions.push_back(a + (b - a) * t + off);
      vertices.push_back(first + 2);
      const double apart = norm(cross(off, (b - a) / norm(b - a)));
      if (e % 3 == 1 || apart < 1e-6) expected.push_back({first + 2, first, first + 1});
    }
    std::ranges::sort(expected);
    EXPECT_EQ(findTJunctions(positions, edges, vertices, 1e-7), expected);
  }
}

TEST(TJunctions, AreNotAtTheEndsOfAnEdge) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {1e-10, 0, 0}, {1 - 1e-10, 0, 0}, {1, 0, 0}};
  const std::vector<std::array<std::uint32_t, 2>> edges = {{0, 1}};
  const std::vector<std::uint32_t> vertices = {0, 1, 2, 3, 4};
  EXPECT_TRUE(findTJunctions(positions, edges, vertices, 1e-9).empty());
  EXPECT_EQ(findTJunctions(positions, edges, vertices, 1e-11).size(), 2u);
}

}  // namespace
}  // namespace arete::diagnosis
