// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "engine/base/result.h"
#include "engine/base/similarity.h"
#include "viewer/gl/color_maps_on_gpu.h"
#include "viewer/gl/frame_block.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/scene/triangle_ink.h"
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
  GLuint ids = 0;      ///< a triangle of the MT each; 0: none
  VertexStreams vertices;
  std::span<const Range> ranges = {};
};

/// An ink in graphics memory.
struct InkOnGpu {
  GlBuffer numbers;
  ColorMapsOnGpu colors;

  explicit InkOnGpu(const TriangleInk& ink);
};

/// Draws fronts of a surface and what is behind them into the framebuffer that is bound.
class SurfacePainter {
 public:
  /// Errors: unsupported, by the driver.
  static Result<SurfacePainter> create();

  /// `frame`: of upright space. `isBlended`: whether the front is of triangles that let light through: they
  /// are drawn in their order over what is there, and leave depths as they are.
  ///
  /// @param turned how the surface is turned out of east, north and up, which the sun stands in.
  /// @param ink of Coloring::ink, and of fronts with the ids of their triangles; null otherwise.
  void draw(const MaterialsOnGpu& materials, const DrawnSurface& front, const FrameView& frame,
            const ViewLook& look, const Similarity& turned = {}, bool isBlended = false,
            const InkOnGpu* ink = nullptr);
  void drawBackground();

  /// Whether a material lets light through, by the colours that are shown.
  static bool isBlended(const DrawnMaterial& material, const ViewLook& look) {
    return look.coloring == Coloring::material && material.alpha == DrawnMaterial::Alpha::blended;
  }

 private:
  SurfacePainter() = default;
  struct Look;
  static Look lookOf(const DrawnMaterial& material, const VertexStreams& vertices, const ViewLook& look);
  void drawRange(const DrawnSurface::Range& range, const Look& look);

  GlProgram surface_, background_;
  GlBuffer frame_, look_, nothing_;
  ColorMapsOnGpu errorColors_;
  GlTexture reflected_;  // viewer/surface/reflected_light.h
  GlVertexArray surfaceArray_, emptyArray_;
};

}  // namespace arete
