// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/criterion.h"

#include <fmt/format.h>

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
  if (asked.fieldOfView) camera.verticalFieldOfViewDegrees = *asked.fieldOfView;
  if (!asked.viewport.empty()) {
    ARETE_TRY(const auto viewport, twoNumbers("--viewport", asked.viewport, 'x'));
    camera.widthPixels = viewport.first;
    camera.heightPixels = viewport.second;
  }
  return camera;
}

}  // namespace

Result<SurfaceCriterion> readSurfaceCriterion(const CriterionArguments::OfSurface& asked,
                                              std::optional<double> maxError,
                                              std::optional<std::uint32_t> maxTriangles,
                                              const SurfaceModel& model, const RunContext& context) {
  SurfaceCriterion criterion;
  criterion.maxError = maxError;
  criterion.maxTriangles = maxTriangles;
  criterion.pixelError = asked.pixelError;
  if (asked.isSaturated) criterion.method = CutMethod::saturated;
  if (!asked.outsideError.empty()) {
    ARETE_TRY(const auto stated,
              parseSurfaceTolerances("--outside-error", asked.outsideError, model.diagonal));
    if (stated.size() != 1) return failure(ErrorCode::usage, "takes one distance", "--outside-error");
    criterion.outsideError = stated.front().distance;
  }
  if (!asked.region.empty()) {
    ARETE_TRY(auto region, readSurfaceRegion(asked.region, context));
    criterion.region = std::move(region);
  }
  if (!asked.camera.empty()) {
    ARETE_TRY(const auto camera, readStatedCamera(asked));
    criterion.camera = camera;
  }
  // Its errors name fields; here they are options.
  if (const auto valid = engineCriterion(criterion, model); !valid) {
    const bool isOfCamera = valid.error().culprit == "camera";
    return failure(valid.error().code, valid.error().message,
                   isOfCamera ? fmt::format("--camera {}", asked.camera) : "--outside-error");
  }
  return criterion;
}

}  // namespace arete
