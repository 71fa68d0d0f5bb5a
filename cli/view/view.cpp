// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the model, of terrain or a surface, places the camera or the flight, and hands all to the window or,
// with --headless, to the functions of pictures.h.
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
#include "cli/surface/camera.h"
#include "cli/view/arguments.h"
#include "cli/view/layers.h"
#include "cli/view/pictures.h"
#include "engine/base/stopwatch.h"
#include "io/files/shell_text.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/query/extract/camera_argument.h"
#include "io/query/extract/model.h"
#include "io/query/extract/model_file.h"
#include "io/query/source/any_model.h"
#include "viewer/camera/flight_json.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/headless/headless.h"
#include "viewer/heights/contour_labels.h"
#include "viewer/layers/contour_heights.h"
#include "viewer/scene/heights_of_contours.h"
#include "viewer/surface/surface_drawable.h"
#include "viewer/window/opening.h"
#include "viewer/window/window.h"

namespace arete {
namespace {

/// A model of either kind, as the window and the pictures take it.
struct Viewed {
  std::shared_ptr<const Subject> subject;
  std::uint64_t finestTriangles = 0;
  Georeference georeference = {};
  LongitudeTurns turns = {};
  std::optional<Camera> camera = {};                 ///< that is stated
  std::string source = {};                           ///< that is not to be overwritten
  std::shared_ptr<const TerrainColors> colors = {};  ///< that are stated
  std::shared_ptr<const StatedLayers> layers = {};   ///< over a terrain
  FillScene addModel;                                ///< keeps the model
  WriteHeights heightsOfContours = {};               ///< as addModel; empty of a surface
  /// Of the heights on the device; null until the model is added, and of a surface.
  std::shared_ptr<Json> ground = std::make_shared<Json>();
};

Result<Viewed> viewedOf(const ViewArguments& a, TerrainModel opened, Session& session) {
  const auto model = std::make_shared<const TerrainModel>(std::move(opened));
  const auto subject = std::make_shared<const TerrainSubject>(*model);
  ARETE_CHECK(checkGroundUnits(model->georeference, {a.appearance.hazeWithUnit}));
  Viewed viewed{.subject = subject,
                .finestTriangles = model->mt.finestTriangleCount(),
                .georeference = model->georeference,
                .turns = LongitudeTurns(*model),
                .source = model->source,
                .addModel = {}};
  if (!a.viewpoint.camera.empty()) {
    ARETE_TRY(const auto toDem, transformOfPlaces(a.viewpoint.isLonLat, *model));
    ARETE_TRY(CameraArgument stated,
              readCameraArgument("--camera", a.viewpoint.camera, toDem, *subject->heights()));
    viewed.camera = stated.camera;
  }
  if (const std::string word = a.appearance.colors.wordOfSea(a.appearance.color, *model);
      !word.empty() && a.appearance.drapes.empty())
    session.warn(Warnings{{WarningCode::display, word}}, a.model);
  if (a.appearance.colors.isStated()) {
    Warnings said;
    ARETE_TRY(const TerrainColors colors, a.appearance.colors.of(a.appearance.color, *model, said));
    session.warn(said, a.appearance.colors.ramp);
    viewed.colors = std::make_shared<const TerrainColors>(colors);
  }
  ARETE_TRY(StatedLayers readLayers, StatedLayers::read(a.appearance, model, session));
  const auto layers = std::make_shared<const StatedLayers>(std::move(readLayers));
  viewed.layers = layers;
  double interval = a.appearance.contours;
  if (const std::string& stated = a.appearance.contoursWithUnit; !stated.empty()) {
    ARETE_TRY(interval, inDataUnit(StatedLength{.number = interval, .unitMetres = 1},
                                   heightUnitOf(model->georeference), stated));
  }
  viewed.addModel = [&a, &session, model, subject, layers, interval,
                     ground = viewed.ground](Scene& scene) -> Status {
    ARETE_TRY(
        TerrainDrawable made,
        TerrainDrawable::create(subject,
                                {.path = a.detail.isCutByProcessor() ? CutPath::processor : CutPath::device,
                                 .heights = {.mostBytes = std::uint64_t(a.appearance.groundMebibytes) << 20}},
                                session.context()));
    const HeightsOnGpu& heights = made.painter().heights();
    *ground = {{"bytes", heights.bytes()}, {"level", heights.finestLevel()}};
    ARETE_CHECK(scene.add(std::make_unique<TerrainDrawable>(std::move(made))));
    ARETE_CHECK(layers->addTo(scene, *model, session));
    if (interval > 0) scene.layers.put("contours", Contours{interval});
    return {};
  };
  viewed.heightsOfContours = [model](double every) -> Result<Layer::Drawn> {
    ARETE_TRY(const std::vector<ContourLabel> labels, contourLabels(*model, every));
    ARETE_TRY(auto written, ContourHeights::create(labels));
    return Layer::Drawn(std::move(written));
  };
  return viewed;
}

Result<Viewed> viewedOf(const ViewArguments& a, SurfaceModel opened, Session&) {
  const auto model = std::make_shared<const SurfaceModel>(std::move(opened));
  const auto subject = std::make_shared<const SurfaceSubject>(*model, ZUpFrame(*model, a.viewpoint.up));
  Viewed viewed{.subject = subject,
                .finestTriangles = model->mt.finestTriangleCount(),
                .addModel = [model, subject](Scene& scene) -> Status {
                  ARETE_TRY(SurfaceDrawable made, SurfaceDrawable::create(*model, subject));
                  return scene.add(std::make_unique<SurfaceDrawable>(std::move(made)));
                }};
  if (a.viewpoint.camera.empty()) return viewed;
  ARETE_TRY(const SurfaceCameraArgument stated, readSurfaceCamera(a.viewpoint.camera));
  const Vec3 eye = subject->upright().fromFile(stated.camera.eye);
  const Look look = subject->space().lookAlong(subject->upright().fromFile(stated.camera.target) - eye);
  Camera camera = subject->space().at({}, eye);
  camera.azimuthDegrees = look.azimuthDegrees;
  camera.pitchDegrees = look.pitchDegrees;
  if (stated.statesFieldOfView) camera.verticalFieldOfViewDegrees = stated.camera.verticalFieldOfViewDegrees;
  if (const Result<View> view = subject->viewOf(camera); !view)
    return failure(view.error().code, view.error().message, "--camera " + a.viewpoint.camera);
  viewed.camera = camera;
  return viewed;
}

Result<std::optional<Flight>> flightOf(const ViewArguments& a, const Viewed& viewed, const Camera& camera,
                                       Session& session) {
  const std::string& path = a.viewpoint.path;
  if (!a.viewpoint.hasFlight()) return std::optional<Flight>();
  FlightPlan plan;
  if (path.empty()) {
    ARETE_TRY(plan, viewed.subject->round(camera));
  } else {
    ARETE_TRY(FlightRead read, readFlight(path, viewed.georeference, viewed.turns));
    session.warn(read.warnings, path);
    plan = std::move(read.plan);
  }
  Result<Flight> flight = Flight::create(std::move(plan), viewed.subject->space());
  // A flight around the model comes from no file that the error could name.
  if (!flight && !path.empty())
    return failure(ErrorCode::invalidData, flight.error().message,
                   flight.error().culprit.empty() ? path : path + ", " + flight.error().culprit);
  if (!flight) return tl::unexpected(flight.error());
  return std::optional<Flight>(std::move(*flight));
}

/// A DEM or a mesh that takes longer than this to build is worth a file.
constexpr double kSecondsWorthAFile = 5;

/// "arete build 'my dem.tif' -o 'my dem.amt'".
std::string buildCommandOf(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().replace_extension(".amt").string();
  return fmt::format("arete build {} -o {}", shellQuoted(path), shellQuoted(name));
}

ModelKind kindOf(const Model& model) {
  return std::holds_alternative<SurfaceModel>(model) ? ModelKind::surface : ModelKind::terrain;
}

/// Options that are not for a kind of model.
Status refuseOtherKinds(const ViewArguments& a, ModelKind kind) {
  ARETE_CHECK(a.kinds.refuseOther(kind));
  if (kind == ModelKind::surface && a.viewpoint.isRound && a.pictures.frames.empty() &&
      a.pictures.film.empty())
    return failure(ErrorCode::usage, "requires --frames, where the file is of a surface", "--round");
  return {};
}

/// The model, read or built behind a bar in the window, if there is one. Nothing: the window was closed.
///
/// @param file of a model; nothing: it is to be built.
Result<std::optional<Model>> openModelOf(const ViewArguments& a, std::optional<AmtContainer> file,
                                         GlfwWindow* window, Session& session) {
  const Stopwatch opening;
  std::optional<AnyModel> opened;
  const auto open = [&](const RunContext& context) -> Status {
    if (file) {
      ARETE_TRY(Model model, readModel(std::move(*file), context));
      opened = AnyModel{std::move(model)};
      return {};
    }
    ARETE_TRY(opened, openAnyModel(a.model, {}, context));
    return {};
  };
  const std::string name = std::filesystem::path(a.model).filename().string();
  if (window) {
    const std::string hint =
        file ? "" : fmt::format("{} keeps the model for the next time.", buildCommandOf(a.model));
    ARETE_TRY(const bool isDone, showWhile(*window, {name, hint}, open, session.context()));
    if (!isDone) return std::optional<Model>();
  } else {
    ARETE_CHECK(open(session.context()));
  }
  session.warn(opened->warnings, a.model);
  if (opened->isBuilt && opening.seconds() > kSecondsWorthAFile)
    session.note(fmt::format("{} was built in {:.0f} s; '{}' keeps the model for the next time", name,
                             opening.seconds(), buildCommandOf(a.model)));
  ARETE_CHECK(refuseOtherKinds(a, kindOf(opened->model)));
  return std::optional(std::move(opened->model));
}

Status runView(ViewArguments a, Session& session) {
  ARETE_CHECK(a.completePictures());
  std::optional<AmtContainer> file;
  if (isModelFile(a.model)) {
    ARETE_TRY(file, openModelFile(a.model));
    ARETE_CHECK(refuseOtherKinds(a, kindOf(*file)));
  }
  ARETE_CHECK(a.check());
  ARETE_TRY(const FramesFolder framesFolder, FramesFolder::of(a.pictures));
  ARETE_TRY(const auto size, a.pictures.size());
  std::optional<GlfwWindow> shown;
  if (!a.pictures.isHeadless) {
    const auto [width, height] = a.pictures.sizeText.empty() ? std::pair(1280, 800) : size;
    ARETE_TRY(shown, GlfwWindow::open(fmt::format("arete - {}", a.model), width, height, true));
  }
  ARETE_TRY(std::optional<Model> model, openModelOf(a, std::move(file), shown ? &*shown : nullptr, session));
  if (!model) return {};
  ARETE_TRY(const Viewed viewed,
            std::visit([&](auto&& one) { return viewedOf(a, std::move(one), session); }, std::move(*model)));
  const Subject& subject = *viewed.subject;
  ARETE_CHECK(a.detail.findBudget(viewed.finestTriangles));
  ARETE_TRY(ViewSettings settings, a.settings(subject.colorings()));
  settings.maxTriangles = static_cast<std::uint32_t>(a.detail.maxTriangles);
  settings.look.colors = viewed.colors;
  ARETE_CHECK(subject.check(settings));

  // A home view depends on the shape of the picture, so its size comes first.
  Camera camera = viewed.camera.value_or(Camera());
  camera.widthPixels = size.first;
  camera.heightPixels = size.second;
  if (!viewed.camera) camera = subject.home(a.viewpoint.homeView(), camera, settings);
  // A camera below the ground may be meant, so it is allowed.
  if (const auto ground = subject.heights() ? subject.heights()->at(camera.xy) : std::nullopt;
      ground && camera.height < ground->height)
    session.warn(fmt::format("the camera stands {} under the ground",
                             withUnit(ground->height - camera.height, viewed.georeference.verticalUnit)));
  ARETE_TRY(const auto flight, flightOf(a, viewed, camera, session));
  if (!a.pictures.frames.empty()) {
    if (const auto count = filmFrames(*flight, a.pictures.framesPerSecond); !count)
      return failure(
          count.error().code, count.error().message,
          a.viewpoint.path.empty() ? count.error().culprit : a.viewpoint.path + ", " + count.error().culprit);
    std::error_code failed;  // drawFilm() says why; the film may lie in it
    std::filesystem::create_directories(a.pictures.frames, failed);
  }
  std::vector<std::string> inputs = layerFiles(a.appearance);
  for (const std::string& input : {a.model, a.viewpoint.path, viewed.source}) inputs.push_back(input);
  ARETE_CHECK(checkPictureOutputs(a, inputs));

  const Camera start = flight && !a.viewpoint.statesCamera() ? flight->at(0) : camera;
  if (!a.pictures.isHeadless) {
    WindowOptions window;
    window.start.settings = settings;
    window.start.frameMilliseconds = a.detail.frameTime;
    window.start.home = a.viewpoint.homeView();
    if (viewed.camera || flight) window.start.camera = start;
    if (flight) window.start.flight = flight->plan();
    if (!a.viewpoint.path.empty()) window.start.flightPath = a.viewpoint.path;
    window.samples = a.pictures.samples;
    window.start.showsDecorations = !a.appearance.isPlainPicture;
    window.lastPicture = a.pictures.windowScreenshot;
    window.frames = a.pictures.windowFrames;
    window.heightsOfContours = viewed.heightsOfContours;
    return runWindow(std::move(*shown), viewed.addModel, window, session.context());
  }

  ARETE_TRY(HeadlessView view,
            HeadlessView::create({size.first, size.second, a.pictures.samples, settings,
                                  a.appearance.isPlainPicture ? Decorations::none() : Decorations()},
                                 viewed.addModel));
  session.warn(view.warnings(), a.model);
  ARETE_CHECK(HeightsOfContours(viewed.heightsOfContours).follow(view.scene().layers));
  Json json = {{"model", a.model}, {"kind", subject.kind()}, {"renderer", view.description()}};
  a.detail.addBudgetTo(json, viewed.finestTriangles);
  if (!viewed.ground->is_null()) json["heights"] = *viewed.ground;
  if (viewed.layers) viewed.layers->describe(view.scene(), json);
  if (!a.pictures.screenshot.empty()) {
    ARETE_CHECK(takeScreenshot(a, start, view, session, json));
    if (viewed.layers) viewed.layers->warnOfLabels(view.scene(), session);
  }
  if (!a.pictures.frames.empty()) ARETE_CHECK(makeFilm(a, *flight, view, session, json));
  session.answer(json);
  return {};
}

}  // namespace

void addViewCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command = session.addCommand(
      app, "view", "Show a terrain or a surface in a window, or draw pictures without one",
      "  arete view dem.amt\n"
      "  arete view dem.tif                                        built first; so is a mesh\n"
      "  arete view dem.amt --screenshot view.png --camera 409050,3801450,300,20,-10\n"
      "  arete view dem.amt --round --film flight.mp4",
      [arguments](Session& s) { return runView(*arguments, s); });
  arguments->addTo(*command);
}

}  // namespace arete
