// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"
#include "viewer/heights/finest_lattice.h"

namespace arete {

struct PyramidOptions {
  /// Of the lattice that points are resampled on, in metric units; 0 = a quarter of their mean spacing.
  double step = 0;
  std::uint64_t mostNodes = std::uint64_t(1) << 24;  ///< of that lattice
};

/// Heights, slopes and aspects of a terrain at full resolution and as means over squares of 2, 4, 8 ...
/// nodes: what is painted on the ground reads it, whatever triangles are drawn.
///
/// The nodes of level 0 are the samples of a raster, whose cells are its finest triangles; of points, and of
/// a raster that is triangulated in another way, a lattice over the finest triangulation. Slopes at a node
/// are central differences [ZevenbergenThorne1987] (one-sided beside what has no data), in metres on the
/// ground at the place, whatever the CRS and its unit. A coarser level has means over what has data: of
/// heights, of the angles of slopes, and of the unit vectors of aspects, which add up to nothing where
/// aspects cancel.
class HeightPyramid {
 public:
  /// Means over a node's square, each times the part of it that has data.
  struct Ground {
    std::int16_t slope = 0;            ///< kOne = 90 degrees
    std::int16_t east = 0, north = 0;  ///< downhill, kOne = 1; axes of the map
    std::int16_t covered = 0;          ///< the part that has data, kOne = all
  };
  static constexpr double kOne = 32767;

  struct Level {
    std::uint32_t columns = 0, rows = 0;
    std::vector<float> heights = {};  ///< above base(); kNone without data
    std::vector<Ground> ground = {};
  };
  static constexpr float kNone = -3e38f;

  /// O(nodes), parallel. Errors: as latticeOfTriangles(); interrupted.
  static Result<HeightPyramid> create(const TerrainModel& model, const PyramidOptions& options = {},
                                      const RunContext& context = {});

  /// One node without data.
  static HeightPyramid none();

  const std::vector<Level>& levels() const { return levels_; }
  /// Plan position p is at node p * scale() + shift() of level 0, and at (q + 1/2) / 2^k - 1/2 of level k.
  Vec2 scale() const { return scale_; }
  Vec2 shift() const { return shift_; }
  double base() const { return base_; }
  /// The farthest that a height is from the base.
  double reach() const { return reach_; }
  /// Whether heights between nodes of level 0 are exactly the finest triangulation's.
  bool isExact() const { return isExact_; }
  /// The spacing of nodes in metric units, along x and y.
  Vec2 spacing() const { return spacing_; }
  /// What differs from full resolution, as sentences.
  const Warnings& warnings() const { return warnings_; }

  /// The height of level 0 at a plan position: on the triangle of its cell; nothing where there is none.
  std::optional<double> heightAt(Vec2 plan) const;

 private:
  HeightPyramid() = default;

  std::vector<Level> levels_;
  Vec2 scale_ = {1, 1}, shift_, spacing_;
  double base_ = 0, reach_ = 0;
  bool isExact_ = false;
  Warnings warnings_;
};

}  // namespace arete
