// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "viewer/camera/home_view.h"
#include "viewer/camera/orbit_camera.h"
#include "viewer/surface/surface_view.h"
#include "viewer/window/input_state.h"
#include "viewer/window/key_bindings.h"

namespace arete {

/// The state of the window of a surface and its changes by keys and mouse: without OpenGL, so that tests can
/// use it. Members are live: the panel changes them in place.
class SurfaceSession {
 public:
  /// @param camera of upright space; its picture is the window's.
  SurfaceSession(ZUpShape shape, const Camera& camera, const SurfaceViewSettings& settings);

  const Camera& camera() const { return camera_; }
  void setPicture(double widthPixels, double heightPixels);
  /// Moves the camera for one frame: dragging turns the surface with the left button and moves it with the
  /// others, the wheel comes nearer, W A S D and the arrows do the same.
  void step(const InputState& input);
  /// Actions that a surface does not have do nothing.
  void apply(Action action);
  void home(HomeView view);

  SurfaceViewSettings settings;
  SurfaceFigures figures = {};
  HomeView homeView = HomeView::overview;
  bool isFrozen = false, showsPanel = true, showsHelp = false, wantsScreenshot = false;
  std::string message;

 private:
  void enter(const Camera& camera);

  ZUpShape shape_;
  OrbitCamera orbit_;
  Camera camera_;
};

}  // namespace arete
