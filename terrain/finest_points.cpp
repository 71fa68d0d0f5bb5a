// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/finest_points.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace arete {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using DataStructure = CGAL::Triangulation_data_structure_2<VertexBase>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, DataStructure>;

struct Extent {
  double xLow = std::numeric_limits<double>::infinity(), xHigh = -xLow, yLow = xLow, yHigh = -xLow;
};

}  // namespace

Result<std::vector<std::array<std::uint32_t, 3>>> finestTriangulation(const PointHeightfield& field,
                                                                      double xStretch) {
  std::vector<std::uint32_t> order(field.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto& p = field.positions;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (p[a].x != p[b].x) return p[a].x < p[b].x;
    if (p[a].y != p[b].y) return p[a].y < p[b].y;
    return a < b;
  });
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> input;
  input.reserve(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t v = order[i];
    if (i > 0 && p[order[i - 1]] == p[v]) {
      const std::uint32_t u = input.back().second;
      if (field.heights[u] == field.heights[v]) continue;
      return failure(ErrorCode::degenerate,
                     fmt::format("points {} and {} stand at the same x {}, y {} with heights {} and {}", u, v,
                                 p[v].x, p[v].y, field.heights[u], field.heights[v]),
                     field.source);
    }
    input.emplace_back(Kernel::Point_2(p[v].x * xStretch, p[v].y), v);
  }

  Delaunay delaunay;
  delaunay.insert(input.begin(), input.end());
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (delaunay.dimension() < 2)
    return failure(ErrorCode::degenerate,
                   input.empty() ? "there is no point"
                                 : fmt::format("all {} points lie on one line of the plan", input.size()),
                   field.source);
  triangles.reserve(delaunay.number_of_faces());
  for (const auto& face : delaunay.finite_face_handles()) {
    std::array<std::uint32_t, 3> t{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

double pointMetricStretch(const PointHeightfield& field) {
  if (field.size() == 0) return 1;
  Extent e;
  for (const Vec2& q : field.positions)
    e = {std::min(e.xLow, q.x), std::max(e.xHigh, q.x), std::min(e.yLow, q.y), std::max(e.yHigh, q.y)};
  const Vec2 grid = field.georeference.toGrid((e.xLow + e.xHigh) / 2, (e.yLow + e.yHigh) / 2);
  const Vec2 step = groundStep(field.georeference, grid.x, grid.y);
  const double aspect = step.x / step.y;
  if (!(aspect > 0) || !std::isfinite(aspect)) return 1;
  return std::exp2(std::round(std::clamp(std::log2(aspect), -16.0, 16.0)));
}

}  // namespace arete
