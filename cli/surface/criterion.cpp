// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/criterion.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <system_error>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/surface/camera.h"
#include "cli/mesh/tolerance.h"
#include "engine/criteria/space_region.h"
#include "engine/criteria/view_error.h"
#include "io/exchange/mesh_formats.h"
#include "surface/region/closed_mesh_region.h"

namespace arete {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

using RegionPtr = std::shared_ptr<const SpaceRegion>;

/// Of a closed mesh in a file.
Result<RegionPtr> readRegionMesh(const std::string& path, const RunContext& context) {
  const Result<MeshFile> file = readMesh(path, context);
  if (!file) return tl::unexpected(file.error());
  const auto region = ClosedMeshRegion::create(file->mesh);
  if (!region) return failure(region.error().code, region.error().message, path);
  return RegionPtr(*region);
}

Result<RegionPtr> readRegion(const std::string& text, const RunContext& context) {
  const std::string option = fmt::format("--region {}", text);
  const Result<std::vector<double>> numbers = parseNumbers(option, text);
  std::error_code ignored;
  if (!numbers && std::filesystem::exists(text, ignored)) return readRegionMesh(text, context);
  if (!numbers || (numbers->size() != 4 && numbers->size() != 6))
    return failure(
        ErrorCode::usage,
        "the region of a surface is a box x0,y0,z0,x1,y1,z1 or a ball x,y,z,r in the file's unit, or "
        "a file of a closed mesh",
        option);
  const std::vector<double>& n = *numbers;
  if (n.size() == 4) {
    if (!(n[3] >= 0)) return failure(ErrorCode::usage, "the radius is negative", option);
    return RegionPtr(std::make_shared<BallRegion>(Vec3{n[0], n[1], n[2]}, n[3]));
  }
  if (n[0] > n[3] || n[1] > n[4] || n[2] > n[5])
    return failure(ErrorCode::usage, "the lowest coordinates come first, then the highest", option);
  return RegionPtr(std::make_shared<BoxRegion>(Vec3{n[0], n[1], n[2]}, Vec3{n[3], n[4], n[5]}));
}

Result<View> readView(const CriterionArguments::OfSurface& asked, const SurfaceModel& model) {
  const std::string option = fmt::format("--camera {}", asked.camera);
  const Result<SurfaceCamera> camera = readSurfaceCamera(asked.camera);
  if (!camera) return tl::unexpected(camera.error());
  if (camera->fieldOfView && asked.fieldOfView)
    return failure(ErrorCode::usage, "cannot be combined with a field of view in --camera", "--fov");
  const MetricFrame& metric = model.mt.arrays().metric;
  View view;
  view.eye = metric.toMetric(camera->eye);
  view.forward = metric.toMetric(camera->target) - view.eye;
  const double length = norm(view.forward);
  if (!(length > 0)) return failure(ErrorCode::usage, "the eye is at what it looks at", option);
  const Vec3 up = model.up == "y" ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const bool isAlong = norm(cross(view.forward / length, up)) < 1e-6;
  view.up = isAlong ? Vec3{1, 0, 0} : up;
  const double degrees = camera->fieldOfView.value_or(asked.fieldOfView.value_or(60));
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
                                                          const SurfaceModel& model,
                                                          const RunContext& context) {
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
    const Result<RegionPtr> region = readRegion(asked.region, context);
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
