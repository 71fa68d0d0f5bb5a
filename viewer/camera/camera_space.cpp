// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the source to metric space goes an affine map: the inverse of the geotransform (none for points), then
// the metric's scale. It is kept as its origin and the images of the source's two axes. Those, as unit
// vectors, are east and north, as in viewOf(); where the grid is sheared they are not at right angles in
// metric space, so an azimuth is taken apart by solving for its two parts.
#include "viewer/camera/camera_space.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace arete {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

}  // namespace

/// An angle just below 0 can round to 360 when 360 is added. It becomes 0, so that the result is below 360.
double wrappedAzimuth(double degrees) {
  const double wrapped = std::fmod(degrees, 360);
  if (wrapped >= 0) return wrapped;
  return wrapped + 360 < 360 ? wrapped + 360 : 0;
}

// The columns of the affine map are inverted here once. Points have coordinates of the source as they are.
CameraSpace::CameraSpace(const TerrainModel& model) {
  const MetricFrame& metric = model.mt.metric();
  originXy_ = model.toSource({metric.origin.x, metric.origin.y});
  originHeight_ = metric.origin.z;
  metresPerHeight_ = metric.scale.z;
  if (model.isRaster) {
    const auto& g = model.georeference.geoTransform;
    const double det = model.georeference.determinant();
    perX_ = {g[5] / det * metric.scale.x, -g[4] / det * metric.scale.y};
    perY_ = {-g[2] / det * metric.scale.x, g[1] / det * metric.scale.y};
  } else {
    perX_ = {metric.scale.x, 0};
    perY_ = {0, metric.scale.y};
  }
  east_ = unit(perX_);
  north_ = unit(perY_);
  isMirrored_ = perX_.x * perY_.y - perX_.y * perY_.x < 0;
}

Vec3 CameraSpace::position(Vec2 xy, double height) const {
  const double x = xy.x - originXy_.x, y = xy.y - originXy_.y;
  return {perX_.x * x + perY_.x * y, perX_.y * x + perY_.y * y, (height - originHeight_) * metresPerHeight_};
}

Vec2 CameraSpace::xy(const Vec3& p) const {
  const double det = perX_.x * perY_.y - perX_.y * perY_.x;
  return {originXy_.x + (p.x * perY_.y - p.y * perY_.x) / det,
          originXy_.y + (p.y * perX_.x - p.x * perX_.y) / det};
}

Camera CameraSpace::at(Camera camera, const Vec3& position) const {
  camera.xy = xy(position);
  camera.height = height(position);
  return camera;
}

// East and north need not be at right angles here, so the azimuth is composed of both and made a unit.
Vec3 CameraSpace::level(double azimuthDegrees) const {
  const double sine = std::sin(azimuthDegrees * kRadians), cosine = std::cos(azimuthDegrees * kRadians);
  const Vec2 a = unit(sine * east_ + cosine * north_);
  return {a.x, a.y, 0};
}

Vec3 CameraSpace::forward(Look look) const {
  const double rise = std::sin(look.pitchDegrees * kRadians), run = std::cos(look.pitchDegrees * kRadians);
  const Vec3 a = level(look.azimuthDegrees);
  return {run * a.x, run * a.y, rise};
}

Vec3 CameraSpace::up(Look look) const {
  const double rise = std::sin(look.pitchDegrees * kRadians), run = std::cos(look.pitchDegrees * kRadians);
  const Vec3 a = level(look.azimuthDegrees);
  return {-rise * a.x, -rise * a.y, run};
}

// In a mirrored grid the right-hand side of a direction is the other one.
Vec3 CameraSpace::right(double azimuthDegrees) const {
  const Vec3 a = level(azimuthDegrees);
  return isMirrored_ ? Vec3{-a.y, a.x, 0} : Vec3{a.y, -a.x, 0};
}

// Straight up or down a direction has no azimuth, and the one given is kept.
Look CameraSpace::lookAlong(const Vec3& d, double azimuthThere) const {
  const double run = std::hypot(d.x, d.y);
  Look look{wrappedAzimuth(azimuthThere), std::atan2(d.z, run) / kRadians};
  if (run <= 1e-12 * std::abs(d.z)) return look;
  const double det = east_.x * north_.y - east_.y * north_.x;
  const double toEast = (d.x * north_.y - d.y * north_.x) / det;
  const double toNorth = (d.y * east_.x - d.x * east_.y) / det;
  look.azimuthDegrees = wrappedAzimuth(std::atan2(toEast, toNorth) / kRadians);
  return look;
}

Result<View> viewOf(const Camera& camera, const CameraSpace& space) {
  View view;
  view.eye = space.position(camera);
  view.forward = space.forward(lookOf(camera));
  view.up = space.up(lookOf(camera));
  view.verticalFieldOfView = camera.verticalFieldOfViewDegrees * kRadians;
  view.widthPixels = camera.widthPixels;
  view.heightPixels = camera.heightPixels;
  view.parallelHeight = camera.parallelHeight;
  if (view.isParallel()) view.nearDistance = -std::numeric_limits<double>::infinity();
  if (const Status valid = view.validate(); !valid)
    return failure(valid.error().code, valid.error().message, "camera");
  return view;
}

}  // namespace arete
