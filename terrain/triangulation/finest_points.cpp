// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points are ordered along a space-filling curve, repeats are dropped, and CGAL inserts the points one by
// one, in rounds, each search starting at the previous point.
#include "terrain/triangulation/finest_points.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/memory/pages.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/parallel_sort.h"
#include "engine/parallel/with_threads.h"
#include "engine/simplify/live_mesh.h"
#include "terrain/model/plan_box.h"
#include "terrain/triangulation/ground_order.h"

namespace arete {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using DataStructure = CGAL::Triangulation_data_structure_2<VertexBase>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, DataStructure>;

using PlacedPoint = std::pair<Kernel::Point_2, std::uint32_t>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// The Delaunay triangulation of points in the order of groundOrder(). Every 256th point is inserted before
/// every 16th, and these before the rest: the search for a point starts at the one before it, which is near,
/// and as few triangles are flipped as in a random order [AmentaChoiRote2003]. It takes 0.6 of the time of
/// CGAL's own order. Empty if all points lie on one line; incomplete if cancelled.
Delaunay insertAlongGround(const std::vector<PlacedPoint>& points, const RunContext& context) {
  constexpr std::size_t kAsk = 1 << 14;  // points between two tests for cancellation
  Delaunay delaunay;
  Delaunay::Face_handle near;
  // A triangle comes first: while all points are on one line, CGAL searches all of them for each.
  const std::span others = std::span(points).subspan(std::min<std::size_t>(2, points.size()));
  const auto beside = std::ranges::find_if(others, [&](const PlacedPoint& p) {
    return !CGAL::collinear(points[0].first, points[1].first, p.first);
  });
  if (beside == others.end()) return delaunay;
  for (const PlacedPoint& corner : {points[0], points[1], *beside}) {
    const auto vertex = delaunay.insert(corner.first, near);
    vertex->info() = corner.second;
    near = vertex->face();
  }

  constexpr std::size_t kRound = 16;
  std::size_t stride = 1;
  while (stride * kRound < points.size()) stride *= kRound;
  for (const std::size_t first = stride; stride > 0; stride /= kRound)
    for (std::size_t k = 0; k < points.size(); k += stride) {
      if (k % kAsk == 0 && context.cancelled()) return delaunay;
      if (stride < first && k % (stride * kRound) == 0) continue;
      const auto vertex = delaunay.insert(points[k].first, near);
      vertex->info() = points[k].second;
      near = vertex->face();
    }
  return delaunay;
}

/// Each from its least corner on, and all by rising corners.
void sort(Triangles& triangles) {
  parallelFor(IndexRange<std::size_t>(0, triangles.size(), 1 << 13), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      auto& t = triangles[i];
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    }
  });
  parallelSort(triangles.begin(), triangles.end());
}

Result<FinestPoints> triangulate(const PointHeightfield& field, double xStretch, const RunContext& context) {
  FinestPoints finest;
  finest.xStretch = xStretch;
  finest.order = groundOrder(field.positions);
  const auto& p = field.positions;
  std::vector<PlacedPoint> input;
  input.reserve(finest.order.size());
  for (std::uint32_t i = 0; i < finest.order.size(); ++i) {
    const std::uint32_t v = finest.order[i];
    if (i > 0 && p[finest.order[i - 1]] == p[v]) {
      const std::uint32_t u = finest.order[input.back().second];
      if (field.heights[u] == field.heights[v]) continue;
      return failure(ErrorCode::degenerate,
                     fmt::format("points {} and {} stand at the same x {}, y {} with heights {} and {}", u, v,
                                 p[v].x, p[v].y, field.heights[u], field.heights[v]),
                     field.source);
    }
    input.emplace_back(Kernel::Point_2(p[v].x * xStretch, p[v].y), i);
  }

  const Delaunay delaunay = insertAlongGround(input, context);
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the triangulation was interrupted");
  if (delaunay.dimension() < 2)
    return failure(ErrorCode::degenerate,
                   input.empty() ? "there is no point"
                                 : fmt::format("all {} points lie on one line of the plan", input.size()),
                   field.source);
  finest.triangles.reserve(delaunay.number_of_faces());
  for (const auto& face : delaunay.finite_face_handles())
    finest.triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  sort(finest.triangles);
  return finest;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> FinestPoints::trianglesOfPoints() const {
  Triangles ofPoints = triangles;
  for (auto& triangle : ofPoints)
    for (std::uint32_t& corner : triangle) corner = order[corner];
  return ofPoints;
}

Result<FinestPoints> finestPoints(const PointHeightfield& field, const RunContext& context) try {
  ARETE_CHECK(field.validate());
  if (field.size() > LiveMesh::kMostTriangles / 2)
    return failure(ErrorCode::unsupported,
                   fmt::format("{} points have more triangles than 32-bit half-edges can name", field.size()),
                   field.source);
  context.report("triangulate", 0);
  const StageClock::Scope stage(context.clock, "triangulate");
  Result<FinestPoints> finest =
      withThreads(context, [&] { return triangulate(field, pointMetricStretch(field), context); });
  giveFreeHeapBack();  // CGAL's triangulation was as large as half a build
  context.report("triangulate", 1);
  return finest;
} catch (...) {
  return caughtFailure();
}

double pointMetricStretch(const PointHeightfield& field) {
  if (field.size() == 0) return 1;
  const Box2 box = planBox(field.positions);
  const Vec2 grid = field.georeference.toGrid((box.xMin + box.xMax) / 2, (box.yMin + box.yMax) / 2);
  const Vec2 step = groundStep(field.georeference, grid.x, grid.y);
  const double aspect = step.x / step.y;
  if (!(aspect > 0) || !std::isfinite(aspect)) return 1;
  return std::exp2(std::round(std::clamp(std::log2(aspect), -16.0, 16.0)));
}

}  // namespace arete
