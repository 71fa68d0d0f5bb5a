// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/heights/height_pyramid.h"

namespace arete {

struct HeightsOptions {
  /// Graphics memory at most; levels that do not fit are left out, the finest first.
  std::uint64_t mostBytes = std::uint64_t(512) << 20;
  /// Of a tile, in texels, at least 4; 0 = as suits the terrain.
  std::uint32_t tileSide = 0;
  /// Nothing is kept: what is painted takes the heights and slopes of the triangles that are drawn.
  bool isOfDrawn = false;
};

/// A HeightPyramid in graphics memory, of any size: every level cut into tiles of two array textures
/// (heights; slopes, aspects and what is covered), each tile with a border of its neighbours' first texels.
class HeightsOnGpu {
 public:
  /// Errors: unsupported (no room on the device for the coarsest level); interrupted.
  static Result<HeightsOnGpu> load(const HeightPyramid& pyramid, const HeightsOptions& options = {},
                                   const RunContext& context = {});

  /// The finest level that there is room for; 0 = full resolution.
  int finestLevel() const { return finest_; }
  std::uint64_t bytes() const;
  /// Of the pyramid, and that levels are left out.
  const Warnings& warnings() const { return warnings_; }
  /// What heights in the texture are counted from, and how far they reach from it.
  double base() const { return base_; }
  double reach() const { return reach_; }

  /// The textures and the block of shaders/ground.glsl, for an eye over a plan position and so many units of
  /// metric space a unit of the plan.
  void bind(Vec2 eyePlan, Vec2 metricScale) const;

 private:
  struct Tiles {
    std::int32_t firstLayer = 0, across = 0, columns = 0, rows = 0, down = 0;
  };
  HeightsOnGpu() = default;
  void plan(const HeightPyramid& pyramid);
  Status upload(const HeightPyramid& pyramid, const RunContext& context);

  GlTexture heights_, slopes_;
  GlBuffer block_;
  std::vector<Tiles> levels_;  // without room, of no tile
  std::uint32_t side_ = 0, layers_ = 0;
  int finest_ = 0;
  bool isExact_ = false;
  Vec2 scale_, shift_;
  double base_ = 0, reach_ = 0;
  Warnings warnings_;
};

}  // namespace arete
