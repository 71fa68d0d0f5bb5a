// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "terrain/model/terrain_model.h"
#include "viewer/gl/drawn_front.h"
#include "viewer/gl/frame_block.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/gl/terrain_on_gpu.h"
#include "viewer/scene/layer.h"
#include "viewer/scene/view_settings.h"

namespace arete {

/// Draws fronts of one terrain and the sky behind them, into the framebuffer that is bound.
class TerrainPainter {
 public:
  /// Slopes for the shading are those of the samples, whatever front is drawn, so that light does not change
  /// with the level of detail. O(samples) of a raster. Errors: unsupported, by the driver.
  static Result<TerrainPainter> create(const TerrainModel& model);

  /// The frame's block goes into uniform buffer binding 0, for cuts as well.
  void setFrame(const FrameView& frame);

  /// The layers of the next pictures, the lowest first: those on the ground that are visible. A picture of an
  /// overlay is uploaded once. Errors: unsupported: more than Layers::kMostOnGround, naming the first too
  /// many.
  Status setLayers(std::span<const Layer> layers);

  /// Preconditions: the frame is set; colouring by error: terrain.triangleErrors are there.
  void draw(const TerrainOnGpu& terrain, const DrawnFront& front, const ViewLook& look);
  void drawSky(const ViewLook& look);
  /// Draws in one colour, without the sky, to count covered pixels.
  void drawFlat(const TerrainOnGpu& terrain, const DrawnFront& front, const glm::vec4& color);

 private:
  TerrainPainter() = default;
  struct Look;
  struct Ground {
    Layer layer;
    GlTexture overlay = {};
  };
  glm::vec4 sunOf(const ViewLook& look) const;
  void drawWith(const TerrainOnGpu& terrain, const DrawnFront& front, const Look& look);

  Status useProgramFor(const std::vector<Ground>& ground);

  std::map<std::string, GlProgram> terrains_;  // by their calls of layers
  GLuint terrain_ = 0;                         // which of them is used
  GlProgram sky_;
  GlBuffer frame_, look_, noIds_;
  GlVertexArray terrainArray_, emptyArray_;
  GlTexture slopes_, tints_;
  std::vector<Ground> ground_;
  bool hasSlopes_ = false;
  Vec2 eyePlan_;
  MetricFrame metric_;
  double lowest_ = 0, highest_ = 0;  // metric z
  Vec2 east_, north_;                // of the map, in metric space
  OutwardScale scale_;
};

}  // namespace arete
