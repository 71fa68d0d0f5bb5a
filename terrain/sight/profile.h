// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "terrain/locate/surface_height.h"
#include "terrain/sight/grid.h"
#include "terrain/sight/line.h"

namespace arete {

struct ProfileVertex {
  double distance = 0;  ///< metres along the ground
  Vec2 plan;
  double height = 0;      ///< in the DEM's vertical unit
  bool isJoined = false;  ///< terrain runs straight from the vertex before to this one; else there is none
};

/// The terrain below a track: straight between vertices that are joined. Distances rise; two vertices at one
/// distance and different heights are where triangles of different detail meet (a tolerance), which are no
/// further apart than both their bounds.
struct Profile {
  std::vector<ProfileVertex> vertices;
  double length = 0;     ///< metres
  double gapMetres = 0;  ///< of it without terrain
};

/// Takes profiles: from the root triangles below a track down through the multitriangulation, to the finest
/// triangles or to the first whose bound is within a tolerance; or, given the samples of a raster, over its
/// cells where no tolerance is allowed. Every crossing of an edge is a vertex.
///
/// Keeps a reference to the model. Thread-safe: it is only read.
class Profiles {
 public:
  /// grid: that of the model, shared by who has one; may be null. O(root triangles). Precondition: the model
  /// outlives this.
  explicit Profiles(const TerrainModel& model, std::shared_ptr<const SightGrid> grid = {})
      : heights_(model), grid_(std::move(grid)) {}

  /// maxError: in the DEM's vertical unit; the profile is within it of full resolution everywhere. 0 = full
  /// resolution. A track without length gives the one vertex of its place, or none. O(vertices * depth *
  /// degree), over cells O(vertices).
  Profile along(const SightTrack& track, double maxError = 0) const;

  const SurfaceHeights& heights() const { return heights_; }

 private:
  SurfaceHeights heights_;
  std::shared_ptr<const SightGrid> grid_;
};

}  // namespace arete
