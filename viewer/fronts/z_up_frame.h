// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "engine/criteria/view.h"
#include "surface/model/surface_model.h"
#include "terrain/model/camera.h"
#include "viewer/camera/home_view.h"

namespace arete {

/// The space that a surface is drawn in: the metric space of its multitriangulation, turned so that what is
/// up in its file is along z. Cameras of CameraSpace() move in it: x is east, y is north, both in the file's
/// unit from the middle of the surface. A small value that does not refer to the model.
class ZUpFrame {
 public:
  /// @param up the axis of the file that points up, "y" or "z"; empty: as the model says, else z.
  explicit ZUpFrame(const SurfaceModel& model, std::string_view up = {});

  /// Of a position of the file, and back.
  Vec3 fromFile(const Vec3& position) const { return turned(metric_.toMetric(position)); }
  Vec3 toFile(const Vec3& upright) const;
  /// Of positions and directions in the metric space of the multitriangulation.
  Vec3 turned(const Vec3& metric) const { return isYUp_ ? Vec3{metric.x, -metric.z, metric.y} : metric; }
  Vec3 turnedBack(const Vec3& upright) const {
    return isYUp_ ? Vec3{upright.x, upright.z, -upright.y} : upright;
  }
  View turnedBack(View upright) const;

 private:
  MetricFrame metric_;
  bool isYUp_ = false;
};

/// Where a surface is in upright space. O(vertices).
HomeShape uprightShape(const SurfaceModel& model, const ZUpFrame& upright);

}  // namespace arete
