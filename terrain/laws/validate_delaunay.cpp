// SPDX-License-Identifier: GPL-3.0-or-later
//
// All triangles are tested for their orientation; then, for each edge with two triangles, the opposite corner
// of one is tested against the circumcircle of the other. Both use exact predicates on coordinates scaled to
// the metric of the build, which is exact too.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/laws/front_edges.h"
#include "engine/parallel/first_bad.h"
#include "terrain/laws/validate_model.h"

namespace arete {

Status validateDelaunayFront(const TerrainModel& model, const Cut& cut) try {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
  std::vector<Point> points;
  points.reserve(cut.vertices.size());
  for (const std::uint32_t v : cut.vertices) {
    const Vec2 p = model.mt.vertices().planPosition(VertexId(v));
    // Exact: lattice coordinates are small integers, and for points p / q is a power of two.
    if (model.isRaster)
      points.emplace_back(p.x * model.metricP, p.y * model.metricQ);
    else
      points.emplace_back(p.x * (double(model.metricP) / model.metricQ), p.y);
  }
  const auto broken = [](std::string what) { return failure(ErrorCode::brokenPromise, std::move(what)); };
  const auto turned = firstBad(cut.triangles.size(), {}, [&](std::uint32_t t) {
    const auto& c = cut.triangles[t];
    return CGAL::orientation(points[c[0]], points[c[1]], points[c[2]]) != CGAL::COUNTERCLOCKWISE;
  });
  if (turned)
    return broken(fmt::format("law 5: triangle {} of the front has no positive area", cut.ids[*turned]));

  using Side = FrontEdges::Side;
  const auto circleHolds = [&](const Side& side, const Side& other) {
    const auto &c = cut.triangles[side.triangle()], &d = cut.triangles[other.triangle()];
    return CGAL::side_of_oriented_circle(points[c[0]], points[c[1]], points[c[2]],
                                         points[d[(other.corner() + 2) % 3]]) == CGAL::ON_POSITIVE_SIDE;
  };
  const FrontEdges edges(cut);
  const auto problemFrom = [&](std::uint32_t low) {
    std::string problem;
    edges.visitFrom(low, [&](std::span<const Side> sides) {
      for (std::size_t i = 1; i < sides.size() && problem.empty(); ++i) {
        if (!circleHolds(sides[i - 1], sides[i])) continue;
        const auto& other = cut.triangles[sides[i].triangle()];
        problem =
            fmt::format("law 9: vertex {} lies inside the circle of triangle {} of the front",
                        cut.vertices[other[(sides[i].corner() + 2) % 3]], cut.ids[sides[i - 1].triangle()]);
      }
    });
    return problem;
  };
  const auto bad =
      firstBad(edges.vertices(), {}, [&](std::uint32_t low) { return !problemFrom(low).empty(); });
  if (bad) return broken(problemFrom(*bad));
  return {};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
