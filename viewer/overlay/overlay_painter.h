// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "engine/base/result.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/gl/gl_program.h"

namespace arete {

/// Lays a picture with transparent parts over the whole framebuffer that is bound.
class OverlayPainter {
 public:
  /// Errors: unsupported, by the driver.
  static Result<OverlayPainter> create();

  /// @param rgba as Canvas::premultipliedRgba() gives it: four bytes a pixel.
  void setPicture(int width, int height, std::span<const std::uint8_t> rgba);
  /// Precondition: there is a picture.
  void draw() const;

 private:
  OverlayPainter() = default;
  GlProgram program_;
  GlVertexArray array_;
  GlTexture picture_;
  int width_ = 0, height_ = 0;
};

}  // namespace arete
