// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filters against the exact predicates that they spare.
#include "terrain/triangulation/point_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/ids_of.h"

namespace arete {
namespace {

int exactThird(const PointPlan::Polygon& polygon, int i, int j) {
  int best = -1;
  for (int m = i + 1; m < j; ++m) {
    if (polygon.orientation(i, m, j) <= 0) continue;
    if (best < 0 || polygon.inCircle(i, best, j, m) > 0) best = m;
  }
  return best;
}

/// The first is the apex.
void expectExactThirds(const std::vector<Vec3>& points, double stretch, const std::string& name) {
  const PointPlan plan(points, stretch);
  const auto all = test::idsBelow<VertexId>(points.size());
  const std::vector<VertexId> link(all.begin() + 1, all.end());
  const PointPlan::Polygon polygon(plan, all.front(), link);
  const int corners = static_cast<int>(link.size());
  for (int i = 0; i < corners; ++i)
    for (int j = i + 2; j < corners; ++j)
      ASSERT_EQ(polygon.third(i, j, [](int, int) { return false; }), exactThird(polygon, i, j))
          << name << ": " << i << " to " << j;
}

TEST(PointPlan, FindsTheThirdCornerOfExactPredicatesOnCirclesGridsAndLines) {
  const double nudge = 0x1p-50;
  for (const double width : {1.0, 1e-30, 1e30})
    for (const double height : {1.0, 1e-20, 1e20})
      for (const double offset : {0.0, 1e3, 1e12})
        for (const double stretch : {1.0, 0.25, 65536.0}) {
          std::vector<Vec3> circle(1), grid(1), line(1);
          for (int i = 0; i < 12; ++i) {
            const double angle = i * std::acos(-1.0) / 6, off = nudge * (i * 5 % 7 - 3);
            circle.push_back(
                {(offset + std::cos(angle) + off) * width, (offset + std::sin(angle)) * height, 0});
            grid.push_back({(offset + i * 5 % 4) * width, (offset + i * 7 % 3) * height, 0});
            line.push_back({(offset + i) * width, (offset + 0.37 * i + off) * height, 0});
          }
          for (const auto* points : {&circle, &grid, &line})
            expectExactThirds(*points, stretch,
                              std::to_string(width) + " by " + std::to_string(height) + " at " +
                                  std::to_string(offset) + " times " + std::to_string(stretch));
        }
}

TEST(PointPlan, IsNotSureOfProductsThatVanish) {
  const double width = 1e42, height = 1e-35, least = 5e-324;
  expectExactThirds(
      {{0, 0, 0}, {2 * width, 0, 0}, {least, 3 * height, 0}, {width, 2 * height, 0}, {0, 3 * height, 0}}, 1,
      "least");
}

}  // namespace
}  // namespace arete
