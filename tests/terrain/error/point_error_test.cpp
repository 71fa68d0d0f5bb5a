// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles over holes of the finest triangulation of points, against planes of rational numbers.
#include "terrain/error/point_error.h"

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "datasets/families.h"
#include "engine/base/id_array.h"
#include "engine/ids_of.h"
#include "terrain/triangulation/finest_points.h"

namespace arete {
namespace {

using Exact = CGAL::Exact_rational;

/// z of the plane through a, b, c minus z of p, at p.
double exactDifference(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Exact bx = Exact(b.x) - Exact(a.x), by = Exact(b.y) - Exact(a.y), cx = Exact(c.x) - Exact(a.x),
              cy = Exact(c.y) - Exact(a.y), x = Exact(p.x) - Exact(a.x), y = Exact(p.y) - Exact(a.y);
  const Exact area = bx * cy - by * cx;
  const Exact z =
      Exact(a.z) +
      ((x * cy - y * cx) * (Exact(b.z) - Exact(a.z)) + (bx * y - by * x) * (Exact(c.z) - Exact(a.z))) / area;
  return CGAL::to_double(Exact(z - Exact(p.z)));
}

/// Where doubles cannot give the plane, the error is that of a side (point_error.cpp).
bool isThin(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
  return std::abs(left - right) < 1e-6 * (std::abs(left) + std::abs(right));
}

TEST(PointError, OfTrianglesOverAHoleIsThatOfTheApexWhereTheyCoverIt) {
  for (const std::uint64_t seed : {1, 2})
    for (const PointFamily& family : pointFamilies()) {
      const PointHeightfield field = family.make(70, seed);
      const auto finest = finestPoints(field);
      ASSERT_TRUE(finest) << family.name;
      IdArray<VertexId, std::vector<Vec3>> points;
      for (const std::uint32_t v : finest->order)
        points.push_back({field.positions[v].x, field.positions[v].y, field.heights[v]});
      std::vector<VertexId> pinched;
      const auto mesh =
          LiveMesh::fromTriangles(finest->triangles, static_cast<std::uint32_t>(points.size()), pinched);
      const PointPlan plan(points, finest->xStretch);
      PointError errors(plan, points, mesh);
      int covering = 0;
      for (const VertexId apex : test::idsBelow<VertexId>(points.size())) {
        SCOPED_TRACE(testing::Message() << family.name << ", seed " << seed << ", apex " << apex.index());
        Star star;
        if (!star.gather(mesh, apex, kMaxHoleCorners - 1)) continue;
        const PointError::Hole hole(errors, star, apex);
        for (int i = 0; i < star.linkSize; ++i)
          for (int j = i + 1; j < star.linkSize; ++j)
            for (int m = j + 1; m < star.linkSize; ++m) {
              const VertexId a = star.link[i], b = star.link[j], c = star.link[m];
              if (plan.orientation(a, b, c) <= 0 || isThin(points[a], points[b], points[c])) continue;
              const bool isCovered = plan.orientation(a, b, apex) >= 0 && plan.orientation(b, c, apex) >= 0 &&
                                     plan.orientation(c, a, apex) >= 0;
              covering += isCovered;
              const double exact = exactDifference(points[a], points[b], points[c], points[apex]);
              const double expected = isCovered ? std::abs(exact) : 0, slack = 1e-6 * (1 + std::abs(exact));
              SignedBound bound;
              ASSERT_NEAR(hole.maximum(i, j, m, 1e300), expected, slack);
              ASSERT_NEAR(hole.maximum(i, j, m, 1e300, bound), expected, slack);
              ASSERT_NEAR(bound.above, isCovered ? std::max(exact, 0.0) : 0, slack);
              ASSERT_NEAR(bound.below, isCovered ? std::max(-exact, 0.0) : 0, slack);
              if (isCovered) {
                ASSERT_NEAR(hole.apexError(i, j, m), expected, slack);
              }
            }
      }
      EXPECT_GT(covering, 10) << family.name;
    }
}

}  // namespace
}  // namespace arete
