// SPDX-License-Identifier: GPL-3.0-or-later
//
// A query visits a chain of nodes from the root to a finest triangle, and nearly all of its time is spent on
// fetching their links and vertices from memory. Positions near each other share most of their chains. So
// many positions are visited along a Morton curve [Morton1966]: what one query has fetched is still in the
// cache for the next.
#include "terrain/locate/ground_height.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/base/morton.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/parallel_sort.h"
#include "engine/parallel/shared_progress.h"
#include "engine/parallel/with_threads.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

constexpr std::size_t kPositionsPerTask = 1024;

std::uint32_t mortonKey(Vec2 p, const Box2& box) {
  const auto cell = [](double v, double low, double high) {
    const double t = high > low ? (v - low) / (high - low) : 0;
    return t > 0 ? static_cast<std::uint32_t>(std::min(t, 1.0) * 65535) : 0u;  // NaN too
  };
  return static_cast<std::uint32_t>(mortonCode(cell(p.x, box.xMin, box.xMax), cell(p.y, box.yMin, box.yMax)));
}

struct Visit {
  std::uint32_t key;
  std::uint32_t position;
  bool operator<(const Visit& other) const {
    return key != other.key ? key < other.key : position < other.position;
  }
};

}  // namespace

double GroundHeights::margin(const TerrainModel& model) {
  // The margin covers rounding: a small part of a sample's step, and the last bits of the largest coordinate.
  constexpr double kPart = 1e-9, kLastBits = 0x1p-50;
  if (model.isRaster) {
    const auto& g = model.georeference.geoTransform;
    const Vec2 far = model.toSource({double(model.columns), double(model.rows)});
    const double largest = std::max({std::abs(g[0]), std::abs(g[3]), std::abs(far.x), std::abs(far.y)});
    const double shortestStep = std::min(std::hypot(g[1], g[4]), std::hypot(g[2], g[5]));
    return kPart + kLastBits * largest / shortestStep;
  }
  const Box2 box = planBox(model);
  const double largest =
      std::max({std::abs(box.xMin), std::abs(box.yMin), std::abs(box.xMax), std::abs(box.yMax)});
  const double area = (box.xMax - box.xMin) * (box.yMax - box.yMin);
  return kPart * std::sqrt(area / std::max(1u, model.mt.vertexCount())) + kLastBits * largest;
}

GroundHeights::GroundHeights(const TerrainModel& model)
    : model_(model),
      locator_(model.mt, {.margin = margin(model), .mayFill = model.options.rimTolerance > 0}) {}

std::optional<GroundHeight> GroundHeights::inPlan(Vec2 p, OutwardScale::Code allowed) const {
  const auto belows = model_.mt.column(kBelow), aboves = model_.mt.column(kAbove);
  // Coarse triangles may cover NODATA where rims are simplified, so only the finest ones decide.
  const bool mayStop = model_.options.rimTolerance == 0;
  std::optional<LocatedTriangle> t = locator_.inRoot(p);
  for (std::uint32_t steps = 0; t; ++steps) {
    const std::size_t id = t->triangle.index();
    const bool isFinest = locator_.isFinest(*t);
    const OutwardScale::Code below = belows[id], above = aboves[id];
    if (isFinest || (mayStop && std::max(below, above) <= allowed)) {
      GroundHeight answer{
          .height = locator_.interpolate(t->corners, p), .triangle = t->triangle, .nodesVisited = steps};
      if (!isFinest) {
        answer.below = model_.mt.scale().decode(below);
        answer.above = model_.mt.scale().decode(above);
      }
      return answer;
    }
    t = locator_.finer(*t, p);
  }
  return std::nullopt;
}

std::optional<GroundHeight> GroundHeights::at(Vec2 xy, double maxError) const {
  return inPlan(model_.toPlan(xy), model_.mt.scale().floorCode(maxError));
}

Result<std::vector<std::optional<GroundHeight>>> GroundHeights::at(std::span<const Vec2> positions,
                                                                   double maxError,
                                                                   const RunContext& context) const try {
  if (positions.size() > 0xFFFFFFFFu)
    return failure(ErrorCode::unsupported, "more positions than 32 bits can number");
  const OutwardScale::Code allowed = model_.mt.scale().floorCode(maxError);
  std::vector<std::optional<GroundHeight>> answers(positions.size());
  std::vector<Visit> order(positions.size());
  SharedProgress progress(context, "heights", positions.size());
  context.report("heights", 0);
  // Only the visits follow the curve; answers stay in the order of the positions.
  withThreads(context, [&] {
    parallelFor(std::size_t{0}, positions.size(), [&](std::size_t i) {
      order[i] = {mortonKey(model_.toPlan(positions[i]), locator_.roots().bounds()),
                  static_cast<std::uint32_t>(i)};
    });
    parallelSort(order.begin(), order.end());
    parallelFor(IndexRange<std::size_t>(0, positions.size(), kPositionsPerTask), [&](const auto& range) {
      if (context.cancelled()) return;
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const std::uint32_t index = order[i].position;
        answers[index] = inPlan(model_.toPlan(positions[index]), allowed);
      }
      progress.add(range.size());
    });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the query was stopped");
  context.report("heights", 1);
  return answers;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
