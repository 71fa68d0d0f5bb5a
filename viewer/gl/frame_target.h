// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/picture/picture.h"

namespace arete {

/// A framebuffer of colours and 32-bit float depths, multisampled for smooth edges.
class FrameTarget {
 public:
  /// Errors: usage, when the device cannot draw so large a picture.
  static Result<FrameTarget> create(int widthPixels, int heightPixels, int samples = 1);

  /// Binds it and clears its depth.
  void begin() const;
  /// The colours. Waits for the drawing.
  Image image() const;
  /// Depths along forward in metric units, row by row from the top, infinity where nothing is drawn; of one
  /// of the samples of each pixel. `drawnNear`: of the frame that was drawn. Waits for the drawing.
  /// `parallelReach`: that frame's depthReach, if it was of a parallel projection.
  std::vector<float> depths(double drawnNear, double parallelReach = 0) const;
  /// Copies the colours into another framebuffer (0 = the window's), of the same size.
  void copyTo(GLuint framebuffer) const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  FrameTarget() = default;
  int width_ = 0, height_ = 0, samples_ = 1;
  GlTexture color_, depth_, resolved_, resolvedDepth_;
  GlFramebuffer framebuffer_, resolvedFramebuffer_;
};

/// Of what OpenGL reads back: RGBA, four bytes a pixel, rows from the bottom. Precondition: as many bytes.
Image imageFromBottomUp(int width, int height, std::span<const std::uint8_t> rgba);

}  // namespace arete
