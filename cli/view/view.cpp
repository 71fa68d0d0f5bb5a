// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the model, places the camera or the flight, and hands both to the window or, with --headless, to the
// functions of pictures.h.
#include "cli/view/view.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/view/arguments.h"
#include "cli/view/pictures.h"
#include "cli/view/surface.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/query/extract/camera_argument.h"
#include "io/query/extract/model_file.h"
#include "io/store/amt/file.h"
#include "terrain/locate/ground_height.h"
#include "viewer/camera/flight_json.h"
#include "viewer/camera/home_view.h"
#include "viewer/camera/round_flight.h"
#include "viewer/headless/headless.h"
#include "viewer/scene/curved_home_view.h"
#include "viewer/window/terrain_window.h"

namespace arete {
namespace {

Result<Camera> cameraOf(const ViewArguments& a, const TerrainModel& model, const GroundHeights& heights,
                        int width, int height) {
  // A home view depends on the shape of the picture, so its size comes first.
  Camera picture;
  picture.widthPixels = width;
  picture.heightPixels = height;
  if (a.viewpoint.camera.empty()) {
    const CameraSpace space(model);
    if (!a.appearance.isCurved)
      return homeCamera(a.viewpoint.homeView(), space, metricBox(model), picture, a.appearance.exaggeration);
    ARETE_TRY(const auto ground, CurvedGround::create(model));
    return curvedHomeCamera(a.viewpoint.homeView(), ground, space, metricBox(model), picture,
                            a.appearance.exaggeration);
  }
  ARETE_TRY(const auto toDem, transformOfPlaces(a.viewpoint.isLonLat, model));
  ARETE_TRY(CameraArgument stated, readCameraArgument("--camera", a.viewpoint.camera, toDem, heights));
  stated.camera.widthPixels = width;
  stated.camera.heightPixels = height;
  return stated.camera;
}

Result<std::optional<Flight>> flightOf(const ViewArguments& a, const TerrainModel& model,
                                       const GroundHeights& heights, Session& session) {
  const CameraSpace space(model);
  FlightPlan plan;
  if (!a.viewpoint.path.empty()) {
    ARETE_TRY(FlightRead read, readFlight(a.viewpoint.path, model.georeference, LongitudeTurns(model)));
    session.warn(read.warnings, a.viewpoint.path);
    plan = std::move(read.plan);
  } else if (a.viewpoint.isRound) {
    ARETE_TRY(FlightPlan round, roundFlight(heights, space, metricBox(model)));
    plan = std::move(round);
  } else {
    return std::optional<Flight>();
  }
  Result<Flight> flight = Flight::create(std::move(plan), space);
  // A flight around the terrain comes from no file that the error could name.
  if (!flight && !a.viewpoint.path.empty())
    return failure(
        ErrorCode::invalidData, flight.error().message,
        flight.error().culprit.empty() ? a.viewpoint.path : a.viewpoint.path + ", " + flight.error().culprit);
  if (!flight) return tl::unexpected(flight.error());
  return std::optional<Flight>(std::move(*flight));
}

Status runView(ViewArguments a, Session& session) {
  ARETE_CHECK(a.completePictures());
  ARETE_TRY(AmtContainer container, openModelFile(a.model));
  ARETE_CHECK(a.kinds.refuseOther(kindOf(container)));
  if (container.isOfSurface()) return viewSurface(a, container, session);
  ARETE_CHECK(a.check());
  ARETE_TRY(const FramesFolder framesFolder, FramesFolder::of(a.pictures));
  ARETE_TRY(ViewSettings settings, a.settings());
  ARETE_TRY(const DrapeOptions drapeOptions, a.appearance.drapeOptions());
  ARETE_TRY(const auto size, a.pictures.size());
  ARETE_TRY(const AmtFile file, openAmt(std::move(container)));
  ARETE_TRY(const TerrainModel model, file.read({}, session.context()));
  ARETE_CHECK(a.detail.findBudget(model.mt.finestTriangleCount()));
  settings.maxTriangles = static_cast<std::uint32_t>(a.detail.maxTriangles);
  ARETE_CHECK(checkGroundUnits(model.georeference, {a.appearance.hazeWithUnit}));
  if (const std::string& stated = a.appearance.contoursWithUnit; !stated.empty()) {
    const StatedLength interval{.number = settings.look.contourInterval, .unitMetres = 1};
    ARETE_TRY(settings.look.contourInterval, inDataUnit(interval, heightUnitOf(model.georeference), stated));
  }
  const GroundHeights heights(model);
  ARETE_TRY(const Camera camera, cameraOf(a, model, heights, size.first, size.second));
  // A camera below the ground may be meant, so it is allowed.
  if (const auto ground = heights.at(camera.xy); ground && camera.height < ground->height)
    session.warn(fmt::format("the camera stands {} under the ground",
                             withUnit(ground->height - camera.height, model.georeference.verticalUnit)));
  ARETE_TRY(const auto flight, flightOf(a, model, heights, session));

  if (!a.pictures.frames.empty()) {
    if (const auto count = filmFrames(*flight, a.pictures.framesPerSecond); !count)
      return failure(
          count.error().code, count.error().message,
          a.viewpoint.path.empty() ? count.error().culprit : a.viewpoint.path + ", " + count.error().culprit);
    std::error_code failed;  // drawFilm() says why; the film may lie in it
    std::filesystem::create_directories(a.pictures.frames, failed);
  }
  ARETE_CHECK(checkPictureOutputs(a, {a.model, a.viewpoint.path, a.appearance.drape, model.source}));

  const auto layDrape = [&](TerrainView& view) -> Status {
    ARETE_CHECK(view.setDrape(a.appearance.drape, drapeOptions, session.context()));
    session.warn(view.drape()->warnings(), a.appearance.drape);
    return {};
  };
  if (!a.pictures.isHeadless) {
    WindowOptions window{.title = fmt::format("arete - {}", a.model)};
    window.start.settings = settings;
    window.start.frameMilliseconds = a.detail.frameTime;
    if (a.viewpoint.statesCamera())
      window.start.camera = camera;
    else if (flight)
      window.start.camera = flight->at(0);
    if (flight) window.start.flight = flight->plan();
    if (!a.viewpoint.path.empty()) window.start.flightPath = a.viewpoint.path;
    if (!a.pictures.sizeText.empty()) std::tie(window.width, window.height) = size;
    window.samples = a.pictures.samples;
    window.start.hasDrape = !a.appearance.drape.empty();
    if (!a.appearance.drape.empty()) window.onReady = layDrape;
    window.lastPicture = a.pictures.windowScreenshot;
    window.frames = a.pictures.windowFrames;
    return runWindow(model, window, session.context());
  }

  HeadlessOptions options{size.first, size.second, a.pictures.samples, settings};
  ARETE_TRY(HeadlessView view, HeadlessView::create(model, options, session.context()));
  for (const std::string& warning : view.warnings()) session.warn(warning);
  Json json = {{"model", a.model}, {"renderer", view.description()}};
  a.detail.addBudgetTo(json, model.mt.finestTriangleCount());
  if (!a.appearance.drape.empty()) {
    ARETE_CHECK(layDrape(view.view()));
    const DrapeOnGpu& drape = *view.view().drape();
    json["drape"] = {{"file", a.appearance.drape},
                     {"columns", drape.columns()},
                     {"rows", drape.rows()},
                     {"bytes", drape.bytes()}};
  }
  if (!a.pictures.screenshot.empty()) {
    const bool isStated = a.viewpoint.statesCamera();
    const Camera from = flight && !isStated ? flight->at(0) : camera;
    ARETE_CHECK(takeScreenshot(a, from, view, session, json));
  }
  if (!a.pictures.frames.empty()) ARETE_CHECK(makeFilm(a, *flight, heights, view, session, json));
  session.answer(json);
  return {};
}

}  // namespace

void addViewCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command =
      session.addCommand(app, "view", "Show a terrain or a surface in a window, or draw pictures without one",
                         "  arete view dem.amt\n"
                         "  arete view dem.amt --screenshot view.png --camera 409050,3801450,300,20,-10\n"
                         "  arete view dem.amt --round --film flight.mp4",
                         [arguments](Session& s) { return runView(*arguments, s); });
  arguments->addTo(*command);
}

}  // namespace arete
