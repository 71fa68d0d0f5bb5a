// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/criteria/view.h"
#include "surface/model/surface_model.h"

namespace arete {

/// A camera in the coordinates and the unit of a surface.
struct SurfaceCamera {
  Vec3 eye, target;  ///< what it looks at, different from the eye
  double verticalFieldOfViewDegrees = 60;
  double widthPixels = 1920, heightPixels = 1080;
  double parallelHeight = 0;  ///< as in Camera, in metric units
};

/// Transforms a camera to the metric space of the model's multitriangulation, as ViewError takes it. The
/// picture is upright as the source states it, by z where it states nothing. Errors: usage, culprit "camera":
/// the eye is at the target, or a number is out of range.
Result<View> viewOf(const SurfaceCamera& camera, const SurfaceModel& model);

}  // namespace arete
