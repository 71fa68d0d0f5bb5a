// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/criterion.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/criteria/refine_order.h"
#include "engine/criteria/view_error.h"

namespace arete {
namespace {

/// The pixel error where a budget alone ends the cut: only triangles without an error satisfy it.
constexpr double kNoPixelsAllowed = 1e-9;

}  // namespace

std::string_view fitName(ExtractFit fit) {
  switch (fit) {
    case ExtractFit::triangles:
      return "triangles";
    case ExtractFit::error:
      return "error";
    default:
      return "none";
  }
}

Result<std::shared_ptr<const BoundedCriterion>> engineCriterion(const ExtractCriterion& c,
                                                                const std::optional<Region>& region,
                                                                double reserve,
                                                                const TerrainModel& model) try {
  const MetricFrame& metric = model.mt.metric();
  const double maxError = std::max(0.0, c.maxError.value_or(0) - reserve);
  const double outsideError = std::max(maxError, c.outsideError);
  if (c.camera) {
    ARETE_TRY(const View view, viewOf(*c.camera, model));
    return std::make_shared<ViewError>(
        ViewError::Options{
            .view = view, .pixels = c.pixelError.value_or(kNoPixelsAllowed), .outsideError = outsideError},
        metric);
  }
  if (c.focus)
    return std::make_shared<DistanceError>(
        DistanceError::Options{.place = metricPosition(c.focus->xy, metric.origin.z, model),
                               .inPlan = true,
                               .nearError = maxError,
                               .growth = c.focus->growth,
                               .farError = outsideError});
  if (region) return std::make_shared<RegionError>(*region, metric, maxError, outsideError);
  return std::make_shared<UniformError>(maxError);
} catch (...) {
  return caughtFailure();
}

Result<RequiredError> requiredBy(std::span<const ExtractCriterion> criteria,
                                 const std::optional<Region>& region, const TerrainModel& outline) try {
  std::vector<std::shared_ptr<const BoundedCriterion>> parts;
  for (const ExtractCriterion& c : criteria) {
    if (!c.maxError || c.camera || c.fit != ExtractFit::none) return RequiredError();
    ARETE_TRY(const auto part, engineCriterion(c, region, 0, outline));
    parts.push_back(part);
  }
  return RequiredError([parts, metric = outline.mt.metric()](const Box2& box) {
    // None of these criteria depends on heights.
    const Vec3 low = metric.toMetric({box.xMin, box.yMin, 0}),
               high = metric.toMetric({box.xMax, box.yMax, 0});
    const Vec2 middle{(low.x + high.x) / 2, (low.y + high.y) / 2};
    const double radius = std::hypot(high.x - low.x, high.y - low.y) / 2;
    const double rounded = 1e-6 * (std::fabs(middle.x) + std::fabs(middle.y) + radius);
    const Sphere around{static_cast<float>(middle.x), static_cast<float>(middle.y), 0,
                        static_cast<float>(radius + rounded)};
    double least = std::numeric_limits<double>::infinity();
    for (const auto& part : parts) least = std::min(least, part->allowedError(around));
    return least;
  });
} catch (...) {
  return caughtFailure();
}

Result<CutOptions> engineOptions(const ExtractCriterion& c, const TerrainModel& model) try {
  CutOptions options{.method = c.method, .maxTriangles = c.maxTriangles};
  if (c.order == ExtractOrder::breadth) options.order = std::make_shared<BreadthFirst>();
  if (c.order == ExtractOrder::depth) options.order = std::make_shared<DepthFirst>();
  if (c.order == ExtractOrder::twoQueues) {
    if (!c.camera) return failure(ErrorCode::usage, "two queues need a camera; state `camera`", "order");
    ARETE_TRY(const View view, viewOf(*c.camera, model));
    options.order = std::make_shared<TwoQueues>(TwoQueues::Options{.view = view});
  }
  if (c.deadlineMilliseconds)
    options.deadline = Deadline::in(std::chrono::duration<double, std::milli>(*c.deadlineMilliseconds));
  return options;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
