// SPDX-License-Identifier: GPL-3.0-or-later
//
// Declares the options, checks their combinations, and turns the texts into engine-independent criteria. A
// camera and a focus need the model: their coordinates are transformed into its CRS, heights resolved on its
// terrain.
#include "cli/arguments/criterion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/arguments/place_hint.h"
#include "engine/base/counted.h"
#include "io/files/text/stated_size.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/position_argument.h"
#include "io/query/extract/camera_argument.h"
#include "terrain/locate/ground_height.h"

namespace arete {
namespace {

constexpr std::uint32_t kMostTriangles = 0xFFFFFFFE;

/// "5,000" is a list of two numbers, of which the second cannot be meant.
std::string groupedDigits(const std::vector<StatedSize>& sizes) {
  if (sizes.size() < 2 || sizes.front().text.size() > 3) return {};
  std::string whole = sizes.front().text;
  bool hasZeroFirst = false;
  for (std::size_t i = 1; i < sizes.size(); ++i) {
    const std::string& text = sizes[i].text;
    if (text.size() != 3 || text.find_first_not_of("0123456789") != text.npos) return {};
    hasZeroFirst = hasZeroFirst || text.front() == '0';
    whole += text;
  }
  if (!hasZeroFirst) return {};
  return fmt::format("commas stand between several numbers, and digits are not grouped by them: {}?", whole);
}

}  // namespace

CLI::Validator triangleBudgets() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        // As a part of as many triangles as there can be, every share that can be right is.
        const auto budgets = parseTriangleBudgets(text, kMostTriangles);
        return budgets ? "" : budgets.error().message;
      },
      "");
}

void CriterionArguments::addTo(CLI::App& command, OptionKinds& kinds) {
  CLI::Option* errors =
      command
          .add_option(
              "--max-error", maxErrors_,
              "Largest vertical error, in the DEM's unit of height or as E% of its relief, the highest "
              "minus\n"
              "the lowest sample; of a surface the largest distance, in its unit or as E% of its diagonal;\n"
              "several with commas make one TIN each")
          ->check(tolerances())
          ->type_name("E[,E...]");
  command
      .add_option(
          "--max-triangles", maxTriangles_,
          "Largest number of triangles, used where the error is largest, or N% of those of the finest\n"
          "triangulation; several with commas make one TIN each. With --max-error, what is reached\n"
          "first ends the refinement")
      ->check(triangleBudgets())
      ->type_name("N[,N...]");
  command
      .add_option("--method", method_,
                  "minimal: fewest triangles (default); saturated: a few more, computed faster")
      ->check(oneOf({"minimal", "saturated"}))
      ->type_name("NAME");

  const CLI::Option* fit =
      command
          .add_option("--fit", fit_,
                      "Adjust the vertices. Of terrain triangles: about a third fewer triangles within "
                      "--max-error; error: a smaller error with the same triangles; unbiased: a mean\n"
                      "error of 0 with the same triangles, as volumes need it. Of a surface rms: move\n"
                      "vertices to where the mean square distance is small")
          ->check(oneOf({"triangles", "error", "unbiased", "rms"}))
          ->type_name("WHAT");
  kinds.valuesOf(ModelKind::terrain, fit, {"triangles", "error", "unbiased"});
  kinds.valuesOf(ModelKind::surface, fit, {"rms"});

  const std::string where = "Resolution that varies";
  CLI::Option* region =
      command
          .add_option("--region", region_,
                      "Where --max-error holds: polygons (any vector file), with --distance lines and points "
                      "too, or xmin,ymin,xmax,ymax in the DEM's CRS; of a surface a box x0,y0,z0,x1,y1,z1 or "
                      "a ball x,y,z,r")
          ->type_name("FILE|BOX")
          ->group(where);
  kinds.ofTerrain(
      command
          .add_option(
              "--region-crs", regionCrs_,
              "CRS of the region, where its file has none or a wrong one, or of the box (EPSG:4326, ...)")
          ->needs(region)
          ->type_name("CRS")
          ->group(where));
  kinds.ofTerrain(
      command
          .add_option(
              "--distance", stated_.distance,
              "Length along the ground, in metres or with a unit, by which the region is extended (without a "
              "CRS: the DEM's units)")
          ->transform(groundLength("--distance", distanceWithUnit_))
          ->check(finiteAbove(0))
          ->needs(region)
          ->type_name("D")
          ->group(where));
  CLI::Option* focus =
      command
          .add_option("--focus", focus_,
                      "Place where --max-error holds; the error grows from there by --error-growth. Of a "
                      "surface X,Y,Z")
          ->type_name("X,Y[,Z]")
          ->group(where)
          ->excludes(region);
  CLI::Option* growth =
      command
          .add_option(
              "--error-growth", growth_,
              "Growth of the error per metre from the focus, by the scale of the map in the middle of "
              "the DEM (without a CRS, and of a surface: per unit)")
          ->check(finiteAtLeast(0))
          ->needs(focus)
          ->type_name("G")
          ->group(where);
  focus->needs(growth);
  CLI::Option* camera = command
                            .add_option("--camera", camera_,
                                        "Position of a camera, H above the ground (agl) or in the DEM's "
                                        "heights (msl, ell); the error is measured in pixels of its picture. "
                                        "AZIMUTH,PITCH and FOV replace --look and --fov. Of a surface "
                                        "x,y,z of the eye, x,y,z of what it looks at[,FOV]")
                            ->type_name("X,Y,H[agl|msl|ell][,AZIMUTH,PITCH[,FOV]]")
                            ->group(where)
                            ->excludes(region)
                            ->excludes(focus)
                            ->excludes(errors);
  kinds.ofTerrain(
      command
          .add_option(
              "--look", look_,
              "Direction of the camera in degrees, clockwise from north and above the horizon (default 0,0)")
          ->needs(camera)
          ->type_name("AZIMUTH,PITCH")
          ->group(where));
  CLI::Option* const fieldOfView =
      command
          .add_option("--fov", fieldOfView_, "Vertical field of view of the camera in degrees (default 60)")
          ->check(finiteBetween(0.01, 179))
          ->needs(camera)
          ->type_name("DEG")
          ->group(where);
  command
      .add_option("--parallel-height", parallelHeight_,
                  "The camera's picture is a parallel projection so high, in metres or the unit of a surface")
      ->check(finiteBetween(1e-9, 1e12))
      ->needs(camera)
      ->excludes(fieldOfView)
      ->type_name("H")
      ->group(where);
  command.add_option("--viewport", viewport_, "Size of the camera's picture in pixels (default 1920x1080)")
      ->needs(camera)
      ->type_name("WxH")
      ->group(where);
  command
      .add_option("--pixel-error", stated_.pixelError,
                  "Largest error in the picture, in pixels (default 1; with a budget: the smallest possible)")
      ->check(finiteAbove(0))
      ->needs(camera)
      ->type_name("P")
      ->group(where);
  command
      .add_option("--outside-error", outsideErrorText_,
                  "Largest error outside the region, out of view, or far from the focus (default: no limit)")
      ->check(tolerances())
      ->type_name("E")
      ->group(where);
  kinds.ofTerrain(
      command.add_flag("--lonlat", isLonLat_, "X,Y of --focus and --camera are longitude and latitude")
          ->group(where));

  const std::string stop = "Limited time or size";
  command
      .add_option("--deadline", stated_.deadlineMilliseconds,
                  "Longest time of refinement; the mesh conforms whenever it ends")
      ->check(finiteAbove(0))
      ->type_name("MS")
      ->group(stop);
  command
      .add_option("--order", order_,
                  "Order of refinement under a budget or deadline: worst (default), breadth, depth, or "
                  "two-queues (what the camera sees first). Of a surface without a place the default is\n"
                  "where the mean square distance is large")
      ->check(oneOf({"worst", "breadth", "depth", "two-queues"}))
      ->type_name("NAME")
      ->group(stop);
}

Status CriterionArguments::check() const {
  if (maxErrors_.empty() && !hasBudget() && camera_.empty() && !hasDeadline())
    return failure(ErrorCode::usage, "--max-error, --max-triangles, --camera or --deadline is required");
  if (!outsideErrorText_.empty() && region_.empty() && focus_.empty() && camera_.empty())
    return failure(ErrorCode::usage, "requires --region, --focus or --camera", "--outside-error");
  if (isLonLat_ && !region_.empty() && camera_.empty())
    return failure(
        ErrorCode::usage,
        "is for --focus and --camera; --region-crs EPSG:4326 says that --region has longitudes and "
        "latitudes",
        "--lonlat");
  if (isLonLat_ && focus_.empty() && camera_.empty())
    return failure(ErrorCode::usage, "requires --focus or --camera", "--lonlat");
  if (method_ == "saturated" && (hasDeadline() || hasOtherOrder()))
    return failure(ErrorCode::usage, "cannot be combined with --method saturated",
                   hasDeadline() ? "--deadline" : "--order");
  if (hasOtherOrder() && !hasBudget() && !hasDeadline())
    return failure(ErrorCode::usage, "requires --max-triangles or --deadline", "--order");
  if (order_ == "two-queues" && camera_.empty())
    return failure(ErrorCode::usage, "two-queues requires --camera", "--order");
  return checkFit();
}

CriterionArguments::OfSurface CriterionArguments::ofSurface() const {
  OfSurface asked;
  asked.common = common();
  asked.maxErrors = maxErrors_;
  asked.maxTriangles = maxTriangles_;
  asked.region = region_;
  asked.outsideError = outsideErrorText_;
  asked.camera = camera_;
  asked.viewport = viewport_;
  if (!std::isnan(fieldOfView_)) asked.fieldOfView = fieldOfView_;
  asked.parallelHeight = parallelHeight_;
  asked.focus = focus_;
  if (!std::isnan(growth_)) asked.errorGrowth = growth_;
  return asked;
}

CutRequest CriterionArguments::common() const {
  CutRequest request = stated_;
  request.method = method_ == "saturated" ? CutMethod::saturated : CutMethod::minimal;
  for (const CutOrder order : {CutOrder::worst, CutOrder::breadth, CutOrder::depth, CutOrder::twoQueues})
    if (order_ == orderName(order)) request.order = order;
  for (const CutFit fit : {CutFit::triangles, CutFit::error, CutFit::unbiased, CutFit::rms})
    if (fit_ == fitName(fit)) request.fit = fit;
  request.region = region_;
  request.regionCrs = regionCrs_;
  return request;
}

Status CriterionArguments::checkFit() const {
  if (fit_ == "none") return {};
  const std::string option = "--fit " + fit_;
  if (!camera_.empty() || !focus_.empty() || hasDeadline())
    return failure(ErrorCode::usage, "cannot be combined with --camera, --focus or --deadline", option);
  if (fit_ == "triangles" && maxErrors_.empty())
    return failure(ErrorCode::usage, "requires --max-error", option);
  if (fit_ == "triangles" && method_ == "saturated")
    return failure(ErrorCode::usage, "cannot be combined with --method saturated", option);
  if ((fit_ == "error" || fit_ == "rms") && !region_.empty())
    return failure(ErrorCode::usage, "cannot be combined with --region", option);
  return {};
}

Result<std::optional<Vec2>> CriterionArguments::placeAboveGround(const TerrainModel& outline) const {
  if (camera_.empty()) return std::nullopt;
  ARETE_TRY(const auto transform, transformOfPlaces(isLonLat_, outline));
  ARETE_TRY(const auto place, readCameraPlace("--camera", camera_, transform));
  return outline.toPlan(place);
}

Status CriterionArguments::placeCamera(const TerrainModel& model, CutRequest& c) const {
  ARETE_TRY(const auto transform, transformOfPlaces(isLonLat_, model));
  auto argument = readCameraArgument("--camera", camera_, transform, GroundHeights(model));
  if (!argument && argument.error().code == ErrorCode::invalidData && !isLonLat_)
    if (const auto place = readCameraPlace("--camera", camera_, transform))
      argument.error().message += behindSemicolon(degreesHint(*place, model));
  if (!argument) return tl::unexpected(argument.error());
  Camera camera = argument->camera;
  if (!look_.empty()) {
    if (argument->statesLook)
      return failure(ErrorCode::usage, "cannot be combined with a direction in --camera", "--look " + look_);
    ARETE_TRY(const auto look, twoNumbers("--look", look_, ','));
    camera.azimuthDegrees = look.first;
    camera.pitchDegrees = look.second;
    if (const Result<View> view = viewOf(camera, model); !view)
      return failure(view.error().code, view.error().message, "--look " + look_);
  }
  if (!viewport_.empty()) {
    ARETE_TRY(const auto viewport, twoNumbers("--viewport", viewport_, 'x'));
    if (viewport.first != std::floor(viewport.first) || viewport.second != std::floor(viewport.second))
      return failure(ErrorCode::usage, "must be whole pixels", "--viewport " + viewport_);
    camera.widthPixels = viewport.first;
    camera.heightPixels = viewport.second;
    if (const Result<View> view = viewOf(camera, model); !view)
      return failure(view.error().code, view.error().message, "--viewport " + viewport_);
  }
  if (!std::isnan(fieldOfView_) && argument->statesFieldOfView)
    return failure(ErrorCode::usage, "cannot be combined with a field of view in --camera", "--fov");
  if (parallelHeight_ > 0 && argument->statesFieldOfView)
    return failure(ErrorCode::usage, "cannot be combined with a field of view in --camera",
                   "--parallel-height");
  if (!std::isnan(fieldOfView_)) camera.verticalFieldOfViewDegrees = fieldOfView_;
  camera.parallelHeight = parallelHeight_;
  if (const Result<View> view = viewOf(camera, model); !view)
    return failure(view.error().code, view.error().message, "--camera " + camera_);
  c.camera = camera;
  c.cameraText = argument->positionText;
  c.isLonLat = isLonLat_;
  if (!c.pixelError && !hasBudget()) c.pixelError = 1;
  return {};
}

Status CriterionArguments::placeFocus(const TerrainModel& model, CutRequest& c) const {
  ARETE_TRY(const auto transform, transformOfPlaces(isLonLat_, model));
  ARETE_TRY(const auto place, readPlaceArgument("--focus", focus_, transform));
  c.focus = {.xy = place, .growth = growth_, .text = focus_};
  c.isLonLat = isLonLat_;
  return {};
}

std::string CriterionArguments::focusHint(const TerrainModel& model) const {
  if (focus_.empty() || isLonLat_) return {};
  const auto place = readPlaceArgument("--focus", focus_, CrsTransform());
  const std::string hint = place ? degreesHint(*place, model) : std::string();
  return hint.empty() ? hint : fmt::format("--focus {} lies outside the DEM: {}", focus_, hint);
}

bool CriterionArguments::statesShares() const {
  const auto isShare = [](const std::string& text) { return text.find('%') != text.npos; };
  return isShare(maxErrors_) || isShare(maxTriangles_) || isShare(outsideErrorText_);
}

std::string CriterionArguments::tagOf(const CutRequest& criterion, const std::string& errorText,
                                      const std::string& budgetText) const {
  if (!errorText.empty() && !budgetText.empty()) return fmt::format("{}_{}", errorText, budgetText);
  if (!errorText.empty() || !budgetText.empty()) return errorText + budgetText;
  if (criterion.pixelError) return fmt::format("{}px", *criterion.pixelError);
  return fmt::format("{}ms", criterion.deadlineMilliseconds.value_or(0));
}

Result<std::vector<CriterionArguments::OfTerrain>> CriterionArguments::criteria(
    const TerrainModel& model, const std::optional<Wholes>& wholes) const {
  ARETE_CHECK(checkGroundUnits(model.georeference, {distanceWithUnit_}));
  const double relief = wholes ? wholes->length : 0;
  const DataUnit unit = heightUnitOf(model.georeference);
  CutRequest request = common();
  if (!outsideErrorText_.empty()) {
    ARETE_TRY(const auto outside, parseStatedSizes(outsideErrorText_, "--outside-error", &unit));
    if (outside.size() != 1) return failure(ErrorCode::usage, "takes one error", "--outside-error");
    request.outsideError = outside.front().of(relief);
  }
  if (!camera_.empty()) ARETE_CHECK(placeCamera(model, request));
  if (!focus_.empty()) ARETE_CHECK(placeFocus(model, request));

  std::vector<OfTerrain> withErrors = {{request, ""}};
  if (!maxErrors_.empty()) {
    ARETE_TRY(const auto errors, parseStatedSizes(maxErrors_, "--max-error", &unit));
    withErrors.clear();
    for (const StatedSize& stated : errors) {
      const double error = stated.of(relief);
      if (std::ranges::count(withErrors, error, [](const OfTerrain& c) { return c.criterion.maxError; }) > 0)
        return failure(ErrorCode::usage, fmt::format("has {} twice", stated.text), "--max-error");
      if (request.outsideError < error)
        return failure(ErrorCode::usage,
                       fmt::format("{} is below the error {} inside; it must not be smaller",
                                   request.outsideError, error),
                       "--outside-error");
      withErrors.push_back(
          {request, stated.isShare || stated.hasUnit ? stated.text : fmt::format("{}", error)});
      withErrors.back().criterion.maxError = error;
    }
  }
  std::vector<StatedTriangles> budgets(1);
  if (hasBudget()) {
    ARETE_TRY(auto stated, parseTriangleBudgets(maxTriangles_, wholes ? wholes->triangles : 0));
    budgets = std::move(stated);
  }
  std::vector<OfTerrain> all;
  for (const OfTerrain& each : withErrors)
    for (const StatedTriangles& budget : budgets) {
      all.push_back(each);
      if (hasBudget()) all.back().criterion.maxTriangles = budget.count;
      all.back().tag = tagOf(all.back().criterion, each.tag, budget.text);
    }
  return all;
}

Result<std::vector<StatedTriangles>> parseTriangleBudgets(const std::string& text, std::uint64_t finest) {
  constexpr const char* kOption = "--max-triangles";
  ARETE_TRY(const std::vector<StatedSize> sizes, parseStatedSizes(text, kOption));
  if (const std::string problem = groupedDigits(sizes); !problem.empty())
    return failure(ErrorCode::usage, problem, kOption);
  std::vector<StatedTriangles> budgets;
  for (const StatedSize& size : sizes) {
    const double count = std::floor(size.of(static_cast<double>(finest)));
    if (!size.isShare && count != size.number)
      return failure(ErrorCode::usage, fmt::format("'{}' is not a whole number", size.text), kOption);
    if (size.isShare && count < 1)
      return failure(ErrorCode::usage,
                     fmt::format("{} of {} is less than one triangle", size.text,
                                 counted(finest, "triangle", "triangles")),
                     kOption);
    if (!(count >= 1 && count <= kMostTriangles))
      return failure(ErrorCode::usage, fmt::format("must be from 1 to {}, not {}", kMostTriangles, size.text),
                     kOption);
    const auto whole = static_cast<std::uint32_t>(count);
    if (std::ranges::count(budgets, whole, &StatedTriangles::count) > 0)
      return failure(ErrorCode::usage, fmt::format("has {} twice", size.text), kOption);
    budgets.push_back({size.text, whole});
  }
  return budgets;
}

}  // namespace arete
