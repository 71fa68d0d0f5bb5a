// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/criterion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/mesh/tolerance.h"
#include "cli/surface/camera.h"
#include "io/query/surface/region.h"

namespace arete {
namespace {

Result<std::shared_ptr<const SpaceRegion>> readSurfaceRegion(const std::string& text,
                                                             const RunContext& context) {
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
  const auto region = regionOfNumbers(*numbers);
  if (!region) return failure(region.error().code, region.error().message, option);
  return *region;
}

Result<SurfaceCamera> readStatedCamera(const CriterionArguments::OfSurface& asked) {
  ARETE_TRY(const SurfaceCameraArgument stated, readSurfaceCamera(asked.camera));
  if (stated.statesFieldOfView && asked.fieldOfView)
    return failure(ErrorCode::usage, "cannot be combined with a field of view in --camera", "--fov");
  SurfaceCamera camera = stated.camera;
  if (stated.statesFieldOfView && asked.parallelHeight > 0)
    return failure(ErrorCode::usage, "cannot be combined with a field of view in --camera",
                   "--parallel-height");
  if (asked.fieldOfView) camera.verticalFieldOfViewDegrees = *asked.fieldOfView;
  camera.parallelHeight = asked.parallelHeight;
  if (!asked.viewport.empty()) {
    ARETE_TRY(const auto viewport, twoNumbers("--viewport", asked.viewport, 'x'));
    camera.widthPixels = viewport.first;
    camera.heightPixels = viewport.second;
  }
  return camera;
}

}  // namespace

Result<CutRequest> readSurfaceRequest(const CriterionArguments::OfSurface& asked, const SurfaceModel& model,
                                      const RunContext& context) {
  CutRequest request = asked.common;
  if (!asked.outsideError.empty()) {
    ARETE_TRY(const auto stated, parseSurfaceTolerances("--outside-error", asked.outsideError, model.diagonal,
                                                        spaceUnitOf(model)));
    if (stated.size() != 1) return failure(ErrorCode::usage, "takes one distance", "--outside-error");
    request.outsideError = stated.front().distance;
  }
  if (!asked.region.empty()) {
    ARETE_TRY(auto region, readSurfaceRegion(asked.region, context));
    request.spaceRegion = std::move(region);
  }
  if (!asked.camera.empty()) {
    ARETE_TRY(const auto camera, readStatedCamera(asked));
    request.spaceCamera = camera;
    request.cameraText = asked.camera;
  }
  if (!asked.focus.empty()) {
    const std::string option = "--focus " + asked.focus;
    ARETE_TRY(const auto numbers, parseNumbers(option, asked.focus));
    if (numbers.size() != 3 || !std::ranges::all_of(numbers, [](double n) { return std::isfinite(n); }))
      return failure(ErrorCode::usage, "the focus of a surface is x,y,z in the file's unit", option);
    request.focus = {
        .xy = {numbers[0], numbers[1]}, .growth = asked.errorGrowth, .text = asked.focus, .z = numbers[2]};
  }
  return request;
}

Status checkSurfaceRequest(const CutRequest& request, const CriterionArguments::OfSurface& asked,
                           const SurfaceModel& model) {
  // Its errors name fields; here they are options.
  const auto valid = engineCriterion(request, model);
  if (valid) return {};
  const bool isOfCamera = valid.error().culprit == "camera";
  return failure(valid.error().code, valid.error().message,
                 isOfCamera ? fmt::format("--camera {}", asked.camera) : "--outside-error");
}

}  // namespace arete
