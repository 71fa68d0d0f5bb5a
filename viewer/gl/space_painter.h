// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/scene/layer.h"
#include "viewer/scene/view_settings.h"

namespace arete {

/// Draws the layers that stand in space into the framebuffer that is bound, behind or before what is there.
class SpacePainter {
 public:
  /// Errors: unsupported, by the driver.
  static Result<SpacePainter> create();

  /// `drawn`: its places are where they are drawn (Subject::drawn()); `frame`: of a model of the scene. What
  /// is not finite is left out, with its line.
  void draw(const SpaceVertices& drawn, const FrameView& frame, double opacity);

 private:
  SpacePainter() = default;
  GlProgram program_;
  GlBuffer frame_;
  GlVertexArray array_;
};

}  // namespace arete
