// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bound along an edge against fractions: wherever the edge meets the finest triangulation, told exactly.
#include "terrain/error/point_error.h"

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

#include <cmath>

#include "datasets/families.h"
#include "engine/base/id_array.h"
#include "engine/ids_of.h"
#include "terrain/builder/checks.h"
#include "terrain/triangulation/finest_points.h"

namespace arete {
namespace {

using ExactEdge = CGAL::Exact_rational;

/// A finest triangulation, and the error of its points as a build has it.
struct Ground {
  explicit Ground(const PointHeightfield& field) : finest(*finestPoints(field)) {
    for (const std::uint32_t v : finest.order)
      points.push_back({field.positions[v].x, field.positions[v].y, field.heights[v]});
    std::vector<VertexId> pinched;
    mesh = LiveMesh::fromTriangles(finest.triangles, static_cast<std::uint32_t>(points.size()), pinched);
  }
  FinestPoints finest;
  IdArray<VertexId, std::vector<Vec3>> points;
  LiveMesh mesh;
};

struct ExactBound {
  ExactEdge below = 0, above = 0;
};

ExactBound exactAlong(const Ground& ground, const PointPlan& plan, VertexId a, VertexId b) {
  struct Place {
    ExactEdge x, y, z;
  };
  const auto placeOf = [&](VertexId v) {
    const Vec3& p = ground.points[v];
    return Place{p.x, p.y, p.z};
  };
  const Place pa = placeOf(a), pb = placeOf(b);
  const ExactEdge dx = pb.x - pa.x, dy = pb.y - pa.y;
  ExactBound bound;
  const auto meet = [&](const Place& p) {
    const ExactEdge along = ((p.x - pa.x) * dx + (p.y - pa.y) * dy) / (dx * dx + dy * dy);
    if (along < 0 || along > 1) return;
    const ExactEdge difference = pa.z + along * (pb.z - pa.z) - p.z;
    bound.above = std::max(bound.above, difference);
    bound.below = std::max(bound.below, ExactEdge(-difference));
  };
  for (const auto& t : ground.finest.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId u(t[i]), w(t[(i + 1) % 3]);
      const int side = plan.orientation(a, b, u);
      const Place pu = placeOf(u), pw = placeOf(w);
      if (side == 0) meet(pu);
      if (side * plan.orientation(a, b, w) >= 0) continue;
      const auto sideOf = [&](const Place& p) { return ExactEdge(dx * (p.y - pa.y) - dy * (p.x - pa.x)); };
      const ExactEdge part = sideOf(pu) / (sideOf(pu) - sideOf(pw));
      meet({pu.x + part * (pw.x - pu.x), pu.y + part * (pw.y - pu.y), pu.z + part * (pw.z - pu.z)});
    }
  return bound;
}

/// Between all of some vertices, near each other on the ground and far.
void expectBoundsAlongEdges(const PointHeightfield& field, const std::string& name) {
  const Ground ground(field);
  const PointPlan plan(ground.points, ground.finest.xStretch);
  const PointError errors(plan, ground.points, ground.mesh);
  const auto [low, high] = std::ranges::minmax(field.heights);
  const double slack = roundingSlack(low, high);
  const auto count = static_cast<std::uint32_t>(ground.points.size());
  for (const VertexId a : test::idsBelow<VertexId>(count))
    for (const std::uint32_t steps : {1u, 2u, 7u, 31u}) {
      const VertexId b((a.index() + steps) % count);
      if (a == b || !ground.mesh.isInTriangle(a) || !ground.mesh.isInTriangle(b)) continue;
      const SignedBound bound = errors.alongEdge(a, b).bound;
      const ExactBound exact = exactAlong(ground, plan, a, b);
      ASSERT_LE(exact.above, ExactEdge(bound.above + slack))
          << name << ": " << a.index() << " to " << b.index();
      ASSERT_LE(exact.below, ExactEdge(bound.below + slack))
          << name << ": " << a.index() << " to " << b.index();
    }
}

TEST(PointError, BoundsWhatAnEdgeMeetsOnEveryFamily) {
  for (const PointFamily& family : pointFamilies())
    expectBoundsAlongEdges(family.make(60, 6), std::string(family.name));
}

TEST(PointError, BoundsWhatAnEdgeMeetsAmongRowsThatDoublesBend) {
  for (const double slope : {0.37, 0.1, 1.0 / 3}) {
    PointHeightfield rows, turned;
    for (int i = 0; i < 84; ++i) {
      const double x = 0.7 * (1 + i / 3), row = i % 3, height = i * 37 % 20;
      rows.positions.push_back({x, (slope + 0.1 * row) * x});
      rows.heights.push_back(height);
      const double column = i % 12,
                   line = 1 + i / 12;  // a grid that is turned, and its lines not quite straight
      turned.positions.push_back({line - slope * column, slope * line + column});
      turned.heights.push_back(height);
    }
    expectBoundsAlongEdges(rows, "rows " + std::to_string(slope));
    expectBoundsAlongEdges(turned, "grid " + std::to_string(slope));
  }
}

TEST(PointError, BoundsWhatAnEdgeMeetsThatIsSteepAndShort) {
  PointHeightfield field;
  field.positions = {{0, 0}, {1e-6, 0}, {5e-7, -1e6}, {5e-7, 1e6}, {4e-7, 1e-9}, {6e-7, -1e-9}, {3e-7, 2e-9}};
  field.heights = {0, 5000, 7, 3, 1, 9, 4};
  expectBoundsAlongEdges(field, "steep");
  // So short that its square is no double.
  field.positions = {{0, 0}, {5e-324, 5e-324}, {1, -1}, {-1, 1}, {0, 5e-324}, {5e-324, 0}, {2, 2}};
  expectBoundsAlongEdges(field, "short");
}

}  // namespace
}  // namespace arete
