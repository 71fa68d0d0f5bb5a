// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ray is cut to the box of the terrain. The rest is a straight line in the plan, along which a profile
// at full resolution has every edge that it crosses; height above the terrain is linear between two of them,
// so its first change of sign is the intersection.
#include "viewer/window/picking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace arete {
namespace {

struct Stretch {
  double from = 0, to = INFINITY;
};

/// The part of the ray in the box, in lengths of its direction.
std::optional<Stretch> within(const MetricBox& box, const Vec3& eye, const Vec3& d) {
  Stretch part;
  const std::array<double, 3> e{eye.x, eye.y, eye.z}, along{d.x, d.y, d.z};
  const std::array<double, 3> low{box.low.x, box.low.y, box.low.z}, high{box.high.x, box.high.y, box.high.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (along[i] == 0) {
      if (e[i] < low[i] || e[i] > high[i]) return std::nullopt;
      continue;
    }
    const double a = (low[i] - e[i]) / along[i], b = (high[i] - e[i]) / along[i];
    part.from = std::max(part.from, std::min(a, b));
    part.to = std::min(part.to, std::max(a, b));
  }
  if (!(part.from <= part.to) || !std::isfinite(part.to)) return std::nullopt;
  return part;
}

Vec3 along(const Vec3& from, const Vec3& direction, double length) {
  return {from.x + length * direction.x, from.y + length * direction.y, from.z + length * direction.z};
}

struct Lens {
  double slopeX, slopeY;
};

Lens lensOf(const Camera& camera) {
  const double slope = std::tan(camera.verticalFieldOfViewDegrees * std::numbers::pi / 360);
  return {slope * camera.widthPixels / camera.heightPixels, slope};
}

}  // namespace

TerrainPicker::TerrainPicker(const TerrainModel& model, const Profiles& profiles)
    : model_(model),
      profiles_(profiles),
      space_(model),
      box_(metricBox(model)),
      plane_(makePlaneEarth(model)) {
  // What lies on the box's own sides is in it after rounding, too.
  const double margin = 1e-9 * box_.diagonal();
  box_.low = {box_.low.x - margin, box_.low.y - margin, box_.low.z - margin};
  box_.high = {box_.high.x + margin, box_.high.y + margin, box_.high.z + margin};
}

// The ray says where; the height there is the terrain's own. On the rim of NODATA rounding may have carried
// the place off the terrain: then it is taken a little further along the triangle that was hit.
std::optional<TerrainPick> TerrainPicker::pickOf(const Vec3& hit, const Vec3& inside, const Vec3& eye) const {
  for (const double step : {0.0, 1e-9, 1e-6, 1e-3}) {
    const Vec2 xy = space_.xy(arete::along(hit, inside - hit, step));
    const auto ground = profiles_.heights().at(xy);
    if (!ground) continue;
    const Vec3 metric = space_.position(xy, ground->height);
    return TerrainPick{model_.toPlan(xy), xy, ground->height, metric,
                       std::hypot(metric.x - eye.x, metric.y - eye.y, metric.z - eye.z)};
  }
  return std::nullopt;
}

std::optional<TerrainPick> TerrainPicker::along(const Vec3& eye, const Vec3& direction) const {
  const auto part = within(box_, eye, direction);
  if (!part) return std::nullopt;
  return between(arete::along(eye, direction, part->from), arete::along(eye, direction, part->to), eye);
}

std::optional<TerrainPick> TerrainPicker::between(const Vec3& first, const Vec3& last,
                                                  const Vec3& eye) const {
  const Vec2 from = model_.toPlan(space_.xy(first)), to = model_.toPlan(space_.xy(last));
  const Vec2 way{to.x - from.x, to.y - from.y};
  const double length2 = way.x * way.x + way.y * way.y;
  if (length2 < 1e-12) {  // straight down, or up
    const auto ground = profiles_.heights().at(space_.xy(first));
    if (!ground) return std::nullopt;
    const Vec3 hit = space_.position(space_.xy(first), ground->height);
    const bool isBetween = (hit.z - first.z) * (hit.z - last.z) <= 0;
    return isBetween ? pickOf(hit, hit, eye) : std::nullopt;
  }
  const auto track = plane_->track(from, to);
  if (!track) return std::nullopt;
  const Profile profile = profiles_.along(*track);
  double before = 0, clearanceBefore = 0;
  for (std::size_t i = 0; i < profile.vertices.size(); ++i) {
    const ProfileVertex& v = profile.vertices[i];
    const double t = ((v.plan.x - from.x) * way.x + (v.plan.y - from.y) * way.y) / length2;
    const double ground = space_.position(model_.toSource(v.plan), v.height).z;
    const double clearance = first.z + t * (last.z - first.z) - ground;
    const bool isJoined = i > 0 && v.isJoined;
    if (clearance == 0 || (isJoined && (clearance > 0) != (clearanceBefore > 0))) {
      const double at = isJoined && clearance != clearanceBefore
                            ? before + (t - before) * (clearanceBefore / (clearanceBefore - clearance))
                            : t;
      const Vec3 ray = last - first;
      const double middle = isJoined ? (before + t) / 2 : at;
      const auto pick = pickOf(arete::along(first, ray, at), arete::along(first, ray, middle), eye);
      if (pick) return pick;
    }
    before = t;
    clearanceBefore = clearance;
  }
  return std::nullopt;
}

std::optional<TerrainPick> TerrainPicker::at(const Camera& camera, Vec2 pixel, double stretch) const {
  Vec3 direction = directionOfPixel(space_, camera, pixel);
  direction.z /= stretch;
  return along(space_.position(camera), direction);
}

std::optional<TerrainPick> TerrainPicker::at(const CurvedGround& ground, const Camera& camera, Vec2 pixel,
                                             double stretch) const {
  const Result<View> view = ground.viewOf(camera, stretch);
  if (!view) return std::nullopt;
  const Frustum::Planes p = Frustum(*view).planes();
  const double x = (2 * pixel.x / camera.widthPixels - 1) * p.slopeX * (model_.isFlipped() ? -1 : 1);
  const double y = (1 - 2 * pixel.y / camera.heightPixels) * p.slopeY;
  Vec3 direction = arete::along(arete::along(p.forward, p.right, x), p.up, y);
  const double length = std::hypot(direction.x, direction.y, direction.z);
  direction = {direction.x / length, direction.y / length, direction.z / length};

  const Vec3 eye = space_.position(camera), middle = box_.centre();
  const double farthest = std::hypot(eye.x - middle.x, eye.y - middle.y, stretch * (eye.z - middle.z)) +
                          box_.diagonal() * std::max(1.0, stretch);
  const auto flat = [&](double metres) {
    const Vec3 source = ground.source(arete::along(view->eye, direction, metres), stretch);
    return space_.position({source.x, source.y}, source.z);
  };
  // A chord c of a circle of radius R is off by c^2 / 8 R: 5 mm, and where meridians run together more.
  constexpr double kChordMetres = 500;
  Vec3 before = eye;
  for (int chords = 0; chords * kChordMetres < farthest; ++chords) {
    const Vec3 now = flat((chords + 1) * kChordMetres);
    const Vec3 chord{now.x - before.x, now.y - before.y, now.z - before.z};
    const auto part = within(box_, before, chord);
    const bool isNear = part && part->from <= 1;
    auto hit = isNear ? between(arete::along(before, chord, part->from),
                                arete::along(before, chord, std::min(part->to, 1.0)), eye)
                      : std::nullopt;
    if (hit) {
      const Vec3 place = ground.position(hit->xy, hit->height),
                 from = ground.position(camera.xy, camera.height);
      hit->metres = std::hypot(place.x - from.x, place.y - from.y, place.z - from.z);
      return hit;
    }
    before = now;
  }
  return std::nullopt;
}

std::optional<Vec2> TerrainPicker::pixelOf(const CurvedGround& ground, const Camera& camera,
                                           const Vec3& metric, double stretch) const {
  const Result<View> view = ground.viewOf(camera, stretch);
  if (!view) return std::nullopt;
  const Frustum frustum(*view);
  const Vec3 p = frustum.toView(ground.position(space_.xy(metric), space_.height(metric), stretch));
  if (!(p.z > 0)) return std::nullopt;
  const Frustum::Planes planes = frustum.planes();
  const double side = model_.isFlipped() ? -1 : 1;
  return Vec2{(1 + side * p.x / (p.z * planes.slopeX)) / 2 * camera.widthPixels,
              (1 - p.y / (p.z * planes.slopeY)) / 2 * camera.heightPixels};
}

Vec3 directionOfPixel(const CameraSpace& space, const Camera& camera, Vec2 pixel) {
  const Lens lens = lensOf(camera);
  const double x = (2 * pixel.x / camera.widthPixels - 1) * lens.slopeX;
  const double y = (1 - 2 * pixel.y / camera.heightPixels) * lens.slopeY;
  const Vec3 direction = along(space.forward(lookOf(camera)), space.right(camera.azimuthDegrees), x);
  return along(direction, space.up(lookOf(camera)), y);
}

std::optional<Vec2> pixelOf(const CameraSpace& space, const Camera& camera, const Vec3& metric,
                            double stretch) {
  const Lens lens = lensOf(camera);
  const Vec3 eye = space.position(camera);
  const Vec3 d{metric.x - eye.x, metric.y - eye.y, (metric.z - eye.z) * stretch};
  const auto dot = [&](const Vec3& a) { return a.x * d.x + a.y * d.y + a.z * d.z; };
  const double depth = dot(space.forward(lookOf(camera)));
  if (!(depth > 0)) return std::nullopt;
  const double x = dot(space.right(camera.azimuthDegrees)) / (depth * lens.slopeX);
  const double y = dot(space.up(lookOf(camera))) / (depth * lens.slopeY);
  return Vec2{(1 + x) / 2 * camera.widthPixels, (1 - y) / 2 * camera.heightPixels};
}

}  // namespace arete
