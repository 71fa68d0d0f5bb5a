// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the model, of terrain or a surface, places the camera or the flight, and hands all to the window or,
// with --headless, to the functions of pictures.h.
#include "cli/view/view.h"

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/view/arguments.h"
#include "cli/view/beside.h"
#include "cli/view/pictures.h"
#include "cli/view/viewed.h"
#include "cli/view/window_script.h"
#include "engine/base/stopwatch.h"
#include "engine/memory/required_memory.h"
#include "io/files/shell_text.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/query/extract/camera_argument.h"
#include "io/query/extract/model.h"
#include "io/query/extract/model_file.h"
#include "io/query/pages/resident_pages.h"
#include "io/query/scene/open_scene.h"
#include "io/query/source/any_model.h"
#include "io/store/amt/file.h"
#include "viewer/camera/flight_json.h"
#include "viewer/headless/headless.h"
#include "viewer/marks/space_marks.h"
#include "viewer/scene/heights_of_contours.h"
#include "viewer/window/camera_rig.h"
#include "viewer/window/opening.h"
#include "viewer/window/window.h"

namespace arete {
namespace {

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

ModelKind kindOf(const Opened& opened) {
  const bool isSurface = std::holds_alternative<SurfaceModel>(opened) ||
                         std::holds_alternative<std::unique_ptr<SurfacePages>>(opened);
  return isSurface ? ModelKind::surface : ModelKind::terrain;
}

/// Options that are not for a kind of model.
Status refuseOtherKinds(const ViewArguments& a, ModelKind kind) {
  ARETE_CHECK(a.kinds.refuseOther(kind));
  if (kind == ModelKind::surface && a.viewpoint.isRound && a.pictures.frames.empty() &&
      a.pictures.film.empty())
    return failure(ErrorCode::usage, "requires --frames, where the file is of a surface", "--round");
  return {};
}

/// Options of one model, where a scene states each object's own; and of terrain, where it has no terrain.
Status refuseForScenes(const ViewArguments& a, const OpenScene& scene) {
  for (const auto& [option, text] :
       {std::pair{"--turn ", a.viewpoint.turn}, std::pair{"--up ", a.viewpoint.up}})
    if (!text.empty() && (a.viewpoint.beside.empty() || option == std::string_view("--turn ")))
      return failure(ErrorCode::usage, "is of one surface; a scene states it for each of its objects",
                     option + text);
  if (a.appearance.hasInk())
    return failure(ErrorCode::usage, "is of one surface", "--color " + a.appearance.color);
  return scene.terrain ? Status() : refuseOtherKinds(a, ModelKind::surface);
}

/// Why a model in pages is to be read whole, as words of a message; empty: it need not be.
std::string needOfWhole(const ViewArguments& a) {
  const AppearanceArguments& look = a.appearance;
  if (!a.viewpoint.beside.empty()) return "--beside";
  if (look.hasInk()) return "--color " + look.color;
  if (look.isCurved) return "--curvature";
  if (!look.drapes.empty()) return "--drape";
  if (!look.layers.empty()) return "--layer";
  if (look.contours > 0) return "--contours";
  if (look.color == "slope" || look.color == "aspect") return "--color " + look.color;
  return a.detail.pageMebibytes == 0 ? "--page-memory 0" : "";
}

/// What was opened, and how.
struct Opening {
  Opened opened;
  Warnings warnings = {};
  bool isBuilt = false;  ///< of a DEM or a mesh, in memory
};

/// Opens a model that stays in its file.
template <class Model>
Result<Opening> openPages(typename ResidentPages<Model>::File file, std::uint64_t pageBytes,
                          const RunContext& context) {
  ARETE_TRY(auto pages, ResidentPages<Model>::open(std::move(file), pageBytes, context));
  return Opening{.opened = std::make_unique<ResidentPages<Model>>(std::move(pages))};
}

/// @param pageBytes of a model in pages that stays in its file; 0: it is read whole
Result<Opening> open(const std::string& path, std::optional<AmtContainer> file, std::uint64_t pageBytes,
                     const RunContext& context) {
  const auto asOpened = [](Model model) {
    return std::visit([](auto&& one) { return Opened(std::move(one)); }, std::move(model));
  };
  if (file && pageBytes > 0 && file->isOfSurface()) {
    ARETE_TRY(PagedSurfaceFile surface, PagedSurfaceFile::open(std::move(*file)));
    return openPages<SurfaceModel>(std::move(surface), pageBytes, context);
  }
  if (file && pageBytes > 0) {
    ARETE_TRY(AmtFile terrain, openAmt(std::move(*file)));
    return openPages<TerrainModel>(std::move(terrain), pageBytes, context);
  }
  if (file) {
    ARETE_TRY(Model model, readModel(std::move(*file), context));
    return Opening{.opened = asOpened(std::move(model))};
  }
  if (isSceneFile(path)) {
    ARETE_TRY(SceneFile stated, readScene(path));
    ARETE_TRY(OpenScene scene, openScene(std::move(stated), context));
    Warnings warnings = std::move(scene.warnings);
    return Opening{.opened = std::move(scene), .warnings = std::move(warnings)};
  }
  ARETE_TRY(AnyModel any, openAnyModel(path, {}, context));
  return Opening{asOpened(std::move(any.model)), std::move(any.warnings), any.isBuilt};
}

/// The model, read or built behind a bar in the window, if there is one. Nothing: the window was closed.
///
/// @param file of a model; nothing: it is to be built.
Result<std::optional<Opened>> openModelOf(const ViewArguments& a, std::optional<AmtContainer> file,
                                          GlfwWindow* window, Session& session) {
  const Stopwatch watch;
  const bool mayBuild = !file && !isSceneFile(a.model);
  std::uint64_t pageBytes = 0;
  if (file && file->isPaged()) {
    const std::string need = needOfWhole(a);
    if (need.empty())
      pageBytes = std::uint64_t(a.detail.pageMebibytes) << 20;
    else if (a.detail.pageMebibytes > 0)
      session.note(fmt::format("{} needs all of the model, which is read before the first picture", need));
  }
  std::optional<Opening> opening;
  const auto openIt = [&](const RunContext& context) -> Status {
    if (!a.viewpoint.beside.empty()) {
      ARETE_TRY(OpenScene both, openBeside(a, context));
      Warnings warnings = std::move(both.warnings);
      opening = Opening{.opened = std::move(both), .warnings = std::move(warnings)};
      return {};
    }
    ARETE_TRY(opening, open(a.model, std::move(file), pageBytes, context));
    return {};
  };
  const std::string name = std::filesystem::path(a.model).filename().string();
  if (window) {
    const std::string hint =
        mayBuild ? fmt::format("{} keeps the model for the next time.", buildCommandOf(a.model)) : "";
    ARETE_TRY(const bool isDone, showWhile(*window, {name, hint}, openIt, session.context()));
    if (!isDone) return std::optional<Opened>();
  } else {
    ARETE_CHECK(openIt(session.context()));
  }
  session.warn(opening->warnings, a.model);
  if (opening->isBuilt && watch.seconds() > kSecondsWorthAFile)
    session.note(fmt::format("{} was built in {:.0f} s; '{}' keeps the model for the next time", name,
                             watch.seconds(), buildCommandOf(a.model)));
  if (const auto* const scene = std::get_if<OpenScene>(&opening->opened))
    ARETE_CHECK(refuseForScenes(a, *scene));
  else
    ARETE_CHECK(refuseOtherKinds(a, kindOf(opening->opened)));
  return std::optional(std::move(opening->opened));
}

/// The height of a parallel picture in which the middle of the model is as large as in perspective.
double heightAhead(const Camera& camera, const Subject& subject) {
  const CameraSpace& space = subject.space();
  const MetricBox& box = subject.box();
  const double ahead = dot(box.centre() - space.position(camera), space.forward(lookOf(camera)));
  const double slope = std::tan(camera.verticalFieldOfViewDegrees * std::numbers::pi / 360);
  const double height = ahead > 0 ? 2 * ahead * slope : box.diagonal();
  return height > 0 ? height : 1;
}

/// Axes and a grid reach beyond the model, of which a view of the whole has all.
CoveredEdges roomFor(const SpaceMarks& marks) {
  constexpr double kRim = 0.2;
  return marks.axes || marks.grid ? CoveredEdges{kRim, kRim, kRim, kRim} : CoveredEdges{};
}

/// Marks as the window has them when it opens with this camera.
void layMarksOf(const SpaceMarks& marks, const Subject& subject, const Camera& camera,
                const ViewSettings& settings, Layers& layers) {
  CameraRig rig(subject, camera);
  rig.setStretch(settings.stretch);
  rig.place(camera);
  laySpaceMarks(layers, marks, subject, camera, OrbitPlace{rig.orbitCentre(), rig.orbitRadius()},
                settings.stretch);
}

/// The program that runs, for commands of its own; empty where that cannot be told.
std::string thisProgram() {
  std::error_code failed;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", failed);
  return failed ? std::string() : path.string();
}

/// A file that is shown instead of another, with what it needs.
struct OtherFile {
  ViewArguments arguments;
  std::optional<Viewed> viewed = {};
  WindowOptions window = {};
};

/// A dropped file, as `view FILE` opens it; what was stated for the first file is not for it. Nothing: the
/// window was closed.
Result<bool> openOther(const std::string& path, OtherFile& other, GlfwWindow& shown, Session& session) {
  ViewArguments& a = other.arguments;
  a.model = path;
  std::optional<AmtContainer> file;
  if (isModelFile(path)) {
    ARETE_TRY(file, openModelFile(path));
  }
  ARETE_TRY(std::optional<Opened> model, openModelOf(a, std::move(file), &shown, session));
  if (!model) return false;
  ARETE_TRY(other.viewed, viewedOf(a, std::move(*model), session));
  ARETE_CHECK(a.detail.findBudget(other.viewed->finestTriangles));
  const Subject& subject = *other.viewed->subject;
  ARETE_TRY(other.window.start.settings, a.settings(subject.colorings()));
  ARETE_TRY(other.window.start.marks, a.appearance.spaceMarks());
  other.window.start.settings.look.colors = other.viewed->colors;
  ARETE_CHECK(subject.check(other.window.start.settings));
  other.window.heightsOfContours = other.viewed->heightsOfContours;
  return true;
}

/// Shows a model, and then what is dropped on the window or made in it, until it is closed. A file that
/// cannot be opened is said in the window, which goes on with what it had.
Status showThenOthers(const ViewArguments& a, GlfwWindow& shown, const Viewed& first, WindowOptions window,
                      Session& session) {
  std::optional<WindowScript> script;
  if (!a.pictures.windowScript.empty()) {
    ARETE_TRY(script, WindowScript::read(a.pictures.windowScript));
    window.onFrame = [&](ViewerSession& s, int) { return script->step(s); };
  }
  const Viewed* viewed = &first;
  std::unique_ptr<OtherFile> other;
  while (true) {
    ARETE_TRY(const WindowEnd end, showIn(shown, viewed->addModel, window, session.context()));
    if (end.next.empty()) return {};
    auto next = std::make_unique<OtherFile>();
    const Result<bool> isOpen = openOther(end.next, *next, shown, session);
    if (isOpen && !*isOpen) return {};
    if (!isOpen) {
      if (isOpen.error().code == ErrorCode::interrupted) return tl::unexpected(isOpen.error());
      window.message = isOpen.error().describe();
      session.note(window.message);
      window.start.camera = end.camera;
      continue;
    }
    session.note("opened " + end.next);
    next->window.samples = window.samples;
    next->window.lastPicture = window.lastPicture;
    next->window.frames = window.frames;
    next->window.onFrame = window.onFrame;
    next->window.desk = {window.desk.program, next->viewed->files, window.desk.log};
    shown.setTitle(fmt::format("arete - {}", end.next));
    // What is shown is kept until the next is there.
    other = std::move(next);
    viewed = &*other->viewed;
    window = other->window;
  }
}

/// What the driver of the device takes, which asks no question.
constexpr std::uint64_t kBytesOfDevice = std::uint64_t{96} << 20;

Status runView(ViewArguments a, Session& session) {
  ARETE_CHECK(a.completePictures());
  ARETE_CHECK(checkBudget(kBytesOfDevice, "`extract` makes a mesh without a device"));
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
  ARETE_TRY(std::optional<Opened> model, openModelOf(a, std::move(file), shown ? &*shown : nullptr, session));
  if (!model) return {};
  ARETE_TRY(const Viewed viewed, viewedOf(a, std::move(*model), session));
  const Subject& subject = *viewed.subject;
  ARETE_CHECK(a.detail.findBudget(viewed.finestTriangles));
  ARETE_TRY(ViewSettings settings, a.settings(subject.colorings()));
  settings.maxTriangles = static_cast<std::uint32_t>(a.detail.maxTriangles);
  settings.look.colors = viewed.colors;
  if (a.viewpoint.hasDistances) {
    settings.look.coloring = Coloring::material;
    settings.look.surface.hasTextures = settings.look.surface.hasMaterialColors = false;
    settings.look.surface.hasHighlights = false;
  }
  ARETE_CHECK(subject.check(settings));

  // A home view depends on the shape of the picture, so its size comes first.
  Camera camera = viewed.camera.value_or(Camera());
  camera.widthPixels = a.viewpoint.beside.empty() ? size.first : size.first / 2.0;
  camera.heightPixels = size.second;
  if (a.viewpoint.statesParallel()) camera.parallelHeight = heightAhead(camera, subject);
  ARETE_TRY(const SpaceMarks marks, a.appearance.spaceMarks());
  if (!viewed.camera) camera = subject.home(a.viewpoint.homeView(), camera, settings, roomFor(marks));
  if (a.viewpoint.parallelHeight > 0) camera.parallelHeight = a.viewpoint.parallelHeight;
  if (const Result<View> seen = subject.viewOf(camera, settings); !seen) return tl::unexpected(seen.error());
  // A camera below the ground may be meant, so it is allowed.
  if (const auto ground =
          subject.heights() && !viewed.isOfPages ? subject.heights()->at(camera.xy) : std::nullopt;
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
    window.start.marks = marks;
    window.lastPicture = a.pictures.windowScreenshot;
    window.frames = a.pictures.windowFrames;
    window.heightsOfContours = viewed.heightsOfContours;
    window.desk = {thisProgram(), viewed.files, [&session](const std::string& done) { session.note(done); }};
    return showThenOthers(a, *shown, viewed, std::move(window), session);
  }

  ARETE_TRY(HeadlessView view,
            HeadlessView::create({size.first, size.second, a.pictures.samples, settings,
                                  a.appearance.isPlainPicture ? Decorations::none() : Decorations()},
                                 viewed.addModel));
  session.warn(view.warnings(), a.model);
  ARETE_CHECK(HeightsOfContours(viewed.heightsOfContours).follow(view.scene().layers));
  layMarksOf(marks, subject, start, settings, view.scene().layers);
  Json json = {{"model", a.model}, {"kind", subject.kind()}, {"renderer", view.description()}};
  a.detail.addBudgetTo(json, viewed.finestTriangles);
  if (!viewed.ground->is_null()) json["heights"] = *viewed.ground;
  if (!viewed.distances->is_null()) json["distances"] = *viewed.distances;
  if (viewed.layers) viewed.layers->describe(view.scene(), json);
  if (!a.pictures.screenshot.empty()) {
    ARETE_CHECK(takeScreenshot(a, start, view, session, json));
    if (viewed.layers) viewed.layers->warnOfLabels(view.scene(), session);
  }
  view.scene().layers.remove(SpaceMarks::kOrbit);  // a flight turns about nothing
  view.setPageBytes(std::uint64_t(a.detail.pageKibibytes) << 10);
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
