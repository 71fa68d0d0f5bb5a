// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "terrain/locate/ground_height.h"
#include "viewer/camera/camera_space.h"

namespace arete {

struct GroundFollowingOptions {
  double floorMetres = 2;  ///< no camera is ever lower above the ground
  /// How exact the ground is taken, in the DEM's vertical unit; what it may be off counts as ground.
  double maxError = 1;
  double lookAheadSeconds = 2;  ///< ground that the camera reaches so soon lifts it already
  double settleSeconds = 0.8;   ///< about a third of the time a change of height takes
};

/// Keeps a camera above the terrain: never below a floor, and on request at a height above the ground that it
/// follows smoothly. Where there is no terrain (NODATA, outside) the last ground counts; before there was any
/// nothing does. The floor holds above full resolution, at every place that the camera is put to.
///
/// Keeps a reference to the heights. One thread at a time.
class GroundFollowing {
 public:
  using Options = GroundFollowingOptions;

  /// Precondition: the heights outlive this.
  GroundFollowing(const GroundHeights& heights, const CameraSpace& space, const Options& options = {});

  /// The camera, raised to the floor where it is lower.
  Camera aboveFloor(Camera camera);

  /// Begins to follow at the camera's height above the ground, or at the floor where it is lower.
  void begin(const Camera& camera);
  /// The camera at the height that is kept, after so many seconds; where it came by its own height does not
  /// count. Precondition: begin(); seconds >= 0.
  Camera follow(Camera camera, double seconds);

  /// Metres above the ground, at least the floor.
  double keptMetres() const { return kept_; }
  void keep(double metres);

 private:
  std::optional<double> groundMetres(Vec2 xy) const;

  const GroundHeights& heights_;
  CameraSpace space_;
  Options options_;
  std::optional<double> lastGround_;  // metric z
  double kept_ = 0;
  Vec3 place_;             // where follow() left the camera
  double climbSpeed_ = 0;  // metres per second
};

}  // namespace arete
