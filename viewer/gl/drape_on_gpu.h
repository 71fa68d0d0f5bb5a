// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/geo/drape/reader.h"
#include "viewer/gl/gl_objects.h"

namespace arete {

struct DrapeOptions {
  DrapeReadOptions read;  ///< fewer pixels are read if the device has no room
  /// Of a tile, in texels, at least 4; 0 = as suits the picture.
  std::uint32_t tileSide = 0;
};

/// A picture over the plan, of any size: every level of detail (each half as wide and high as the one before)
/// cut into tiles of one array texture, each tile with a border of its neighbours' pixels.
class DrapeOnGpu {
 public:
  /// Reads tile by tile. Errors: those of DrapeReader; unsupported (no room on the device); interrupted.
  static Result<DrapeOnGpu> load(const std::string& path, const TerrainModel& model,
                                 const DrapeOptions& options = {}, const RunContext& context = {});

  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }
  std::uint32_t tileSide() const { return side_; }
  std::uint32_t tiles() const { return layers_; }
  int levels() const { return static_cast<int>(grid_.size()); }
  std::uint64_t bytes() const { return std::uint64_t(4) * layers_ * side_ * side_; }
  /// Plan position p lies p * scale() + shift() pixels from the picture's first corner.
  Vec2 scale() const { return scale_; }
  Vec2 shift() const { return shift_; }
  /// Differences from the file as sentences: read coarser, bands chosen.
  const Warnings& warnings() const { return warnings_; }

  /// The texture and the uniforms of shaders/terrain.frag.glsl for a layer on the ground, counted from 0, for
  /// an eye over a plan position and so many units of metric space a unit of the plan.
  void bind(GLuint program, GLuint slot, Vec2 eyePlan, Vec2 metricScale) const;

 private:
  struct Level {
    std::int32_t firstLayer = 0, tilesAcross = 0, columns = 0, rows = 0, tilesDown = 0;
  };
  DrapeOnGpu() = default;
  Status upload(DrapeReader& reader, const RunContext& context);
  Status makeLevels() const;
  void planLevels(std::uint32_t columns, std::uint32_t rows);

  GlTexture texture_;
  std::uint32_t columns_ = 0, rows_ = 0, side_ = 0, layers_ = 0;
  std::vector<Level> grid_;
  Vec2 scale_, shift_;
  Warnings warnings_;
};

}  // namespace arete
