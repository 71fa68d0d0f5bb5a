// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/surface_session.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "viewer/window/camera_motion.h"

namespace arete {
namespace {

/// Limits of the orbit's radius, as parts of the diagonal.
constexpr double kNearest = 1e-4, kFarthest = 100;

}  // namespace

SurfaceSession::SurfaceSession(ZUpShape shape, const Camera& camera, const SurfaceViewSettings& startSettings)
    : settings(startSettings), shape_(std::move(shape)), orbit_(CameraSpace(), {}, camera), camera_(camera) {
  enter(camera);
}

/// The orbit's middle is the place ahead that is nearest to the middle of the surface.
void SurfaceSession::enter(const Camera& camera) {
  const CameraSpace space;
  const double diagonal = shape_.box.diagonal();
  const double ahead = dot(shape_.box.centre() - space.position(camera), space.forward(lookOf(camera)));
  orbit_ = OrbitCamera::of(space, camera, std::clamp(ahead, kNearest * diagonal, kFarthest * diagonal));
  orbit_.limitRadius(kNearest * diagonal, kFarthest * diagonal);
  camera_ = camera;
}

void SurfaceSession::setPicture(double widthPixels, double heightPixels) {
  if (camera_.widthPixels == widthPixels && camera_.heightPixels == heightPixels) return;
  camera_.widthPixels = widthPixels;
  camera_.heightPixels = heightPixels;
  enter(camera_);
}

void SurfaceSession::step(const InputState& input) {
  // A drag moves what is as far away as the orbit's middle, so the middle follows the pointer.
  const double unitsPerPixel = 2 * orbit_.orbit().radius *
                               std::tan(camera_.verticalFieldOfViewDegrees * std::numbers::pi / 360) /
                               camera_.heightPixels;
  const CameraMotion motion = motionOf(input, {.mode = CameraMode::orbit, .metresPerPixel = unitsPerPixel});
  if (motion.isNone()) return;
  orbit_.turn(motion.turnRight, motion.turnUp);
  orbit_.zoom(motion.zoom);
  orbit_.pan(motion.slideRight, motion.slideAhead);
  camera_ = orbit_.camera();
}

void SurfaceSession::home(HomeView view) {
  homeView = view;
  enter(surfaceHome(view, shape_, camera_));
}

void SurfaceSession::apply(Action action) {
  // Actions for terrain alone, such as contours, do nothing here.
  switch (action) {
    case Action::nextHome: {
      const auto at = std::ranges::find(kHomeViews, homeView);
      const auto next = at == kHomeViews.end() || at + 1 == kHomeViews.end() ? kHomeViews.begin() : at + 1;
      home(*next);
      break;
    }
    case Action::wireframe:
      settings.look.hasWireframe = !settings.look.hasWireframe;
      break;
    case Action::freeze:
      isFrozen = !isFrozen;
      break;
    case Action::colorHeight:
      settings.look.coloring = SurfaceColoring::materials;
      break;
    case Action::colorPlain:
      settings.look.coloring = SurfaceColoring::plain;
      break;
    case Action::colorError:
      settings.look.coloring = SurfaceColoring::error;
      break;
    case Action::screenshot:
      wantsScreenshot = true;
      break;
    case Action::panel:
      showsPanel = !showsPanel;
      break;
    case Action::help:
      showsHelp = !showsHelp;
      break;
    default:
      break;
  }
}

}  // namespace arete
