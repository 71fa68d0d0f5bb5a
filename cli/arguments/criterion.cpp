// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/criterion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/arguments/arguments.h"
#include "io/crs/position_argument.h"
#include "io/extract/camera_argument.h"
#include "terrain/locate/surface_height.h"

namespace arete {
void CriterionArguments::addTo(CLI::App& command) {
  CLI::Option* errors =
      command
          .add_option(
              "--max-error", maxErrors_,
              "Largest vertical error, in the DEM's unit of height; several with commas, one TIN each")
          ->check(tolerances())
          ->type_name("E[,E...]");
  command
      .add_option("--max-triangles", maxTriangles_,
                  "At most so many triangles, spent where the error is largest")
      ->check(wholeNumber(1, 0xFFFFFFFE))
      ->type_name("N")
      ->excludes(errors);
  command
      .add_option("--method", method_,
                  "minimal: the fewest triangles (default); saturated: a little more, sooner")
      ->check(oneOf({"minimal", "saturated"}))
      ->type_name("NAME");

  command
      .add_option("--fit", fit_,
                  "Move the heights of the vertices: for a third fewer triangles within --max-error "
                  "(triangles), or for a smaller error of the same triangles (error)")
      ->check(oneOf({"triangles", "error"}))
      ->type_name("WHAT");

  const std::string where = "Finer here, coarser there";
  CLI::Option* region =
      command
          .add_option("--region", region_,
                      "Where --max-error holds: polygons (any vector file), with --distance lines too, or "
                      "xmin,ymin,xmax,ymax in the DEM's CRS")
          ->type_name("FILE|BOX")
          ->group(where);
  command
      .add_option("--distance", distance_,
                  "All within so many metres of the region belongs to it (without a CRS: the DEM's units)")
      ->check(finiteAbove(0))
      ->needs(region)
      ->type_name("D")
      ->group(where);
  CLI::Option* focus =
      command
          .add_option("--focus", focus_,
                      "Where --max-error holds; it grows by --error-growth with the distance "
                      "from there")
          ->type_name("X,Y")
          ->group(where)
          ->excludes(region);
  CLI::Option* growth = command
                            .add_option("--error-growth", growth_,
                                        "Error for each metre from the focus (without a CRS: for each unit)")
                            ->check(finiteAtLeast(0))
                            ->needs(focus)
                            ->type_name("G")
                            ->group(where);
  focus->needs(growth);
  CLI::Option* camera = command
                            .add_option("--camera", camera_,
                                        "Where a camera stands, H above the ground (agl) or as the DEM's "
                                        "heights (msl, ell): the error counts in pixels of its picture; "
                                        "behind it what --look and --fov say, if it is given here")
                            ->type_name("X,Y,H[agl|msl|ell][,AZIMUTH,PITCH[,FOV]]")
                            ->group(where)
                            ->excludes(region)
                            ->excludes(focus)
                            ->excludes(errors);
  command
      .add_option("--look", look_,
                  "Where it looks, in degrees: clockwise from north, above the horizon (default 0,0)")
      ->needs(camera)
      ->type_name("AZIMUTH,PITCH")
      ->group(where);
  command.add_option("--fov", fieldOfView_, "Its vertical field of view in degrees (default 60)")
      ->check(finiteBetween(0.01, 179))
      ->needs(camera)
      ->type_name("DEG")
      ->group(where);
  command.add_option("--viewport", viewport_, "Its picture in pixels (default 1920x1080)")
      ->needs(camera)
      ->type_name("WxH")
      ->group(where);
  command
      .add_option("--pixel-error", pixelError_,
                  "Largest error in its picture (default 1; under a budget the smallest there is)")
      ->check(finiteAbove(0))
      ->needs(camera)
      ->type_name("P")
      ->group(where);
  command
      .add_option("--outside-error", outsideError_,
                  "Largest error outside the region, out of sight, or far from the focus (default: none, the "
                  "coarsest)")
      ->check(tolerance())
      ->type_name("E")
      ->group(where);
  command.add_flag("--lonlat", isLonLat_, "--focus and --camera are longitude and latitude")->group(where);

  const std::string stop = "When there is not time or room for all";
  command
      .add_option("--deadline", deadline_,
                  "Refine for so many milliseconds at most; what there is then is conforming all the same")
      ->check(finiteAbove(0))
      ->type_name("MS")
      ->group(stop);
  command
      .add_option("--order", order_,
                  "What is refined first under a budget or a deadline: worst (default), breadth, depth, or "
                  "two-queues: what the camera sees before the rest")
      ->check(oneOf({"worst", "breadth", "depth", "two-queues"}))
      ->type_name("NAME")
      ->group(stop);
}

Status CriterionArguments::check() const {
  const bool hasBudget = maxTriangles_ >= 0;
  if (maxErrors_.empty() && !hasBudget && camera_.empty() && deadline_ == 0)
    return failure(ErrorCode::usage,
                   "--max-error, --max-triangles, --camera or --deadline says how fine the TIN shall be");
  if (!std::isnan(outsideError_) && region_.empty() && focus_.empty() && camera_.empty())
    return failure(ErrorCode::usage, "means something only with --region, --focus or --camera",
                   "--outside-error");
  if (isLonLat_ && focus_.empty() && camera_.empty())
    return failure(ErrorCode::usage, "means something only with --focus or --camera", "--lonlat");
  if (method_ == "saturated" && (deadline_ > 0 || order_ != "worst"))
    return failure(ErrorCode::usage, "a saturated cut has no order and no time to stop at",
                   deadline_ > 0 ? "--deadline" : "--order");
  if (order_ != "worst" && !hasBudget && deadline_ == 0)
    return failure(ErrorCode::usage, "means something only with --max-triangles or --deadline", "--order");
  if (order_ == "two-queues" && camera_.empty())
    return failure(ErrorCode::usage, "two queues are filled by what a camera sees; state --camera",
                   "--order");
  return checkFit();
}

Status CriterionArguments::checkFit() const {
  if (fit_ == "none") return {};
  const std::string option = "--fit " + fit_;
  if (!camera_.empty() || !focus_.empty() || deadline_ > 0)
    return failure(ErrorCode::usage, "cannot be had with --camera, --focus or --deadline", option);
  if (fit_ == "triangles" && maxErrors_.empty())
    return failure(ErrorCode::usage, "means fewer triangles within a tolerance; state --max-error", option);
  if (fit_ == "triangles" && method_ == "saturated")
    return failure(ErrorCode::usage, "begins with the minimal cut; leave --method out", option);
  if (fit_ == "error" && !region_.empty())
    return failure(ErrorCode::usage, "is for one tolerance everywhere; leave --region out", option);
  return {};
}

Result<std::optional<Vec2>> CriterionArguments::placeAboveGround(const TerrainModel& outline) const {
  if (camera_.empty()) return std::nullopt;
  const auto transform = transformOfPlaces(isLonLat_, outline);
  if (!transform) return tl::unexpected(transform.error());
  const auto place = readCameraPlace("--camera", camera_, *transform);
  if (!place) return tl::unexpected(place.error());
  return outline.toPlan(*place);
}

Status CriterionArguments::placeCamera(const TerrainModel& model, ExtractCriterion& c) const {
  const auto transform = transformOfPlaces(isLonLat_, model);
  if (!transform) return tl::unexpected(transform.error());
  const auto argument = readCameraArgument("--camera", camera_, *transform, SurfaceHeights(model));
  if (!argument) return tl::unexpected(argument.error());
  Camera camera = argument->camera;
  if (!look_.empty()) {
    if (argument->statesLook)
      return failure(ErrorCode::usage, "--camera says already where it looks", "--look " + look_);
    const auto look = twoNumbers("--look", look_, ',');
    if (!look) return tl::unexpected(look.error());
    camera.azimuthDegrees = look->first;
    camera.pitchDegrees = look->second;
    if (const Result<View> view = viewOf(camera, model); !view)
      return failure(view.error().code, view.error().message, "--look " + look_);
  }
  if (!viewport_.empty()) {
    const auto viewport = twoNumbers("--viewport", viewport_, 'x');
    if (!viewport) return tl::unexpected(viewport.error());
    if (viewport->first != std::floor(viewport->first) || viewport->second != std::floor(viewport->second))
      return failure(ErrorCode::usage, "is not of whole pixels", "--viewport " + viewport_);
    camera.widthPixels = viewport->first;
    camera.heightPixels = viewport->second;
    if (const Result<View> view = viewOf(camera, model); !view)
      return failure(view.error().code, view.error().message, "--viewport " + viewport_);
  }
  if (!std::isnan(fieldOfView_) && argument->statesFieldOfView)
    return failure(ErrorCode::usage, "--camera states its field of view already", "--fov");
  if (!std::isnan(fieldOfView_)) camera.verticalFieldOfViewDegrees = fieldOfView_;
  if (const Result<View> view = viewOf(camera, model); !view)
    return failure(view.error().code, view.error().message, "--camera " + camera_);
  c.camera = camera;
  c.cameraText = argument->positionText;
  c.isLonLat = isLonLat_;
  if (!std::isnan(pixelError_))
    c.pixelError = pixelError_;
  else if (maxTriangles_ < 0)
    c.pixelError = 1;
  return {};
}

Status CriterionArguments::placeFocus(const TerrainModel& model, ExtractCriterion& c) const {
  const auto transform = transformOfPlaces(isLonLat_, model);
  if (!transform) return tl::unexpected(transform.error());
  const auto place = readPlaceArgument("--focus", focus_, *transform);
  if (!place) return tl::unexpected(place.error());
  c.focus = {.xy = *place, .growth = growth_, .text = focus_};
  c.isLonLat = isLonLat_;
  return {};
}

Result<std::vector<ExtractCriterion>> CriterionArguments::criteria(const TerrainModel& model) const {
  ExtractCriterion common;
  if (maxTriangles_ >= 0) common.maxTriangles = static_cast<std::uint32_t>(maxTriangles_);
  common.region = region_;
  common.distance = distance_;
  if (!std::isnan(outsideError_)) common.outsideError = outsideError_;
  common.method = method_ == "saturated" ? CutMethod::saturated : CutMethod::minimal;
  if (deadline_ > 0) common.deadlineMilliseconds = deadline_;
  common.order = order_ == "breadth"      ? ExtractOrder::breadth
                 : order_ == "depth"      ? ExtractOrder::depth
                 : order_ == "two-queues" ? ExtractOrder::twoQueues
                                          : ExtractOrder::worst;
  common.fit = fit_ == "triangles" ? ExtractFit::triangles
               : fit_ == "error"   ? ExtractFit::error
                                   : ExtractFit::none;
  if (!camera_.empty())
    if (Status placed = placeCamera(model, common); !placed) return tl::unexpected(placed.error());
  if (!focus_.empty())
    if (Status placed = placeFocus(model, common); !placed) return tl::unexpected(placed.error());
  if (maxErrors_.empty()) return std::vector{common};

  const auto errors = parseNumbers("--max-error", maxErrors_);
  if (!errors) return tl::unexpected(errors.error());
  std::vector<ExtractCriterion> criteria;
  for (const double error : *errors) {
    if (std::ranges::count(*errors, error) > 1)
      return failure(ErrorCode::usage, fmt::format("names {} twice", error), "--max-error");
    if (common.outsideError < error)
      return failure(ErrorCode::usage,
                     fmt::format("{} outside is below the {} inside; it may only be coarser",
                                 common.outsideError, error),
                     "--outside-error");
    criteria.push_back(common);
    criteria.back().maxError = error;
  }
  return criteria;
}

}  // namespace arete
