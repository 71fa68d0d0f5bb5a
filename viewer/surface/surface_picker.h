// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "surface/model/surface_model.h"
#include "viewer/fronts/z_up_frame.h"

namespace arete {

/// A place of a surface that a ray meets.
struct SurfacePick {
  Vec3 place;           ///< in upright space
  double length = 0;    ///< from the start of the ray
  TriangleId triangle;  ///< of the finest front
};

/// Finds where rays meet a surface first, at full resolution: a descent of the multitriangulation through the
/// nodes whose spheres the ray meets. Keeps a reference to the model; thread-safe.
class SurfacePicker {
 public:
  /// Precondition: the model outlives this. O(1).
  SurfacePicker(const SurfaceModel& model, const ZUpFrame& upright) : model_(model), upright_(upright) {}

  /// From a point in a direction of any length but 0, in upright space, on either side of the surface. O(root
  /// triangles + nodes along the ray).
  std::optional<SurfacePick> along(const Vec3& eye, const Vec3& direction) const;
  /// The name of the material of a triangle of the finest front; empty where it has none.
  std::string materialOf(TriangleId triangle) const;
  /// What its face belongs to and carries, as "object wall, group north, class 6"; empty: nothing.
  std::string partsOf(TriangleId triangle) const;
  /// The error of a triangle of the finest front of a part that the whole model refines; 0 of others.
  double missingErrorOf(TriangleId triangle) const {
    return model_.mt.isRemoverMissing(triangle) ? model_.mt.error(triangle) : 0;
  }

 private:
  const SurfaceModel& model_;
  ZUpFrame upright_;
};

}  // namespace arete
