// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/criterion.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/surface/tolerance.h"
#include "engine/criteria/space_region.h"
#include "engine/criteria/view_error.h"

namespace arete {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

Result<SpaceRegion> readRegion(const std::string& text) {
  const std::string option = fmt::format("--region {}", text);
  const Result<std::vector<double>> numbers = parseNumbers(option, text);
  if (!numbers || (numbers->size() != 4 && numbers->size() != 6))
    return failure(ErrorCode::usage,
                   "the region of a surface is a box x0,y0,z0,x1,y1,z1 or a ball x,y,z,r in the file's unit",
                   option);
  const std::vector<double>& n = *numbers;
  SpaceRegion region;
  if (n.size() == 4) {
    region.shape = SpaceRegion::Shape::ball;
    region.centre = {n[0], n[1], n[2]};
    region.radius = n[3];
    if (!(region.radius >= 0)) return failure(ErrorCode::usage, "the radius is negative", option);
    return region;
  }
  region.low = {n[0], n[1], n[2]};
  region.high = {n[3], n[4], n[5]};
  if (n[0] > n[3] || n[1] > n[4] || n[2] > n[5])
    return failure(ErrorCode::usage, "the lowest coordinates come first, then the highest", option);
  return region;
}

Result<View> readView(const CriterionArguments::OfSurface& asked, const SurfaceModel& model) {
  const std::string option = fmt::format("--camera {}", asked.camera);
  const Result<std::vector<double>> numbers = parseNumbers(option, asked.camera);
  if (!numbers || (numbers->size() != 6 && numbers->size() != 7))
    return failure(
        ErrorCode::usage,
        "the camera of a surface is x,y,z of the eye, x,y,z of what it looks at and perhaps a field "
        "of view in degrees",
        option);
  const std::vector<double>& n = *numbers;
  if (n.size() == 7 && asked.fieldOfView)
    return failure(ErrorCode::usage, "cannot be combined with a field of view in --camera", "--fov");
  const MetricFrame& metric = model.mt.arrays().metric;
  View view;
  view.eye = metric.toMetric({n[0], n[1], n[2]});
  view.forward = metric.toMetric({n[3], n[4], n[5]}) - view.eye;
  const double length = norm(view.forward);
  if (!(length > 0)) return failure(ErrorCode::usage, "the eye is at what it looks at", option);
  const Vec3 up = model.up == "y" ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const bool isAlong = norm(cross(view.forward / length, up)) < 1e-6;
  view.up = isAlong ? Vec3{1, 0, 0} : up;
  const double degrees = n.size() == 7 ? n[6] : asked.fieldOfView.value_or(60);
  view.verticalFieldOfView = degrees / 180 * std::numbers::pi;
  if (!asked.viewport.empty()) {
    const auto viewport = twoNumbers("--viewport", asked.viewport, 'x');
    if (!viewport) return tl::unexpected(viewport.error());
    view.widthPixels = viewport->first;
    view.heightPixels = viewport->second;
  }
  if (const Status valid = view.validate(); !valid)
    return failure(valid.error().code, valid.error().message, option);
  return view;
}

}  // namespace

Result<std::unique_ptr<const Criterion>> surfaceCriterion(const CriterionArguments::OfSurface& asked,
                                                          std::optional<double> maxError,
                                                          const SurfaceModel& model) {
  double outside = kNoLimit;
  if (!asked.outsideError.empty()) {
    const auto stated = parseSurfaceTolerances("--outside-error", asked.outsideError, model.diagonal);
    if (!stated) return tl::unexpected(stated.error());
    if (stated->size() != 1) return failure(ErrorCode::usage, "takes one distance", "--outside-error");
    outside = stated->front().distance;
    if (maxError && outside < *maxError)
      return failure(
          ErrorCode::usage,
          fmt::format("{} is below the error {} inside; it must not be smaller", outside, *maxError),
          "--outside-error");
  }
  const MetricFrame& metric = model.mt.arrays().metric;
  if (!asked.region.empty()) {
    const Result<SpaceRegion> region = readRegion(asked.region);
    if (!region) return tl::unexpected(region.error());
    return std::make_unique<SpaceRegionError>(*region, metric, maxError.value_or(0), outside);
  }
  if (!asked.camera.empty()) {
    const Result<View> view = readView(asked, model);
    if (!view) return tl::unexpected(view.error());
    // With a budget the smallest possible one.
    const double pixels = asked.pixelError.value_or(asked.maxTriangles ? 1e-3 : 1);
    return std::make_unique<ViewError>(
        ViewError::Options{.view = *view, .pixels = pixels, .outsideError = outside}, metric);
  }
  return std::make_unique<UniformError>(maxError.value_or(0));
}

}  // namespace arete
