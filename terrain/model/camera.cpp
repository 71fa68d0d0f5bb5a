// SPDX-License-Identifier: GPL-3.0-or-later
//
// The transformation from the map to metric space, by the geotransform and the metric's scale, is affine, so
// the images of the map's two axes are the same everywhere. Normalised, they are the directions east and
// north. So azimuths are right also where the steps along the two axes have different lengths on the ground
// (degrees).
#include "terrain/model/camera.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/caught_failure.h"

namespace arete {

Vec3 metricPosition(Vec2 xy, double height, const TerrainModel& model) {
  const Vec2 plan = model.toPlan(xy);
  return model.mt.metric().toMetric({plan.x, plan.y, height});
}

Result<View> viewOf(const Camera& camera, const TerrainModel& model) try {
  if (!std::isfinite(camera.azimuthDegrees))
    return failure(ErrorCode::usage, "the azimuth must be a finite number of degrees", "camera");
  if (!(camera.pitchDegrees >= -90 && camera.pitchDegrees <= 90))
    return failure(ErrorCode::usage, "the pitch must lie between -90 and 90 degrees", "camera");
  constexpr double kRadians = std::numbers::pi / 180;

  // A step along each axis of the map, long enough to survive the rounding of large coordinates.
  const auto& g = model.georeference.geoTransform;
  const double step = model.isRaster ? std::hypot(g[1], g[4]) + std::hypot(g[2], g[5]) : 1;
  const Vec3 here = metricPosition(camera.xy, 0, model);
  const auto axis = [&](double dx, double dy) {
    const Vec3 there = metricPosition({camera.xy.x + dx, camera.xy.y + dy}, 0, model);
    return unit(Vec2{there.x - here.x, there.y - here.y});
  };
  const Vec2 east = axis(step, 0), north = axis(0, step);
  const double sine = std::sin(camera.azimuthDegrees * kRadians),
               cosine = std::cos(camera.azimuthDegrees * kRadians);
  const Vec2 level = unit(sine * east + cosine * north);
  const double rise = std::sin(camera.pitchDegrees * kRadians),
               run = std::cos(camera.pitchDegrees * kRadians);

  View view;
  view.eye = metricPosition(camera.xy, camera.height, model);
  view.forward = {run * level.x, run * level.y, rise};
  view.up = {-rise * level.x, -rise * level.y, run};
  view.verticalFieldOfView = camera.verticalFieldOfViewDegrees * kRadians;
  view.widthPixels = camera.widthPixels;
  view.heightPixels = camera.heightPixels;
  view.parallelHeight = camera.parallelHeight;
  if (view.isParallel()) view.nearDistance = -std::numeric_limits<double>::infinity();
  if (Status ok = view.validate(); !ok) return failure(ok.error().code, ok.error().message, "camera");
  return view;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
