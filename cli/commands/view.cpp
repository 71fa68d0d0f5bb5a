// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/view.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <tuple>

#include "cli/arguments/arguments.h"
#include "cli/sight/arguments.h"
#include "io/amt/file.h"
#include "io/extract/camera_argument.h"
#include "io/file/file_writer.h"
#include "io/file/text_scan.h"
#include "terrain/locate/surface_height.h"
#include "viewer/camera/flight_json.h"
#include "viewer/camera/home_view.h"
#include "viewer/camera/round_flight.h"
#include "viewer/headless/headless.h"
#include "viewer/scene/curved_home_view.h"
#include "viewer/window/window.h"

namespace arete {
namespace {

struct ViewArguments {
  std::string model, drape, drapeBands, path;
  bool isHeadless = false, isLonLat = false, isRound = false;
  std::string size, camera, home;
  std::string screenshot, frames, film, figures;
  double framesPerSecond = 0;
  int samples = 4;
  std::string windowScreenshot;
  int windowFrames = 0;

  double pixelError = 1, frameTime = 0, deadline = 0, exaggeration = 1;
  std::int64_t maxTriangles = 0;
  std::string cut = "device";
  bool isFixed = false;

  std::string color = "height", sun;
  double contours = 0, hazeKilometres = 0;
  bool hasWireframe = false, isUnshaded = false, isCurved = false;
};

/// "1280x720". Errors: usage.
Result<std::pair<int, int>> readSize(const std::string& text) {
  const auto size = twoNumbers("--size", text, 'x');
  const auto isSide = [](double n) { return n >= 1 && n <= 1e6 && n == std::floor(n); };
  if (!size || !isSide(size->first) || !isSide(size->second))
    return failure(ErrorCode::usage, "a picture's size is WIDTHxHEIGHT, as 1280x720", "--size " + text);
  return std::pair(static_cast<int>(size->first), static_cast<int>(size->second));
}

Coloring coloringOf(const std::string& name) {
  if (name == "slope") return Coloring::slope;
  if (name == "aspect") return Coloring::aspect;
  if (name == "plain") return Coloring::plain;
  if (name == "error") return Coloring::error;
  return Coloring::hypsometric;
}

Result<ViewSettings> settingsOf(const ViewArguments& a) {
  ViewSettings s;
  s.pixels = a.pixelError;
  s.maxTriangles = static_cast<std::uint32_t>(a.maxTriangles);
  s.path = a.cut == "device" ? CutPath::device : CutPath::processor;
  s.cutMilliseconds = a.deadline;
  s.isGeomorphed = !a.isFixed;
  s.stretch = a.exaggeration;
  s.isCurved = a.isCurved;
  s.look.coloring = coloringOf(a.color);
  s.look.isShaded = !a.isUnshaded;
  s.look.contourInterval = a.contours;
  s.look.hazeKilometres = a.hazeKilometres;
  s.look.hasWireframe = a.hasWireframe;
  if (!a.sun.empty()) {
    const auto sun = twoNumbers("--sun", a.sun, ',');
    if (!sun || !(sun->second >= 0 && sun->second <= 90) || !std::isfinite(sun->first))
      return failure(ErrorCode::usage, "the sun stands at AZIMUTH,ELEVATION, the latter of 0 to 90 degrees",
                     "--sun " + a.sun);
    std::tie(s.look.sunAzimuthDegrees, s.look.sunElevationDegrees) = *sun;
  }
  return s;
}

HomeView homeOf(const std::string& name) {
  for (const HomeView view : kHomeViews)
    if (toString(view) == name) return view;
  return HomeView::overview;
}

Result<Camera> cameraOf(const ViewArguments& a, const TerrainModel& model, const SurfaceHeights& heights,
                        int width, int height) {
  Camera picture;
  picture.widthPixels = width;
  picture.heightPixels = height;
  if (a.camera.empty()) {
    const CameraSpace space(model);
    if (!a.isCurved) return homeCamera(homeOf(a.home), space, metricBox(model), picture, a.exaggeration);
    const auto ground = CurvedGround::create(model);
    if (!ground) return tl::unexpected(ground.error());
    return curvedHomeCamera(homeOf(a.home), *ground, space, metricBox(model), picture, a.exaggeration);
  }
  const auto toDem = transformOfPlaces(a.isLonLat, model);
  if (!toDem) return tl::unexpected(toDem.error());
  Result<CameraArgument> stated = readCameraArgument("--camera", a.camera, *toDem, heights);
  if (!stated) return tl::unexpected(stated.error());
  stated->camera.widthPixels = width;
  stated->camera.heightPixels = height;
  return stated->camera;
}

Result<std::optional<Flight>> flightOf(const ViewArguments& a, const TerrainModel& model,
                                       const SurfaceHeights& heights, Session& session) {
  const CameraSpace space(model);
  FlightPlan plan;
  if (!a.path.empty()) {
    Result<FlightRead> read = readFlight(a.path, model.georeference);
    if (!read) return tl::unexpected(read.error());
    session.warn(read->warnings, a.path);
    plan = std::move(read->plan);
  } else if (a.isRound) {
    Result<FlightPlan> round = roundFlight(heights, space, metricBox(model));
    if (!round) return tl::unexpected(round.error());
    plan = std::move(*round);
  } else {
    return std::optional<Flight>();
  }
  Result<Flight> flight = Flight::create(std::move(plan), space);
  if (!flight && !a.path.empty())
    return failure(ErrorCode::invalidData, flight.error().message,
                   flight.error().culprit.empty() ? a.path : a.path + ", " + flight.error().culprit);
  if (!flight) return tl::unexpected(flight.error());
  return std::optional<Flight>(std::move(*flight));
}

Json jsonOf(const Camera& c) {
  return {{"x", c.xy.x},
          {"y", c.xy.y},
          {"height", c.height},
          {"azimuth", c.azimuthDegrees},
          {"pitch", c.pitchDegrees},
          {"fov", c.verticalFieldOfViewDegrees}};
}

Json jsonOf(const FrameFigures& f) {
  return {{"triangles", f.triangles},
          {"moving", f.moving},
          {"pixelError", std::isfinite(f.pixels) ? Json(f.pixels) : Json()},
          {"isComplete", f.isComplete},
          {"showsTerrain", f.showsTerrain},
          {"jumpPixels", std::isfinite(f.jumpPixels) ? Json(f.jumpPixels) : Json()},
          {"cutMilliseconds", f.cutMilliseconds},
          {"drawMilliseconds", f.drawMilliseconds}};
}

/// The bands of the picture that are shown. Errors: usage.
Result<DrapeOptions> drapeOptionsOf(const ViewArguments& a) {
  DrapeOptions options;
  if (a.drapeBands.empty()) return options;
  if (a.drape.empty())
    return failure(ErrorCode::usage, "are those of a picture: say --drape FILE", "--drape-bands");
  const auto numbers = parseNumbers("--drape-bands", a.drapeBands);
  if (!numbers) return tl::unexpected(numbers.error());
  for (const double n : *numbers) {
    if (!(n >= 1 && n <= 65535 && n == std::floor(n)) || (numbers->size() != 1 && numbers->size() != 3))
      return failure(ErrorCode::usage, "names one band (grey) or three (red, green, blue), counted from 1",
                     "--drape-bands " + a.drapeBands);
    options.read.bands.push_back(static_cast<int>(n));
  }
  return options;
}

Status checkArguments(const ViewArguments& a) {
  const auto refuse = [](const char* sentence, const std::string& option) {
    return failure(ErrorCode::usage, sentence, option);
  };
  if (!a.isHeadless)
    for (const auto& [option, value] : {std::pair{"--screenshot", a.screenshot},
                                        {"--frames", a.frames},
                                        {"--film", a.film},
                                        {"--figures", a.figures}})
      if (!value.empty())
        return refuse("is made without a window: add --headless", std::string(option) + " " + value);
  if (a.deadline > 0 && a.cut == "device")
    return refuse("is for cuts of the processor: add --cut processor", "--deadline");
  if (a.isHeadless && a.screenshot.empty() && a.frames.empty())
    return refuse("makes pictures: say --screenshot FILE.png or --frames FOLDER", "--headless");
  if (!a.screenshot.empty() && text::lowerExtension(a.screenshot) != "png")
    return refuse("a picture ends in .png", "--screenshot " + a.screenshot);
  if (!a.path.empty() && a.isRound) return refuse("flies a way of its own; leave --path out", "--round");
  if (!a.frames.empty() && a.path.empty() && !a.isRound)
    return refuse("are those of a flight: say --path FLIGHT.json or --round", "--frames " + a.frames);
  if (!a.figures.empty() && a.frames.empty())
    return refuse("are those of frames: say --frames FOLDER as well", "--figures " + a.figures);
  if (a.framesPerSecond > 0 && a.frames.empty())
    return refuse("counts frames: say --frames FOLDER as well", "--fps");
  if (a.frameTime > 0 && a.isHeadless)
    return refuse("is for the window; --max-triangles bounds a picture", "--frame-time");
  if (!a.home.empty() && !a.camera.empty())
    return refuse("is a view of its own; leave --camera out", "--home " + a.home);
  if (a.isHeadless && a.screenshot.empty() && !(a.camera + a.home).empty())
    return refuse("is where --screenshot is taken from; a flight's frames have cameras of their own",
                  a.home.empty() ? "--camera " + a.camera : "--home " + a.home);
  if (a.isLonLat && a.camera.empty()) return refuse("says what --camera X,Y,H means", "--lonlat");
  if (!a.film.empty() && a.frames.empty())
    return refuse("is made of frames: say --frames FOLDER as well", "--film " + a.film);
  // Before hours of drawing.
  if (!a.film.empty()) {
    if (Status can = canEncodeFilm(a.film); !can)
      return failure(can.error().code, can.error().message, "--film " + a.film);
  }
  return {};
}

/// "within 1 pixel".
std::string accuracyOf(const FrameFigures& figures) {
  if (!std::isfinite(figures.pixels)) return "as coarse as it gets, its error around the eye not known";
  return fmt::format("within {:.3g} pixel{}", figures.pixels, figures.pixels == 1 ? "" : "s");
}

/// What can end a cut before it is within the tolerance.
std::string whatEnds(const ViewArguments& a) {
  if (a.deadline > 0 && a.maxTriangles > 0) return "budget or the deadline";
  return a.deadline > 0 ? "deadline" : a.maxTriangles > 0 ? "budget" : "room on the device";
}

/// Files beside the frames: none of the inputs, none of each other, none of the frames.
Status checkOutputs(const ViewArguments& a, const TerrainModel& model) {
  namespace fs = std::filesystem;
  std::vector<std::string> outputs;
  for (const auto& [option, path] :
       {std::pair{"--screenshot", a.screenshot}, {"--film", a.film}, {"--figures", a.figures}}) {
    if (path.empty()) continue;
    const fs::path file(path), folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code ignored;
    const bool isFrame = !a.frames.empty() && file.filename().string().starts_with("frame_") &&
                         file.extension() == ".png" && fs::equivalent(folder, a.frames, ignored);
    if (isFrame) outputs.push_back(path);
    if (Status ok = checkOutput(option, path, {a.model, a.path, a.drape, model.source}, outputs); !ok)
      return ok;
    outputs.push_back(path);
  }
  return {};
}

/// Frames that an earlier flight left behind those of this one.
bool hasFramesBehind(const std::string& folder, std::size_t frames) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::path(folder) / fmt::format("frame_{:05}.png", frames),
                                 ignored);
}

/// The nodes around the eye, whose pixels nothing bounds, are in every cut of the device.
bool exceedsBudget(const ViewArguments& a, const FrameFigures& figures) {
  return a.maxTriangles > 0 && figures.triangles > static_cast<std::uint64_t>(a.maxTriangles);
}

Status takeScreenshot(const ViewArguments& a, const Camera& camera, HeadlessView& view, Session& session,
                      Json& json) {
  const Result<FrameFigures> figures = view.draw(camera);
  if (!figures)
    return failure(figures.error().code, figures.error().message,
                   figures.error().culprit == "camera" && !a.camera.empty() ? "--camera " + a.camera
                                                                            : figures.error().culprit);
  if (Status saved = savePng(view.image(), a.screenshot); !saved) return saved;
  if (!figures->showsTerrain) session.warn("the picture shows nothing of the terrain");
  if (!figures->isComplete)
    session.warn(fmt::format("the {} ended the cut: the terrain is {}", whatEnds(a), accuracyOf(*figures)));
  if (exceedsBudget(a, *figures))
    session.warn(fmt::format("--max-triangles {}: from there the coarsest cut has {}", a.maxTriangles,
                             grouped(figures->triangles)));
  session.say(fmt::format("{}: {} triangles, {} vertices on the move, {}\n", a.screenshot,
                          grouped(figures->triangles), grouped(figures->moving), accuracyOf(*figures)));
  json["screenshot"] = {{"file", a.screenshot}, {"camera", jsonOf(camera)}, {"figures", jsonOf(*figures)}};
  return {};
}

Status makeFilm(const ViewArguments& a, const Flight& flight, const SurfaceHeights& heights,
                HeadlessView& view, Session& session, Json& json) {
  const auto frames =
      drawFilm(view, flight, {.folder = a.frames, .framesPerSecond = a.framesPerSecond}, session.context());
  if (!frames) return tl::unexpected(frames.error());
  Json list = Json::array();
  std::uint64_t triangles = 0;
  std::size_t unfinished = 0, empty = 0, large = 0, buried = 0;
  for (const FilmFrame& frame : *frames) {
    const auto ground = heights.at(frame.camera.xy);
    buried += ground && frame.camera.height < ground->height ? 1 : 0;
    unfinished += frame.figures.isComplete ? 0 : 1;
    empty += frame.figures.showsTerrain ? 0 : 1;
    large += exceedsBudget(a, frame.figures) ? 1 : 0;
  }
  if (empty > 0)
    session.warn(fmt::format("{} of {} frames show nothing of the terrain", empty, frames->size()));
  if (buried > 0)
    session.warn(
        fmt::format("the camera stands under the ground in {} of {} frames", buried, frames->size()));
  if (unfinished > 0)
    session.warn(
        fmt::format("the {} ended the cut of {} of {} frames", whatEnds(a), unfinished, frames->size()));
  if (large > 0)
    session.warn(fmt::format("--max-triangles {}: the coarsest cuts of {} of {} frames have more",
                             a.maxTriangles, large, frames->size()));
  if (hasFramesBehind(a.frames, frames->size()))
    session.warn(fmt::format("{} has frames of an earlier, longer flight behind these", a.frames));
  for (const FilmFrame& frame : *frames) {
    Json entry = {{"file", frame.file}, {"seconds", frame.seconds}, {"camera", jsonOf(frame.camera)}};
    entry.update(jsonOf(frame.figures));
    list.push_back(std::move(entry));
    triangles += frame.figures.triangles;
  }
  json["renderer"] = view.description();
  json["frames"] = std::move(list);
  if (!a.figures.empty()) {
    auto file = FileWriter::create(a.figures);
    if (!file) return tl::unexpected(file.error());
    file->write(json.dump(1) + "\n");
    if (Status finished = file->finish(); !finished) return finished;
  }
  session.say(fmt::format("{}: {} frame{}, {} triangles in the mean\n", a.frames, frames->size(),
                          frames->size() == 1 ? "" : "s", grouped(triangles / frames->size())));
  if (!a.film.empty()) {
    const double rate = a.framesPerSecond > 0 ? a.framesPerSecond : flight.plan().framesPerSecond;
    if (Status encoded = encodeFilm(a.frames, frames->size(), rate, a.film, session.context()); !encoded)
      return encoded;
    session.say(a.film + "\n");
    json["film"] = a.film;
  }
  return {};
}

Status runView(const ViewArguments& a, Session& session) {
  if (Status ok = checkArguments(a); !ok) return ok;
  const Result<ViewSettings> settings = settingsOf(a);
  if (!settings) return tl::unexpected(settings.error());
  const Result<DrapeOptions> drapeOptions = drapeOptionsOf(a);
  if (!drapeOptions) return tl::unexpected(drapeOptions.error());
  const auto size = readSize(a.size.empty() ? "1280x720" : a.size);
  if (!size) return tl::unexpected(size.error());
  const Result<TerrainModel> model = loadAmt(a.model, {}, session.context());
  if (!model) return tl::unexpected(model.error());
  const SurfaceHeights heights(*model);
  const Result<Camera> camera = cameraOf(a, *model, heights, size->first, size->second);
  if (!camera) return tl::unexpected(camera.error());
  if (const auto ground = heights.at(camera->xy); ground && camera->height < ground->height)
    session.warn(fmt::format("the camera stands {} under the ground",
                             withUnit(ground->height - camera->height, model->georeference.verticalUnit)));
  const auto flight = flightOf(a, *model, heights, session);
  if (!flight) return tl::unexpected(flight.error());

  if (!a.frames.empty()) {
    if (const auto count = filmFrames(**flight, a.framesPerSecond); !count)
      return failure(count.error().code, count.error().message,
                     a.path.empty() ? count.error().culprit : a.path + ", " + count.error().culprit);
    std::error_code failed;  // drawFilm() says why; the film may lie in it
    std::filesystem::create_directories(a.frames, failed);
  }
  if (Status ok = checkOutputs(a, *model); !ok) return ok;

  const auto layDrape = [&](TerrainView& view) -> Status {
    if (Status laid = view.setDrape(a.drape, *drapeOptions, session.context()); !laid) return laid;
    session.warn(view.drape()->warnings(), a.drape);
    return {};
  };
  if (!a.isHeadless) {
    WindowOptions window{.title = fmt::format("arete - {}", a.model)};
    window.start.settings = *settings;
    window.start.frameMilliseconds = a.frameTime;
    if (!a.camera.empty() || !a.home.empty())
      window.start.camera = *camera;
    else if (*flight)
      window.start.camera = (*flight)->at(0);
    if (*flight) window.start.flight = (*flight)->plan();
    if (!a.path.empty()) window.start.flightPath = a.path;
    if (!a.size.empty()) std::tie(window.width, window.height) = *size;
    window.samples = a.samples;
    window.start.hasDrape = !a.drape.empty();
    if (!a.drape.empty()) window.onReady = layDrape;
    window.lastPicture = a.windowScreenshot;
    window.frames = a.windowFrames;
    return runWindow(*model, window, session.context());
  }

  HeadlessOptions options{size->first, size->second, a.samples, *settings};
  Result<HeadlessView> view = HeadlessView::create(*model, options, session.context());
  if (!view) return tl::unexpected(view.error());
  for (const std::string& warning : view->warnings()) session.warn(warning);
  Json json = {{"model", a.model}, {"renderer", view->description()}};
  if (!a.drape.empty()) {
    if (Status laid = layDrape(view->view()); !laid) return laid;
    const DrapeOnGpu& drape = *view->view().drape();
    json["drape"] = {
        {"file", a.drape}, {"columns", drape.columns()}, {"rows", drape.rows()}, {"bytes", drape.bytes()}};
  }
  if (!a.screenshot.empty()) {
    const bool isStated = !a.camera.empty() || !a.home.empty();
    const Camera from = *flight && !isStated ? (*flight)->at(0) : *camera;
    if (Status ok = takeScreenshot(a, from, *view, session, json); !ok) return ok;
  }
  if (!a.frames.empty())
    if (Status ok = makeFilm(a, **flight, heights, *view, session, json); !ok) return ok;
  session.answer(json);
  return {};
}

}  // namespace

void addViewCommand(CLI::App& app, Session& session) {
  auto a = std::make_shared<ViewArguments>();
  CLI::App* command = session.addCommand(
      app, "view", "Fly over it: a window, or pictures without one",
      "  arete view dem.amt\n"
      "  arete view dem.amt --headless --screenshot view.png --camera 409050,3801450,300,20,-10\n"
      "  arete view dem.amt --headless --round --frames frames --film flight.mp4 --figures figures.json",
      [a](Session& s) { return runView(*a, s); });
  command->add_option("FILE.amt", a->model, "Multitriangulation")->required()->type_name("");

  const std::string where = "From where";
  command
      ->add_option(
          "--camera", a->camera,
          "Where the camera stands, H above the ground (agl) or as the DEM's heights (msl, ell), and where "
          "it looks: clockwise from north, above the horizon; its vertical field of view (default 60)")
      ->type_name("X,Y,H[,AZIMUTH,PITCH[,FOV]]")
      ->group(where);
  command->add_flag("--lonlat", a->isLonLat, "--camera stands at longitude and latitude")->group(where);
  command->add_option("--home", a->home, "A view of the whole terrain (default overview)")
      ->check(oneOf({"overview", "above", "south", "west", "north", "east"}))
      ->type_name("NAME")
      ->group(where);
  command->add_option("--path", a->path, "A flight through key frames (docs/topics/flights.md)")
      ->type_name("FLIGHT.json")
      ->group(where);
  command->add_flag("--round", a->isRound, "A flight around the inside of the terrain")->group(where);

  const std::string detail = "Detail";
  command->add_option("--pixel-error", a->pixelError, "Largest error in the picture (default 1)")
      ->check(finiteAbove(0))
      ->type_name("P")
      ->group(detail);
  command->add_option("--max-triangles", a->maxTriangles, "As coarse as needed to have no more")
      ->check(wholeNumber(1, 0xFFFFFFF))
      ->type_name("N")
      ->group(detail);
  command->add_option("--cut", a->cut, "Who decides what is drawn: device (default) or processor")
      ->check(oneOf({"device", "processor"}))
      ->type_name("NAME")
      ->group(detail);
  command
      ->add_option("--frame-time", a->frameTime,
                   "In the window: as coarse as needed for frames to take no longer")
      ->check(finiteAbove(0))
      ->type_name("MS")
      ->group(detail);
  command
      ->add_option("--deadline", a->deadline,
                   "The processor's cut of a frame takes no longer; the next frame goes on with it")
      ->check(finiteAbove(0))
      ->type_name("MS")
      ->group(detail);
  command->add_flag("--no-geomorph", a->isFixed, "Vertices appear at their own height at once")
      ->group(detail);

  const std::string look = "Looks";
  command->add_option("--color", a->color, "height (default), slope, aspect, plain or error")
      ->check(oneOf({"height", "slope", "aspect", "plain", "error"}))
      ->type_name("NAME")
      ->group(look);
  command
      ->add_option("--drape", a->drape,
                   "A picture over the terrain, by its georeference, in any CRS; --color shows where it does "
                   "not reach")
      ->type_name("FILE")
      ->group(look);
  command
      ->add_option("--drape-bands", a->drapeBands,
                   "Its bands: one (grey) or red, green and blue (default: as it says)")
      ->type_name("R,G,B")
      ->group(look);
  command->add_option("--contours", a->contours, "Contour lines every so much height")
      ->check(finiteAbove(0))
      ->type_name("H")
      ->group(look);
  command->add_option("--sun", a->sun, "Where the sun stands (default 315,40)")
      ->type_name("AZIMUTH,ELEVATION")
      ->group(look);
  command->add_option("--haze", a->hazeKilometres, "Where the air hides about two thirds (default: clear)")
      ->check(finiteAbove(0))
      ->type_name("KM")
      ->group(look);
  command->add_option("--exaggeration", a->exaggeration, "Heights so many times as high (default 1)")
      ->check(finiteBetween(1e-6, 1e6))
      ->type_name("X")
      ->group(look);
  command
      ->add_flag("--curvature", a->isCurved, "The Earth curves away as its ellipsoid does (DEMs with a CRS)")
      ->group(look);
  command->add_flag("--wireframe", a->hasWireframe, "The edges over it")->group(look);
  command->add_flag("--unshaded", a->isUnshaded, "No sun")->group(look);

  const std::string pictures = "Pictures";
  command->add_flag("--headless", a->isHeadless, "No window, no display")->group(pictures);
  command->add_option("--size", a->size, "Of the picture or the window (default 1280x720)")
      ->type_name("WxH")
      ->group(pictures);
  command->add_option("--samples", a->samples, "Of each pixel, to smooth edges (default 4)")
      ->check(wholeNumber(1, 32))
      ->type_name("N")
      ->group(pictures);
  command->add_option("--screenshot", a->screenshot, "One picture")->type_name("FILE.png")->group(pictures);
  command->add_option("--frames", a->frames, "The flight's pictures")->type_name("FOLDER")->group(pictures);
  command->add_option("--fps", a->framesPerSecond, "Pictures a second (default: the flight's)")
      ->check(finiteBetween(0.001, 1000))
      ->type_name("N")
      ->group(pictures);
  command->add_option("--film", a->film, "A film of them, by ffmpeg")->type_name("FILE.mp4")->group(pictures);
  command->add_option("--figures", a->figures, "Triangles, tolerance and times of each frame")
      ->type_name("FILE.json")
      ->group(pictures);
  // For pictures of the window itself: what it shows after so many frames, then it closes.
  command->add_option("--window-screenshot", a->windowScreenshot)->group("");
  command->add_option("--window-frames", a->windowFrames)->group("");
}

}  // namespace arete
