// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "engine/base/result.h"
#include "engine/criteria/view.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/camera.h"
#include "terrain/model/terrain_model.h"
#include "viewer/camera/home_view.h"

namespace arete {

/// The ground of a model as it lies on the ellipsoid of its CRS, in a Cartesian space of metres: its origin
/// is the middle of the DEM at the middle of its heights, where z is up and the columns of the raster (the x
/// axis of points) run along x. Near there it is the flat metric space of the model (terrain/model/camera.h);
/// it is mirrored against the map where that one is.
///
/// Heights count as heights above the ellipsoid, whatever their datum: a geoid moves everything by tens of
/// metres, and bends nothing that is seen. Exaggeration multiplies heights above the origin's, along each
/// place's own vertical. Thread-safe. The model outlives it.
class CurvedGround {
 public:
  /// Errors: usage (no CRS), unsupported (a CRS that knows no longitude and latitude), invalidData (one that
  /// PROJ knows no way for, or that does not reach the DEM).
  static Result<CurvedGround> create(const TerrainModel& model);

  /// Not finite where the CRS does not reach.
  Vec3 position(Vec2 xy, double height, double stretch = 1) const;
  /// Back: source coordinates and height.
  Vec3 source(const Vec3& position, double stretch = 1) const;

  /// As viewOf() has it, with the verticals and directions of the camera's own place: azimuths from the map's
  /// north there, pitches from the level there. Errors: usage, of a camera's numbers or for a place that the
  /// CRS does not reach, as are the poles of a geographic one.
  Result<View> viewOf(const Camera& camera, double stretch = 1) const;

  /// Back: the camera that stands at a place of this space and looks ahead, of `picture`'s size and field of
  /// view. Cameras do not roll. Where it looks along the vertical within a degree, the top of the picture is
  /// that of the axes, and ahead may be as far off. Errors: usage, as above.
  Result<Camera> cameraAt(const Vec3& eye, const PictureAxes& axes, const Camera& picture = {},
                          double stretch = 1) const;

  /// The model's multitriangulation there (engine/mt/curved_mt.h). Errors: invalidData for a vertex that the
  /// CRS does not reach; interrupted. O(vertices) of PROJ for a projected CRS, in parallel.
  Result<MultiTriangulation> curvedMt(double stretch = 1, const RunContext& context = {}) const;

  /// The radius of the sphere that touches the ellipsoid in the middle: half way, by directions, between its
  /// two radii of curvature. Metres.
  double radius() const;

 private:
  struct State;
  explicit CurvedGround(std::shared_ptr<const State> state);
  std::shared_ptr<const State> state_;
};

}  // namespace arete
