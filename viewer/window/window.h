// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "viewer/gl/scene.h"
#include "viewer/scene/heights_of_contours.h"
#include "viewer/window/glfw_window.h"
#include "viewer/window/viewer_session.h"

namespace arete {

struct WindowOptions {
  std::string title = "arete";
  ViewerSession::Start start = {};
  int width = 1280, height = 800;  ///< of the window at first, in the screen's own units
  int samples = 4;                 ///< per pixel, to smooth edges
  bool waitsForScreen = true;      ///< vertical synchronisation

  SurfaceDesk::Start desk = {};  ///< of the surfaces that are shown
  std::string message = {};      ///< said at first; empty: how to move

  /// Of the contours that are shown; empty: none are written.
  WriteHeights heightsOfContours = {};
  /// Before every frame, counted from 0; false ends. May be empty.
  std::function<bool(ViewerSession&, int frame)> onFrame = {};
  /// Saved when the window closes: what it shows, panel and all. Empty = nothing.
  std::filesystem::path lastPicture = {};
  int frames = 0;  ///< the window closes by itself after so many; 0 = never
};

/// Opens a window on a scene and shows it until the user closes it (docs/topics/viewer.md, "In the window").
///
/// @param fill adds what is shown, a model at least, once the window has its context.
/// On the thread of main(); one window at a time. Errors: unsupported (no display; OpenGL below 4.5, naming
/// what was found), interrupted, those of `fill` and of saving.
Status runWindow(const FillScene& fill, const WindowOptions& options, const RunContext& context = {});
/// How showing a scene ended.
struct WindowEnd {
  std::string
      next;       ///< a file that is to be shown next: dropped, or just made; empty: the user has closed it
  Camera camera;  ///< of the last frame
};
/// The same in a window that is open, whose size and title stay; it is open afterwards too.
Result<WindowEnd> showIn(GlfwWindow& window, const FillScene& fill, const WindowOptions& options,
                         const RunContext& context = {});

}  // namespace arete
