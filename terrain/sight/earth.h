// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "engine/base/result.h"
#include "terrain/model/terrain_model.h"
#include "terrain/sight/line.h"

namespace arete {

/// Where a line of sight between two places runs over the ground, and how the Earth curves below it. Plan
/// coordinates are those of the model. Thread-safe.
class SightEarth {
 public:
  virtual ~SightEarth() = default;
  /// The track begins and ends where sightEnd() puts the two places. Errors: invalidData for a place that the
  /// Earth model cannot tell (beyond a projection's reach).
  virtual Result<SightTrack> track(Vec2 from, Vec2 to) const = 0;
  /// Metres along the ground between two places, which may be known where no track is. O(track).
  virtual std::optional<double> distance(Vec2 from, Vec2 to) const;
  /// Where all tracks are straight, distances are linear in the plan and nothing curves: metres east and
  /// north that a step of one plan unit makes. Else nothing.
  struct PlaneSteps {
    Vec2 x, y;
  };
  virtual std::optional<PlaneSteps> planeSteps() const { return std::nullopt; }
  /// Where tracks run over geodesics, so that those from one place in one direction lie on one another, cut
  /// into equal pieces, the fewest (2^k) in whose middles they are within an error of the geodesic: that
  /// error, which holds for all of a piece, in plan units along x and along y. Else nothing.
  virtual std::optional<double> geodesicError() const { return std::nullopt; }
};

/// A place within `margin` of a lattice line of the raster is on it: coordinates are rounded.
Vec2 sightEnd(const TerrainModel& model, Vec2 plan, double margin = kShortestInPlan);

/// The map taken as it is: straight in plan, no curvature. Distances are those of the map in metres; of a
/// geographic CRS, by the ground size of a sample's steps in the middle of the DEM.
std::unique_ptr<SightEarth> makePlaneEarth(const TerrainModel& model);

}  // namespace arete
