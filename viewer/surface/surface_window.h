// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "viewer/surface/surface_view.h"

namespace arete {

struct SurfaceWindowOptions {
  std::string title = "arete";
  std::optional<Camera> camera = {};  ///< of upright space; nothing: the home view
  HomeView home = HomeView::overview;
  SurfaceViewSettings settings = {};
  int width = 1280, height = 800;  ///< of the window at first, in the screen's own units
  int samples = 4;                 ///< per pixel, to smooth edges

  std::filesystem::path lastPicture = {};  ///< saved when the window closes; empty = nothing
  int frames = 0;                          ///< the window closes by itself after so many; 0 = never
};

/// Opens a window on a surface, which the mouse turns, moves and comes nearer to, and shows it until the user
/// closes it (docs/topics/surfaces.md, "In the window"). On the thread of main(); one window at a time.
/// Errors: unsupported (no display; OpenGL below 4.5), interrupted, those of saving.
Status runSurfaceWindow(const SurfaceModel& model, const ZUpFrame& upright,
                        const SurfaceWindowOptions& options, const RunContext& context = {});

}  // namespace arete
