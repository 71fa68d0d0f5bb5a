// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "terrain/validate_model.h"

namespace arete {

Status validateDelaunayFront(const TerrainModel& model, const Cut& cut) {
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
  struct HalfEdge {
    std::uint32_t low, high, opposite, triangle;
  };
  std::vector<HalfEdge> edges;
  edges.reserve(cut.triangles.size() * 3);
  for (std::uint32_t t = 0; t < cut.triangles.size(); ++t) {
    const auto& c = cut.triangles[t];
    if (CGAL::orientation(points[c[0]], points[c[1]], points[c[2]]) != CGAL::COUNTERCLOCKWISE)
      return failure(ErrorCode::brokenPromise,
                     fmt::format("law 5: triangle {} of the front has no positive area", cut.ids[t]));
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t u = c[i], v = c[(i + 1) % 3];
      edges.push_back({std::min(u, v), std::max(u, v), c[(i + 2) % 3], t});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& x, const HalfEdge& y) {
    return x.low != y.low ? x.low < y.low : x.high != y.high ? x.high < y.high : x.triangle < y.triangle;
  });
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const HalfEdge &e = edges[i], &g = edges[i + 1];
    if (e.low != g.low || e.high != g.high) continue;
    const auto& c = cut.triangles[e.triangle];
    if (CGAL::side_of_oriented_circle(points[c[0]], points[c[1]], points[c[2]], points[g.opposite]) ==
        CGAL::ON_POSITIVE_SIDE)
      return failure(ErrorCode::brokenPromise,
                     fmt::format("law 9: vertex {} lies inside the circle of triangle {} of the front",
                                 cut.vertices[g.opposite], cut.ids[e.triangle]));
  }
  return {};
}

}  // namespace arete
