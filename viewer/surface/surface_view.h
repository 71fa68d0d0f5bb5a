// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_model.h"
#include "terrain/model/camera.h"
#include "viewer/surface/surface_painter.h"
#include "viewer/surface/z_up_frame.h"

namespace arete {

struct SurfaceViewSettings {
  double pixels = 1;               ///< tolerance of what is drawn, > 0
  std::uint32_t maxTriangles = 0;  ///< 0 = any number
  SurfaceLook look = {};
};

struct SurfaceFigures {
  std::uint32_t triangles = 0;  ///< drawn
  double pixels = 0;            ///< tolerance of the cut; larger than asked where the budget ended it
  bool isComplete = true;       ///< false: the budget ended the cut
  double cutMilliseconds = 0, drawMilliseconds = 0;
  bool showsSurface = true;  ///< false: nothing but the background; of pictures without a window
};

/// Draws one surface in an OpenGL context, for one camera at a time. Each cut starts from the last one
/// (engine/follow/incremental_cut.h).
class SurfaceView {
 public:
  /// The model stays alive as long as the view. Errors: unsupported. O(size of the model).
  static Result<SurfaceView> create(const SurfaceModel& model, const ZUpFrame& upright);
  SurfaceView(SurfaceView&&) noexcept;
  SurfaceView& operator=(SurfaceView&&) noexcept;
  ~SurfaceView();

  /// Takes the cut for a camera of upright space, without drawing; to freeze a cut, do not call it. Errors:
  /// usage, of the camera or the budget; interrupted.
  Result<SurfaceFigures> cut(const Camera& camera, const SurfaceViewSettings& settings,
                             const RunContext& context = {});
  /// Draws the last cut for the camera into the framebuffer that is bound. Errors: usage, of the camera.
  Status draw(const Camera& camera, const SurfaceViewSettings& settings);
  /// Whether a sample of the last picture shows the surface. Waits for the drawing.
  bool showsSurface() const;

  /// Pictures that are not shown, as sentences.
  const Warnings& warnings() const;
  const ZUpFrame& upright() const;
  const ZUpShape& shape() const;

 private:
  struct State;
  explicit SurfaceView(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
