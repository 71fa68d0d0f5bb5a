// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "terrain/locate/ground_height.h"
#include "terrain/sight/grid.h"
#include "terrain/sight/line.h"

namespace arete {

struct ProfileVertex {
  double distance = 0;  ///< metres along the ground
  Vec2 plan;
  double height = 0;      ///< in the DEM's vertical unit
  bool isJoined = false;  ///< terrain is straight from the vertex before to this one; else there is a gap
};

/// The terrain below a track: straight between joined vertices. Distances rise. With a tolerance, two
/// vertices may have one distance and different heights, where triangles of different detail meet; they are
/// no further apart than the two triangles' bounds together.
struct Profile {
  std::vector<ProfileVertex> vertices;
  double length = 0;     ///< metres along the ground
  double gapMetres = 0;  ///< how much of the length has no terrain
};

/// Computes profiles. With a tolerance, or without the samples of a raster, from the root triangles below a
/// track down through the multitriangulation, to the first triangles whose bound is within the tolerance;
/// else over the cells of the raster. Every crossing of an edge is a vertex. Thread-safe.
class Profiles {
 public:
  /// O(root triangles).
  /// @param model outlives this.
  /// @param grid the model's samples, possibly shared; may be null.
  explicit Profiles(const TerrainModel& model, std::shared_ptr<const SightGrid> grid = {})
      : heights_(model), grid_(std::move(grid)) {}

  /// O(vertices * depth * degree), over cells O(vertices).
  /// @param maxError in the DEM's vertical unit: the profile is within it of full resolution everywhere; 0 =
  ///     full resolution.
  /// @return the profile; of a track without length, one vertex, or none where there is no terrain.
  Profile along(const SightTrack& track, double maxError = 0) const;

  const GroundHeights& heights() const { return heights_; }

 private:
  GroundHeights heights_;
  std::shared_ptr<const SightGrid> grid_;
};

}  // namespace arete
