// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every action of keys, mouse and panel ends in one function here; step() advances what depends on time.
#include "viewer/window/viewer_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arete {
namespace {

constexpr double kMessageSeconds = 8;
/// How near to a handle of a box the mouse takes it.
constexpr double kHandlePixels = 14;
/// A camera that stays so long is at rest; from then on the time of a frame doubles every second.
constexpr double kRestSeconds = 0.5;
bool isSamePlace(const Camera& a, const Camera& b) {
  return a.xy.x == b.xy.x && a.xy.y == b.xy.y && a.height == b.height &&
         a.azimuthDegrees == b.azimuthDegrees && a.pitchDegrees == b.pitchDegrees &&
         a.verticalFieldOfViewDegrees == b.verticalFieldOfViewDegrees && a.parallelHeight == b.parallelHeight;
}

bool isSameSize(const Camera& a, const Camera& b) {
  return a.widthPixels == b.widthPixels && a.heightPixels == b.heightPixels;
}

Camera startOf(const Subject& subject, const ViewerSession::Start& start) {
  return start.camera ? *start.camera : subject.home(start.home, start.picture, start.settings);
}

}  // namespace

ViewerSession::ViewerSession(const Subject& shown, Layers& shownLayers, const Start& start)
    : subject(shown),
      layers(shownLayers),
      rig(shown, startOf(shown, start)),
      deck(shown.space(), rig.metresPerSecond()),
      distance(shownLayers),
      settings(start.settings),
      wanted{.pixels = start.settings.pixels,
             .maxTriangles = start.settings.maxTriangles,
             .frameMilliseconds = start.frameMilliseconds} {
  if (const TerrainSubject* const terrain = shown.terrain()) tools.emplace(*terrain, layers);
  files.flight = start.flightPath;
  shows.decorations = start.showsDecorations;
  shows.marks = start.marks;
  rig.setStretch(settings.stretch);
  settings.waits = false;
  if (start.flight) deck.setPlan(*start.flight);
  if (!start.camera) home_ = homeNow(start.home);
  // The next home view follows the one that is shown.
  nextHome_ =
      std::size_t(std::ranges::find(kHomeViews, start.home) - kHomeViews.begin()) + (start.camera ? 0 : 1);
}

void ViewerSession::say(std::string sentence) {
  if (sentence.empty()) return;
  message_ = std::move(sentence);
  messageSeconds_ = kMessageSeconds;
}

void ViewerSession::step(const InputState& input) {
  messageSeconds_ -= input.seconds;
  if (messageSeconds_ <= 0) message_.clear();
  moveCamera(withoutBoxDrag(input));
  if (desk) {
    say(desk->step());
    if (auto opened = desk->takeOpened()) files.next = std::move(*opened);
  }
  // A CRS without an ellipsoid leaves the map flat, and that is said once.
  if (const Status can = subject.check(settings); !can && settings.isCurved) {
    settings.isCurved = false;
    say(can.error().describe());
  }
  if (tools) say(tools->step());
  if (isFrozen && !frozen) frozen = rig.camera();
  if (!isFrozen) frozen.reset();
  layMarks();
  readCursor(input);
  // Nothing to learn from a cut that stays as it is.
  if (!isFrozen)
    settings.pixels =
        control_.next(wantedNow(input), {.milliseconds = history.lastWork(),
                                         .triangles = figures.asked,
                                         .pixels = figures.pages ? cutSettings.pixels : figures.pixels});
}

// While the camera is at rest a frame may take longer and longer, and the picture becomes as fine as it can;
// with the first motion the tolerance is again what it was before.
ToleranceControl::Wanted ViewerSession::wantedNow(const InputState& input) {
  const Camera& camera = rig.camera();
  const bool isAtRest = restCamera_ && isSamePlace(*restCamera_, camera) && isSameSize(*restCamera_, camera);
  restCamera_ = camera;
  if (!isAtRest) {
    if (restSeconds_ > kRestSeconds) control_ = movingControl_;
    restSeconds_ = 0;
    return wanted;
  }
  if (restSeconds_ <= kRestSeconds) movingControl_ = control_;
  restSeconds_ += input.seconds;
  ToleranceControl::Wanted now = wanted;
  if (restSeconds_ > kRestSeconds) now.frameMilliseconds *= std::exp2(restSeconds_ - kRestSeconds);
  return now;
}

// A face of the box that the mouse holds takes the drag from the camera.
InputState ViewerSession::withoutBoxDrag(const InputState& input) {
  InputState rest = input;
  const bool isPressed = input.leftButton && !std::exchange(wasLeftButton_, input.leftButton);
  if (!desk || !desk->box()) return rest;
  CropBox& box = *desk->box();
  if (!input.leftButton) box.release();
  if (isPressed && input.isOverPicture) box.grab(rig.camera(), input.mouse, settings, kHandlePixels);
  if (!box.held()) return rest;
  box.drag(rig.camera(), input.mouse, settings);
  rest.leftButton = false;
  rest.mouseMoved = {};
  return rest;
}

ViewerSession::Home ViewerSession::homeNow(HomeView view) const {
  return {view, rig.camera(), covered, settings.stretch, settings.isCurved};
}

// A home view that is not left is found anew for another picture or exaggeration.
void ViewerSession::moveCamera(const InputState& input) {
  const bool wasAtHome = home_ && isSamePlace(home_->camera, rig.camera());
  const auto flown = deck.advance(input.seconds);
  if (flown) rig.place(*flown);
  // A hand on the controls takes them back.
  const bool isMoved = rig.step(input);
  if (isMoved) deck.stop();
  rig.setStretch(settings.stretch);
  if (!wasAtHome || isMoved || flown) return;
  const bool isNew = !isSameSize(home_->camera, rig.camera()) || home_->covered != covered ||
                     home_->stretch != settings.stretch || home_->isCurved != settings.isCurved;
  if (isNew) home(home_->view);
}

void ViewerSession::readCursor(const InputState& input) {
  cursor.update({.mouse = input.isOverPicture ? std::optional(input.mouse) : std::nullopt,
                 .camera = rig.camera(),
                 .cutFor = frozen.value_or(rig.camera()),
                 .pixels = figures.pixels > 0 ? figures.pixels : std::numeric_limits<double>::infinity(),
                 .stretch = settings.stretch,
                 .isCurved = settings.isCurved,
                 .isGeomorphed = settings.isGeomorphed});
}

void ViewerSession::layMarks() {
  const auto lay = [&](const char* name, SpaceVertices lines) {
    if (lines.vertices.empty())
      layers.remove(name);
    else
      layers.put(name, std::move(lines));
  };
  // The way of the flight, key by key.
  SpaceVertices flight;
  const auto& keys = deck.plan().keys;
  for (std::size_t i = 1; i < keys.size() && !deck.isPlaying(); ++i)
    flight.addLine(subject.space().position(keys[i - 1]), subject.space().position(keys[i]),
                   {250, 200, 60, 255});
  lay(kMarks[1], std::move(flight));
  lay(kMarks[2], frozen && shows.frustum
                     ? frustumEdges(subject.space(), *frozen, subject.box().diagonal() / 2, settings.stretch)
                     : SpaceVertices{});
  // Free flight turns about nothing.
  std::optional<OrbitPlace> orbit;
  if (rig.mode() == CameraMode::orbit) orbit = OrbitPlace{rig.orbitCentre(), rig.orbitRadius()};
  laySpaceMarks(layers, shows.marks, subject, rig.camera(), orbit, settings.stretch);
}

std::string ViewerSession::colorByInk(const std::string& ink) {
  if (const auto made = subject.ink(ink); !made) return made.error().describe();
  settings.look.coloring = Coloring::ink;
  settings.look.ink = ink;
  return {};
}

void ViewerSession::apply(Action action) {
  if (!tools && !refusalOf(action).empty()) return say(std::string(refusalOf(action)));
  const auto color = [&](Coloring coloring) { settings.look.coloring = coloring; };
  switch (action) {
    case Action::toggleMode:
      rig.setMode(rig.mode() == CameraMode::orbit ? CameraMode::free : CameraMode::orbit);
      say(rig.mode() == CameraMode::orbit ? "orbit" : "free flight");
      break;
    case Action::nextHome: {
      const HomeView view = kHomeViews[nextHome_++ % kHomeViews.size()];
      home(view);
      say(fmt::format("home: {}", toString(view)));
      break;
    }
    case Action::follow:
      rig.follow(!rig.follows());
      say(rig.follows() ? "following the terrain" : "not following the terrain");
      break;
    case Action::setKeyFrame:
      deck.addKey(rig.camera());
      say(fmt::format("key frame {}", deck.plan().keys.size()));
      break;
    case Action::playFlight:
      if (deck.isPlaying())
        deck.stop();
      else if (const Status played = deck.play(); !played)
        say(played.error().describe());
      break;
    case Action::saveFlight: {
      if (question.mayDo(Saving::flight, files.flight)) saveFlight(files.flight);
      break;
    }
    case Action::loadFlight: {
      // Longitudes in the file may be a whole turn away from the model's.
      const Status loaded =
          deck.load(files.flight, georeference(), tools ? LongitudeTurns(tools->model()) : LongitudeTurns());
      say(loaded ? fmt::format("{}: {} key frames", files.flight.string(), deck.plan().keys.size())
                 : loaded.error().describe());
      break;
    }
    case Action::wireframe:
      settings.look.hasWireframe = !settings.look.hasWireframe;
      break;
    case Action::contours:
      if (layers.find("contours")) return layers.remove("contours");
      layers.put("contours", Contours{usualContourInterval((subject.box().high.z - subject.box().low.z) /
                                                           subject.space().metresPerHeight())});
      break;
    case Action::freeze:
      isFrozen = !isFrozen;
      break;
    case Action::geomorph:
      settings.isGeomorphed = !settings.isGeomorphed;
      say(settings.isGeomorphed ? "geomorphing on" : "geomorphing off");
      break;
    case Action::colorUsual:
      return color(subject.colorings().front());
    case Action::colorSlope:
      return color(Coloring::slope);
    case Action::colorAspect:
      return color(Coloring::aspect);
    case Action::colorPlain:
      return color(Coloring::plain);
    case Action::colorError:
      return color(Coloring::error);
    case Action::clearPicks:
      return tools ? tools->clear() : distance.clear();
    case Action::nextObject:
      return objects ? say(objects->selectNext()) : void();
    case Action::refine:
      return objects ? say(objects->refine()) : void();
    case Action::coarsen:
      return objects ? say(objects->coarsen()) : void();
    case Action::byView:
      return objects ? say(objects->setLevel(std::nullopt)) : void();
    case Action::alone:
      return objects ? say(objects->toggleAlone()) : void();
    case Action::parallel: {
      if (settings.isCurved) return say("a curved Earth is drawn in perspective");
      const bool isParallel = rig.camera().parallelHeight > 0;
      rig.setParallel(!isParallel);
      say(isParallel ? "perspective" : "parallel projection");
      break;
    }
    case Action::axes:
      shows.marks.axes = !shows.marks.axes;
      break;
    case Action::grid:
      shows.marks.grid = !shows.marks.grid;
      break;
    case Action::orbitMark:
      shows.marks.orbit = !shows.marks.orbit;
      if (shows.marks.orbit && rig.mode() != CameraMode::orbit) say("free flight turns about nothing");
      break;
    case Action::screenshot:
      files.wantsScreenshot = true;
      break;
    case Action::decorations:
      shows.decorations = !shows.decorations;
      break;
    case Action::panel:
      shows.panel = !shows.panel;
      break;
    case Action::cancel:
      question.no();
      break;
    case Action::help:
      shows.help = !shows.help;
      break;
  }
}

void ViewerSession::saveFlight(const std::filesystem::path& path) {
  const Status saved = deck.save(path, georeference());
  say(saved ? "saved " + path.string() : saved.error().describe());
}

void ViewerSession::toggleFrames() {
  if (files.wantsFrames) {
    files.wantsFrames = false;
    return;
  }
  if (const auto flight = deck.flight(); !flight) return say(flight.error().describe());
  files.wantsFrames = question.mayDo(Saving::frames, files.framesFolder);
}

void ViewerSession::answer(bool isYes) {
  if (!isYes) return question.no();
  const auto wish = question.yes();
  if (!wish) return;
  if (wish->saving == Saving::flight) return saveFlight(wish->path);
  if (wish->saving == Saving::mesh) return desk ? say(desk->confirmed()) : void();
  files.framesFolder = wish->path;
  files.wantsFrames = true;
}

Georeference ViewerSession::georeference() const {
  return tools ? tools->model().georeference : Georeference{};
}

void ViewerSession::click(Vec2 pixel) {
  auto pick = subject.pick(rig.camera(), pixel, settings);
  if (!pick) return;
  if (objects) pick->drawnError = objects->drawnError(*pick, rig.camera(), pixel, settings);
  if (objects && objects->count() > 1) say(objects->select(pick->object));
  if (tools) return say(tools->add(*pick));
  distance.add(*pick);
}

void ViewerSession::home(HomeView view) {
  deck.stop();
  rig.home(view, settings.isCurved, covered);
  home_ = homeNow(view);
}

void ViewerSession::goTo(const std::string& text, bool isLonLat) {
  if (!tools) return say("places to go to are for terrain");
  const auto goal = tools->places.read(text, isLonLat);
  if (!goal) return say(goal.error().describe());
  deck.stop();
  // A place without a height is looked at in orbit, from a tenth of the box's diagonal but at most 2 km.
  if (!goal->height) {
    const double near = std::min(2000.0, subject.box().diagonal() / 10);
    rig.setMode(CameraMode::orbit);
    return rig.lookAt(subject.space().position(goal->xy, goal->ground), near);
  }
  Camera camera = rig.camera();
  camera.xy = goal->xy;
  camera.height = *goal->height;
  rig.place(camera);
}

void ViewerSession::flyAround() {
  auto round = subject.round(rig.camera());
  if (round)
    deck.setPlan(*round);
  else
    say(round.error().describe());
}

}  // namespace arete
