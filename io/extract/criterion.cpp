// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/extract/criterion.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/criteria/refine_order.h"
#include "engine/criteria/view_error.h"
#include "io/file/shell_text.h"

namespace arete {
namespace {

/// Where a budget alone decides: no triangle is ever fine enough, but for one without an error.
constexpr double kNoPixelsAllowed = 1e-9;

const char* orderName(ExtractOrder order) {
  switch (order) {
    case ExtractOrder::breadth:
      return "breadth";
    case ExtractOrder::depth:
      return "depth";
    case ExtractOrder::twoQueues:
      return "two-queues";
    default:
      return "worst";
  }
}

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

std::string optionsOf(const ExtractCriterion& c) {
  std::string options;
  const auto add = [&](const char* name, const auto& value) {
    options += fmt::format(" --{} {}", name, value);
  };
  if (c.maxError) add("max-error", *c.maxError);
  if (c.maxTriangles) add("max-triangles", *c.maxTriangles);
  if (!c.region.empty()) add("region", shellQuoted(c.region));
  if (c.distance > 0) add("distance", c.distance);
  if (c.focus) {
    add("focus", shellQuoted(c.focus->text));
    add("error-growth", c.focus->growth);
  }
  if (c.camera) {
    const Camera& camera = *c.camera;
    add("camera", shellQuoted(c.cameraText));
    add("look", fmt::format("{},{}", camera.azimuthDegrees, camera.pitchDegrees));
    add("fov", camera.verticalFieldOfViewDegrees);
    add("viewport", fmt::format("{}x{}", camera.widthPixels, camera.heightPixels));
    if (c.pixelError) add("pixel-error", *c.pixelError);
  }
  if (c.isLonLat) options += " --lonlat";
  if (std::isfinite(c.outsideError)) add("outside-error", c.outsideError);
  if (c.method == CutMethod::saturated) add("method", "saturated");
  if (c.deadlineMilliseconds) add("deadline", *c.deadlineMilliseconds);
  if (c.order != ExtractOrder::worst) add("order", orderName(c.order));
  if (c.fit != ExtractFit::none) add("fit", fitName(c.fit));
  return options;
}

Result<std::shared_ptr<const BoundedCriterion>> engineCriterion(const ExtractCriterion& c,
                                                                const std::optional<Region>& region,
                                                                double reserve, const TerrainModel& model) {
  const MetricFrame& metric = model.mt.arrays().metric;
  const double maxError = std::max(0.0, c.maxError.value_or(0) - reserve);
  const double outsideError = std::max(maxError, c.outsideError);
  if (c.camera) {
    const Result<View> view = viewOf(*c.camera, model);
    if (!view) return tl::unexpected(view.error());
    return std::make_shared<ViewError>(
        ViewError::Options{
            .view = *view, .pixels = c.pixelError.value_or(kNoPixelsAllowed), .outsideError = outsideError},
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
}

Result<RequiredError> requiredBy(std::span<const ExtractCriterion> criteria,
                                 const std::optional<Region>& region, const TerrainModel& outline) {
  std::vector<std::shared_ptr<const BoundedCriterion>> parts;
  for (const ExtractCriterion& c : criteria) {
    if (!c.maxError || c.camera || c.fit != ExtractFit::none) return RequiredError();
    const auto part = engineCriterion(c, region, 0, outline);
    if (!part) return tl::unexpected(part.error());
    parts.push_back(*part);
  }
  return RequiredError([parts, metric = outline.mt.arrays().metric](const Box2& box) {
    // None of these criteria looks at heights.
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
}

Result<CutOptions> engineOptions(const ExtractCriterion& c, const TerrainModel& model) {
  CutOptions options{.method = c.method, .maxTriangles = c.maxTriangles};
  if (c.order == ExtractOrder::breadth) options.order = std::make_shared<BreadthFirst>();
  if (c.order == ExtractOrder::depth) options.order = std::make_shared<DepthFirst>();
  if (c.order == ExtractOrder::twoQueues) {
    if (!c.camera)
      return failure(ErrorCode::usage, "two queues are filled by what a camera sees; state --camera",
                     "--order");
    const Result<View> view = viewOf(*c.camera, model);
    if (!view) return tl::unexpected(view.error());
    options.order = std::make_shared<TwoQueues>(TwoQueues::Options{.view = *view});
  }
  if (c.deadlineMilliseconds)
    options.deadline = Deadline::in(std::chrono::duration<double, std::milli>(*c.deadlineMilliseconds));
  return options;
}

}  // namespace arete
