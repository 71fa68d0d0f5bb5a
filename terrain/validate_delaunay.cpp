// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/front_edges.h"
#include "terrain/validate_model.h"

namespace arete {
namespace {

/// The least i in [0, size) for which isBad(i).
template <class IsBad>
std::optional<std::uint32_t> firstIn(std::uint32_t size, const IsBad& isBad) {
  const std::uint32_t first = tbb::parallel_reduce(
      tbb::blocked_range<std::uint32_t>(0, size, 4096), size,
      [&](const auto& range, std::uint32_t found) {
        for (std::uint32_t i = range.begin(); i != range.end() && i < found; ++i)
          if (isBad(i)) found = i;
        return found;
      },
      [](std::uint32_t x, std::uint32_t y) { return std::min(x, y); });
  return first < size ? std::optional(first) : std::nullopt;
}

}  // namespace

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
  const auto broken = [](std::string what) { return failure(ErrorCode::brokenPromise, std::move(what)); };
  const auto turned = firstIn(static_cast<std::uint32_t>(cut.triangles.size()), [&](std::uint32_t t) {
    const auto& c = cut.triangles[t];
    return CGAL::orientation(points[c[0]], points[c[1]], points[c[2]]) != CGAL::COUNTERCLOCKWISE;
  });
  if (turned)
    return broken(fmt::format("law 5: triangle {} of the front has no positive area", cut.ids[*turned]));

  using Side = FrontEdges::Side;
  const auto holds = [&](const Side& side, const Side& other) {
    const auto &c = cut.triangles[side.triangle()], &d = cut.triangles[other.triangle()];
    return CGAL::side_of_oriented_circle(points[c[0]], points[c[1]], points[c[2]],
                                         points[d[(other.corner() + 2) % 3]]) == CGAL::ON_POSITIVE_SIDE;
  };
  const FrontEdges edges(cut);
  const auto problemFrom = [&](std::uint32_t low) {
    std::string problem;
    edges.visitFrom(low, [&](std::span<const Side> sides) {
      if (sides.size() < 2 || !problem.empty() || !holds(sides[0], sides[1])) return;
      const auto& other = cut.triangles[sides[1].triangle()];
      problem = fmt::format("law 9: vertex {} lies inside the circle of triangle {} of the front",
                            cut.vertices[other[(sides[1].corner() + 2) % 3]], cut.ids[sides[0].triangle()]);
    });
    return problem;
  };
  const auto bad = firstIn(edges.vertices(), [&](std::uint32_t low) { return !problemFrom(low).empty(); });
  if (bad) return broken(problemFrom(*bad));
  return {};
}

}  // namespace arete
