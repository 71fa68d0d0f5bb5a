// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every action of keys, mouse and panel ends in one function here; step() advances what depends on time.
#include "viewer/window/viewer_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arete {
namespace {

constexpr double kMessageSeconds = 8;

Camera startOf(const TerrainPicker& picker, const ViewerSession::Start& start) {
  if (start.camera) return *start.camera;
  return homeCamera(HomeView::overview, picker.space(), picker.box());
}

}  // namespace

ViewerSession::ViewerSession(const TerrainModel& terrain, const Start& start)
    : model(terrain),
      profiles(terrain),
      picker(terrain, profiles),
      rig(picker, profiles.heights(), startOf(picker, start)),
      deck(picker.space(), rig.metresPerSecond()),
      places(profiles.heights()),
      sights(terrain, profiles),
      settings(start.settings),
      wanted{.pixels = start.settings.pixels,
             .maxTriangles = start.settings.maxTriangles,
             .frameMilliseconds = start.frameMilliseconds},
      hasDrape(start.hasDrape),
      canBeCurved(!terrain.georeference.crsWkt.empty()),
      flightPath(start.flightPath),
      framesFolder("frames") {
  rig.setStretch(settings.stretch);
  settings.waits = false;
  if (!start.camera && settings.isCurved) rig.home(HomeView::overview, curvedGround());
  if (start.flight) deck.setPlan(*start.flight);
}

void ViewerSession::say(std::string sentence) {
  message_ = std::move(sentence);
  messageSeconds_ = kMessageSeconds;
}

void ViewerSession::step(const InputState& input) {
  messageSeconds_ -= input.seconds;
  if (messageSeconds_ <= 0) message_.clear();
  if (const auto camera = deck.advance(input.seconds)) rig.place(*camera);
  // A hand on the controls takes them back.
  if (rig.step(input)) deck.stop();
  rig.setStretch(settings.stretch);
  curvedGround();  // marks are drawn on it from the first frame on

  if (auto done = viewshed.take()) {
    if (*done) {
      overlay = std::move(**done);
      isOverlayNew = true;
      say(fmt::format("{:.1f} % of the samples are seen",
                      100 * double(overlay->seen) / std::max(1.0, double(overlay->cells))));
    } else {
      say(done->error().describe());
    }
  }
  if (isFrozen && !frozen) frozen = rig.camera();
  if (!isFrozen) frozen.reset();
  // Nothing to learn from a cut that stays as it is.
  if (!isFrozen)
    settings.pixels = control_.next(
        wanted, {.milliseconds = history.lastWork(), .triangles = figures.asked, .pixels = figures.pixels});
}

void ViewerSession::apply(Action action) {
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
      const Status saved = deck.save(flightPath, model.georeference);
      say(saved ? "saved " + flightPath.string() : saved.error().describe());
      break;
    }
    case Action::loadFlight: {
      // Longitudes in the file may be a whole turn away from the model's.
      const Status loaded = deck.load(flightPath, model.georeference, LongitudeTurns(model));
      say(loaded ? fmt::format("{}: {} key frames", flightPath.string(), deck.plan().keys.size())
                 : loaded.error().describe());
      break;
    }
    case Action::wireframe:
      settings.look.hasWireframe = !settings.look.hasWireframe;
      break;
    case Action::contours: {
      const double range = (picker.box().high.z - picker.box().low.z) / picker.space().metresPerHeight();
      settings.look.contourInterval = settings.look.contourInterval > 0 ? 0 : usualContourInterval(range);
      break;
    }
    case Action::freeze:
      isFrozen = !isFrozen;
      break;
    case Action::geomorph:
      settings.isGeomorphed = !settings.isGeomorphed;
      say(settings.isGeomorphed ? "geomorphing on" : "geomorphing off");
      break;
    case Action::colorHeight:
      return color(Coloring::hypsometric);
    case Action::colorSlope:
      return color(Coloring::slope);
    case Action::colorAspect:
      return color(Coloring::aspect);
    case Action::colorPlain:
      return color(Coloring::plain);
    case Action::colorError:
      return color(Coloring::error);
    case Action::clearPicks:
      return clearPicks();
    case Action::screenshot:
      wantsScreenshot = true;
      break;
    case Action::panel:
      showsPanel = !showsPanel;
      break;
    case Action::help:
      showsHelp = !showsHelp;
      break;
  }
}

const CurvedGround* ViewerSession::curvedGround() {
  if (!settings.isCurved) return nullptr;
  // The ground is made at its first use. A CRS without an ellipsoid leaves the map flat, and that is said
  // once.
  if (!ground_) {
    Result<CurvedGround> made = CurvedGround::create(model);
    if (made) {
      ground_ = std::move(*made);
    } else {
      settings.isCurved = false;
      say(made.error().describe());
    }
  }
  return ground_ ? &*ground_ : nullptr;
}

std::optional<Vec2> ViewerSession::pixelOf(const Vec3& metric) const {
  if (settings.isCurved && ground_) return picker.pixelOf(*ground_, rig.camera(), metric, settings.stretch);
  return arete::pixelOf(picker.space(), rig.camera(), metric, settings.stretch);
}

void ViewerSession::click(Vec2 pixel) {
  const CurvedGround* ground = curvedGround();
  const auto pick = ground ? picker.at(*ground, rig.camera(), pixel, settings.stretch)
                           : picker.at(rig.camera(), pixel, settings.stretch);
  if (!pick) return;
  // A third click begins the next pair.
  if (picks.size() >= 2) picks.clear();
  picks.push_back(*pick);
  updateSight();
}

void ViewerSession::updateSight() {
  sight.reset();
  if (picks.size() < 2) return;
  auto found = sights.between(picks[0], observerAbove, picks[1], targetAbove);
  if (found)
    sight = std::move(*found);
  else
    say(found.error().describe());
}

void ViewerSession::clearPicks() {
  picks.clear();
  sight.reset();
  // The viewshed is seen from a pick, so it goes with the picks, finished or not.
  viewshed.cancel();
  overlay.reset();
  isOverlayNew = true;
}

void ViewerSession::startViewshed() {
  if (picks.empty()) return say("a viewshed is seen from a pick: click on the terrain first");
  const TerrainPick& from = picks.back();
  viewshed.start(model, sights.earth(), {sightPlan(model, from.xy), from.height + observerAbove}, targetAbove,
                 mostOverlayPixels);
}

void ViewerSession::home(HomeView view) {
  deck.stop();
  rig.home(view, curvedGround());
}

void ViewerSession::goTo(const std::string& text, bool isLonLat) {
  const auto goal = places.read(text, isLonLat);
  if (!goal) return say(goal.error().describe());
  deck.stop();
  // A place without a height is looked at in orbit, from a tenth of the box's diagonal but at most 2 km.
  if (!goal->height) {
    const double near = std::min(2000.0, picker.box().diagonal() / 10);
    rig.setMode(CameraMode::orbit);
    return rig.lookAt(picker.space().position(goal->xy, goal->ground), near);
  }
  Camera camera = rig.camera();
  camera.xy = goal->xy;
  camera.height = *goal->height;
  rig.place(camera);
}

std::vector<std::array<Vec3, 2>> frustumEdges(const CameraSpace& space, const Camera& camera, double depth,
                                              double stretch) {
  // Rays leave from the eye as it is drawn, stretched; the corners return to heights as they are.
  Vec3 eye = space.position(camera);
  eye.z *= stretch;
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 pixel{i == 1 || i == 2 ? camera.widthPixels : 0, i >= 2 ? camera.heightPixels : 0};
    const Vec3 d = directionOfPixel(space, camera, pixel);
    corners[i] = {eye.x + depth * d.x, eye.y + depth * d.y, (eye.z + depth * d.z) / stretch};
  }
  eye.z /= stretch;
  std::vector<std::array<Vec3, 2>> edges;
  for (std::size_t i = 0; i < 4; ++i) {
    edges.push_back({eye, corners[i]});
    edges.push_back({corners[i], corners[(i + 1) % 4]});
  }
  return edges;
}

double usualContourInterval(double heightRange) {
  if (!(heightRange > 0)) return 1;
  // The leading digits become the nearest of 1, 2, 5 and 10.
  const double rough = heightRange / 12, power = std::pow(10, std::floor(std::log10(rough)));
  const double lead = rough / power;
  return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

}  // namespace arete
