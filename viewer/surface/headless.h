// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "viewer/picture/picture.h"
#include "viewer/surface/surface_view.h"

namespace arete {

/// Draws pictures of a surface without a screen, in an off-screen OpenGL context that is current on the
/// thread that created it.
class HeadlessSurface {
 public:
  struct Options {
    int widthPixels = 1280, heightPixels = 720;
    int samples = 4;  ///< of each pixel, to smooth edges
  };
  /// The model stays alive as long as this. Errors: unsupported (no OpenGL 4.5), usage (a size of picture
  /// that the device cannot draw).
  static Result<HeadlessSurface> create(const SurfaceModel& model, const ZUpFrame& upright,
                                        const Options& options);
  HeadlessSurface(HeadlessSurface&&) noexcept;
  HeadlessSurface& operator=(HeadlessSurface&&) noexcept;
  ~HeadlessSurface();

  /// The surface as a camera of upright space sees it. The size of the picture is that of the options, not
  /// of the camera. Errors: usage, of the camera or the budget; interrupted.
  Result<SurfaceFigures> draw(const Camera& camera, const SurfaceViewSettings& settings,
                              const RunContext& context = {});
  /// The picture that was drawn last.
  Image image() const;

  const SurfaceView& view() const;
  /// The renderer's name and the version of OpenGL.
  const std::string& description() const;

 private:
  struct State;
  explicit HeadlessSurface(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
