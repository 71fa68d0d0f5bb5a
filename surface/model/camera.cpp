// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/camera.h"

#include <limits>
#include <numbers>

namespace arete {

Result<View> viewOf(const SurfaceCamera& camera, const SurfaceModel& model) {
  const MetricFrame& metric = model.mt.metric();
  View view;
  view.eye = metric.toMetric(camera.eye);
  view.forward = metric.toMetric(camera.target) - view.eye;
  const double length = norm(view.forward);
  if (!(length > 0)) return failure(ErrorCode::usage, "the eye is at what it looks at", "camera");
  const Vec3 up = model.up == "y" ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const bool isAlong = norm(cross(view.forward / length, up)) < 1e-6;
  view.up = isAlong ? Vec3{1, 0, 0} : up;
  view.verticalFieldOfView = camera.verticalFieldOfViewDegrees / 180 * std::numbers::pi;
  view.widthPixels = camera.widthPixels;
  view.heightPixels = camera.heightPixels;
  view.parallelHeight = camera.parallelHeight;
  if (view.isParallel()) view.nearDistance = -std::numeric_limits<double>::infinity();
  if (const Status valid = view.validate(); !valid)
    return failure(valid.error().code, valid.error().message, "camera");
  return view;
}

}  // namespace arete
