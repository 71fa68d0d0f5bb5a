// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "engine/base/result.h"
#include "engine/base/similarity.h"
#include "viewer/gl/color_maps_on_gpu.h"
#include "viewer/gl/frame_block.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/scene/view_settings.h"
#include "viewer/surface/materials_on_gpu.h"
#include "viewer/surface/surface_on_gpu.h"

namespace arete {

/// A front as it lies in graphics memory: its triangles by material.
struct DrawnSurface {
  struct Range {
    std::uint32_t material = 0, first = 0, count = 0;  ///< triangles
  };
  GLuint indices = 0;  ///< three drawn vertices a triangle
  GLuint errors = 0;   ///< a float a triangle; 0: none
  /// Positions of the drawn vertices instead of the surface's; 0: none.
  GLuint positions = 0;
  /// What materials blend, the farthest first, as runs of one material in indices of their own. They take the
  /// place of the ranges of these materials where materials are shown.
  GLuint blendedIndices = 0;
  std::span<const Range> ranges = {}, blended = {};
};

/// Draws fronts of a surface and what is behind them into the framebuffer that is bound.
class SurfacePainter {
 public:
  /// Errors: unsupported, by the driver.
  static Result<SurfacePainter> create();

  /// What hides what is behind it. `frame`: of upright space.
  ///
  /// @param turned how the surface is turned out of east, north and up, which the sun stands in.
  void draw(const SurfaceOnGpu& surface, const MaterialsOnGpu& materials, const DrawnSurface& front,
            const FrameView& frame, const ViewLook& look, const Similarity& turned = {});
  /// What is blended, in its order, over all that has been drawn.
  void drawBlended(const SurfaceOnGpu& surface, const MaterialsOnGpu& materials, const DrawnSurface& front,
                   const FrameView& frame, const ViewLook& look, const Similarity& turned = {});
  void drawBackground();

 private:
  SurfacePainter() = default;
  struct Look;
  class Pass;
  void drawRange(const DrawnSurface::Range& range, const Look& look);

  GlProgram surface_, background_;
  GlBuffer frame_, look_, nothing_;
  ColorMapsOnGpu errorColors_;
  GlVertexArray surfaceArray_, emptyArray_;
};

}  // namespace arete
