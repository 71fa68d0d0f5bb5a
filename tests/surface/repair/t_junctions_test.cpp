// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "surface/repair/repair.h"
#include "surface/shapes.h"

namespace arete {
namespace {

TEST(Repair, SplitsLongEdgesWhereOthersEnd) {
  // A coarse row of squares above a fine one: sixteen small edges on each of three long ones.
  TriangleMesh mesh = shapes::sheet(3, 1);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i <= 48; ++i) {
    mesh.positions.push_back({i / 16.0, -1, 0});
    if (i % 16 != 0) mesh.positions.push_back({i / 16.0, 0, 0});
  }
  const auto at = [&](std::uint32_t i, bool isUpper) {
    if (isUpper && i % 16 == 0) return i / 16;
    const std::uint32_t before =
        2 * i - (i + 15) / 16;  // upper vertices at multiples of 16 are the coarse row's
    return first + before + (isUpper ? 1u : 0u);
  };
  for (std::uint32_t i = 0; i < 48; ++i) {
    mesh.triangles.push_back({at(i, false), at(i + 1, false), at(i + 1, true)});
    mesh.triangles.push_back({at(i, false), at(i + 1, true), at(i, true)});
  }
  ASSERT_EQ(diagnose(mesh)->tJunctions.count, 45u);
  const auto repaired = repair(mesh);
  ASSERT_TRUE(repaired);
  EXPECT_EQ(repaired->counts.tJunctions, 45u);
  EXPECT_EQ(repaired->diagnosis.tJunctions.count, 0u);
  EXPECT_EQ(repaired->diagnosis.components.size(), 1u);
  EXPECT_EQ(repaired->diagnosis.borders.size(), 1u);
  for (std::size_t t = 0; t < repaired->mesh.triangles.size(); ++t)
    EXPECT_LT(repaired->triangleOf[t], mesh.triangles.size());
}

TEST(Repair, SplitsAllThreeSidesOfATriangle) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {4, 0, 0},  {0, 4, 0}, {2, 0, 0}, {2, 2, 0},
                    {0, 2, 0}, {2, -2, 0}, {4, 4, 0}, {-2, 2, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 6, 3}, {3, 6, 1}, {1, 7, 4}, {4, 7, 2}, {2, 8, 5}, {5, 8, 0}};
  const auto repaired = repair(mesh);
  ASSERT_TRUE(repaired);
  EXPECT_EQ(repaired->counts.tJunctions, 3u);
  EXPECT_EQ(repaired->diagnosis.borders.size(), 1u);
  EXPECT_EQ(repaired->diagnosis.borders[0].edgeCount, 6u);
  double area = 0;
  for (const auto& t : repaired->mesh.triangles) {
    const Vec3 &a = repaired->mesh.positions[t[0]], &b = repaired->mesh.positions[t[1]],
               &c = repaired->mesh.positions[t[2]];
    area += cross(b - a, c - a).z / 2;
  }
  EXPECT_DOUBLE_EQ(area, 8 + 4 + 8 + 4);
}

}  // namespace
}  // namespace arete
