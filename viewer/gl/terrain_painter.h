// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "engine/base/result.h"
#include "terrain/model/terrain_model.h"
#include "viewer/gl/color_maps_on_gpu.h"
#include "viewer/gl/drawn_front.h"
#include "viewer/gl/frame_block.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/gl/terrain_on_gpu.h"
#include "viewer/picture/picture.h"
#include "viewer/scene/view_look.h"

namespace arete {

class DrapeOnGpu;

/// Draws fronts of one terrain and the sky behind them, into the framebuffer that is bound.
class TerrainPainter {
 public:
  /// Slopes for the shading are those of the samples, whatever front is drawn, so that light does not change
  /// with the level of detail. O(samples) of a raster. Errors: unsupported, by the driver.
  static Result<TerrainPainter> create(const TerrainModel& model);

  /// The frame's block goes into uniform buffer binding 0, for cuts as well.
  void setFrame(const FrameView& frame);

  /// A picture over the plan: (u, v) = plan * scale + shift, v downwards from its first row; transparent
  /// where alpha is 0. Empty to remove it.
  void setOverlay(int width, int height, std::span<const std::array<std::uint8_t, 4>> rgba, Vec2 scale,
                  Vec2 shift);
  /// Precondition: it outlives the painter or the next call. Null to remove it.
  void setDrape(const DrapeOnGpu* drape) { drape_ = drape; }

  /// The colours of heights, in the unit of heights. Before the first call: "height" from the lowest vertex
  /// to the highest. What it leaves transparent is plain ground.
  void setHeightColors(const ColorMap& colors);

  /// Preconditions: the frame is set; colouring by error: terrain.triangleErrors are there.
  void draw(const TerrainOnGpu& terrain, const DrawnFront& front, const ViewLook& look);
  void drawSky(const ViewLook& look);
  /// Draws in one colour, without the sky, to count covered pixels.
  void drawFlat(const TerrainOnGpu& terrain, const DrawnFront& front, const glm::vec4& color);

  struct LineEnd {
    std::array<float, 3> position;  ///< TerrainView::drawnPosition()
    std::array<std::uint8_t, 4> color;
  };
  /// Lines between pairs of ends. `isAlwaysSeen`: also behind the terrain.
  void drawLines(std::span<const LineEnd> ends, bool isAlwaysSeen = false);

 private:
  TerrainPainter() = default;
  struct Look;
  void drawWith(const TerrainOnGpu& terrain, const DrawnFront& front, const Look& look);

  GlProgram terrain_, sky_, lines_;
  GlBuffer frame_, look_, noIds_;
  GlVertexArray terrainArray_, emptyArray_, linesArray_;
  GlTexture slopes_, overlay_;
  ColorMapsOnGpu colorMaps_;  // of heights, slopes, aspects, errors
  glm::vec4 overlayFrame_{};
  bool hasSlopes_ = false, hasOverlay_ = false;
  const DrapeOnGpu* drape_ = nullptr;
  Vec2 eyePlan_;
  MetricFrame metric_;
  double lowest_ = 0, highest_ = 0;  // metric z
  Vec2 east_, north_;                // of the map, in metric space
  double metresPerUnit_ = 1;         // of metric space
  OutwardScale scale_;
};

}  // namespace arete
