// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/request/criterion.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/criteria/refine_order.h"
#include "engine/criteria/space_region.h"
#include "engine/criteria/view_error.h"
#include "surface/front/attribute_criterion.h"

namespace arete {
namespace {

/// The pixel error where a budget alone ends the cut: only triangles without an error satisfy it.
constexpr double kNoPixelsAllowed = 1e-9;
/// The same of a surface.
constexpr double kLeastPixels = 1e-3;

}  // namespace

std::string_view fitName(CutFit fit) {
  switch (fit) {
    case CutFit::triangles:
      return "triangles";
    case CutFit::error:
      return "error";
    case CutFit::unbiased:
      return "unbiased";
    case CutFit::rms:
      return "rms";
    default:
      return "none";
  }
}

std::string_view orderName(CutOrder order) {
  switch (order) {
    case CutOrder::worst:
      return "worst";
    case CutOrder::breadth:
      return "breadth";
    case CutOrder::depth:
      return "depth";
    case CutOrder::twoQueues:
      return "two-queues";
    default:
      return "usual";
  }
}

Result<std::shared_ptr<const BoundedCriterion>> engineCriterion(const CutRequest& c,
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

Result<std::shared_ptr<const BoundedCriterion>> engineCriterion(const CutRequest& c,
                                                                const SurfaceModel& model) try {
  if (c.maxError && !(c.outsideError >= *c.maxError))
    return failure(
        ErrorCode::usage,
        fmt::format("{} is below the error {} inside; it must not be smaller", c.outsideError, *c.maxError),
        "outsideError");
  const MetricFrame& metric = model.mt.metric();
  const double maxError = c.maxError.value_or(0);
  if (c.spaceRegion)
    return std::make_shared<SpaceRegionError>(c.spaceRegion, metric, maxError, c.outsideError);
  if (c.spaceCamera) {
    ARETE_TRY(const View view, viewOf(*c.spaceCamera, model));
    const double pixels = c.pixelError.value_or(c.maxTriangles ? kLeastPixels : 1);
    return std::make_shared<ViewError>(
        ViewError::Options{.view = view, .pixels = pixels, .outsideError = c.outsideError}, metric);
  }
  if (c.focus) {
    const double moved = c.focus->growth * model.positionError;
    return std::make_shared<DistanceError>(DistanceError::Options{
        .place = metric.toMetric({c.focus->xy.x, c.focus->xy.y, c.focus->z.value_or(0)}),
        .nearError = std::max(0.0, maxError - moved),
        .growth = c.focus->growth,
        .farError = c.outsideError});
  }
  return std::make_shared<UniformError>(maxError);
} catch (...) {
  return caughtFailure();
}

double errorLeftByRounding(const SurfaceModel& model, const Criterion& criterion, const Cut& cut) {
  double left = 0;
  if (model.positionError == 0) return left;
  for (const std::uint32_t id : cut.ids) {
    const TriangleId t(id);
    if (model.mt.remover(t).isValid() || model.mt.error(t) <= left) continue;
    if (!criterion.isFineEnough(model.mt, t, model.mt.corners(t))) left = model.mt.error(t);
  }
  return left;
}

Result<RequiredError> requiredBy(std::span<const CutRequest> criteria, const std::optional<Region>& region,
                                 const TerrainModel& outline) try {
  std::vector<std::shared_ptr<const BoundedCriterion>> parts;
  for (const CutRequest& c : criteria) {
    if (!c.maxError || c.camera || c.fit != CutFit::none) return RequiredError();
    ARETE_TRY(const auto part, engineCriterion(c, region, 0, outline));
    parts.push_back(part);
  }
  return requiredInPlan([parts, metric = outline.mt.metric()](const Box2& box) {
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

namespace {

/// @param view of the request's camera, where it has one.
Result<CutOptions> optionsWith(const CutRequest& request, const std::optional<View>& view) {
  CutOptions options{.method = request.method, .maxTriangles = request.maxTriangles};
  // Without an order the engine refines the worst first.
  if (request.order == CutOrder::breadth) options.order = std::make_shared<BreadthFirst>();
  if (request.order == CutOrder::depth) options.order = std::make_shared<DepthFirst>();
  if (request.order == CutOrder::twoQueues) {
    if (!view) return failure(ErrorCode::usage, "two queues need a camera; state `camera`", "order");
    options.order = std::make_shared<TwoQueues>(TwoQueues::Options{.view = *view});
  }
  if (request.deadlineMilliseconds)
    options.deadline = Deadline::in(std::chrono::duration<double, std::milli>(*request.deadlineMilliseconds));
  return options;
}

}  // namespace

Result<CutOptions> engineOptions(const CutRequest& request, const TerrainModel& model) try {
  std::optional<View> view;
  if (request.camera && request.order == CutOrder::twoQueues) {
    ARETE_TRY(const View ofCamera, viewOf(*request.camera, model));
    view = ofCamera;
  }
  return optionsWith(request, view);
} catch (...) {
  return caughtFailure();
}

Result<CutOptions> engineOptions(const CutRequest& request, const SurfaceModel& model) try {
  std::optional<View> view;
  if (request.spaceCamera && request.order == CutOrder::twoQueues) {
    ARETE_TRY(const View ofCamera, viewOf(*request.spaceCamera, model));
    view = ofCamera;
  }
  ARETE_TRY(CutOptions options, optionsWith(request, view));
  const bool isLimited = request.maxTriangles || request.deadlineMilliseconds;
  const bool isEverywhere = !request.spaceRegion && !request.spaceCamera && !request.focus;
  if (request.order == CutOrder::usual && isLimited && isEverywhere && request.method == CutMethod::minimal)
    options.order = model.attributeErrors.empty()
                        ? std::shared_ptr<const RefineOrder>(std::make_shared<LargestSquaresFirst>())
                        : std::make_shared<LargestChangesFirst>(model);
  return options;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
