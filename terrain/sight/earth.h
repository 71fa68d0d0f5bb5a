// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "engine/base/result.h"
#include "terrain/model/terrain_model.h"
#include "terrain/sight/line.h"

namespace arete {

/// How the ground is measured and how it curves: the tracks of sight lines between two places. Places are in
/// plan coordinates of the model. Thread-safe. Tracks on the ellipsoid need a CRS:
/// io/geo/crs/ellipsoid_earth.h.
class SightEarth {
 public:
  virtual ~SightEarth() = default;
  /// @return the track between two places, from sightEnd(from) to sightEnd(to). Errors: invalidData: a place
  ///     is out of reach of the Earth model, for example of a projection's inverse.
  virtual Result<SightTrack> track(Vec2 from, Vec2 to) const = 0;
  /// @return metres along the ground between two places; nothing if unknown. May be known where track()
  ///     fails. O(track).
  virtual std::optional<double> distance(Vec2 from, Vec2 to) const;
  /// Metres east and north of a step of one plan unit along x, along y.
  struct PlaneSteps {
    Vec2 x, y;
  };
  /// @return the steps, if all tracks are straight in plan, distances are linear in it and nothing curves.
  virtual std::optional<PlaneSteps> planeSteps() const { return std::nullopt; }
  /// @return e, in plan units along x and along y, if tracks follow geodesics: a track is a geodesic cut into
  ///     the fewest equal legs (2^k) at whose quarters the leg is within e of the geodesic, and all of each
  ///     leg is within e. Tracks from one place in one direction then lie on one geodesic.
  virtual std::optional<double> geodesicError() const { return std::nullopt; }
};

/// The tracks between consecutive places, as one; the azimuth is that of the first. Of one place a
/// track without length. Precondition: a place or more. Errors: as SightEarth::track().
Result<SightTrack> trackAlong(std::span<const Vec2> places, const SightEarth& earth);

/// Puts a place on the lattice lines of a raster that it is within `margin` of, since coordinates are
/// rounded. Places of a model of points stay as they are.
Vec2 sightEnd(const TerrainModel& model, Vec2 plan, double margin = kShortestInPlan);

/// The map as a plane: tracks are straight in plan and nothing curves. Distances are those of the map in
/// metres, by its scale, or the size of a degree, in the middle of the DEM.
/// Precondition: the model outlives the result.
std::unique_ptr<SightEarth> makePlaneEarth(const TerrainModel& model);
std::unique_ptr<SightEarth> makePlaneEarth(TerrainModel&& model) = delete;

}  // namespace arete
