// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "terrain/model/terrain_model.h"
#include "viewer/gl/color_maps_on_gpu.h"
#include "viewer/gl/drawn_front.h"
#include "viewer/gl/frame_block.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/gl/heights_on_gpu.h"
#include "viewer/gl/terrain_on_gpu.h"
#include "viewer/scene/layer.h"
#include "viewer/scene/view_settings.h"

namespace arete {

/// Draws fronts of one terrain and the sky behind them, into the framebuffer that is bound.
class TerrainPainter {
 public:
  /// Heights, slopes and aspects that are painted have full resolution, whatever front is drawn
  /// (viewer/heights/height_pyramid.h). O(samples). Errors: unsupported, by the driver; as
  /// HeightPyramid and HeightsOnGpu.
  static Result<TerrainPainter> create(const TerrainModel& model, const HeightsOptions& options = {},
                                       const RunContext& context = {});
  const HeightsOnGpu& heights() const { return *heights_; }

  /// The frame's block goes into uniform buffer binding 0, for cuts as well.
  void setFrame(const FrameView& frame);

  /// The layers of the next pictures, the lowest first: those on the ground that are visible. A picture of an
  /// overlay is uploaded once. Errors: usage: more than Layers::kMostOnGround, naming the first too
  /// many.
  Status setLayers(std::span<const Layer> layers);

  /// What is drawn without other colours in the look: the table's, from the lowest vertex to the highest.
  const TerrainColors& ownColors() const { return *ownColors_; }

  /// What the look's colours leave transparent is plain ground.
  /// Preconditions: the frame is set; colouring by error: terrain.triangleErrors are there.
  /// Errors: unsupported, by the driver.
  Status draw(const TerrainOnGpu& terrain, const DrawnFront& front, const ViewLook& look);
  void drawSky(const ViewLook& look);
  /// Draws in one colour, without the sky, to count covered pixels.
  Status drawFlat(const TerrainOnGpu& terrain, const DrawnFront& front, const glm::vec4& color);

 private:
  TerrainPainter() = default;
  struct Look;
  glm::vec4 sunOf(const ViewLook& look) const;
  void takeColors(const ViewLook& look);
  /// Made at its first use; without a look, of one colour. Errors: unsupported, by the driver.
  Result<GLuint> programFor(const ViewLook* look);
  void drawWith(GLuint program, const TerrainOnGpu& terrain, const DrawnFront& front, const Look& look);

  std::map<std::string, GlProgram> programs_;  // of the terrain, by their definitions
  GlProgram sky_;
  GlBuffer frame_, look_, noIds_;
  GlVertexArray terrainArray_, emptyArray_;
  std::optional<HeightsOnGpu> heights_;
  ColorMapsOnGpu colorMaps_;                                 // of heights, slopes, aspects, errors
  std::shared_ptr<const TerrainColors> ownColors_, colors_;  // colors_: uploaded
  struct Ground {
    Layer layer;
    GlTexture overlay = {};
  };
  std::vector<Ground> ground_;
  double heightGrain_ = 1;  // heights are coloured as multiples of it
  Vec2 eyePlan_;
  MetricFrame metric_;
  Vec2 east_, north_;  // of the map, in metric space
  OutwardScale scale_;
};

}  // namespace arete
