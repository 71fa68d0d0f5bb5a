// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "engine/criteria/view_error.h"
#include "engine/grid_points_of.h"
#include "terrain/model/terrain_model.h"

/// Geomorphing written a second time, plainly: recursion by the definition, a camera of the tests' own.
namespace arete {

/// Screen coordinates in pixels from the middle of the picture.
class PlainCamera {
 public:
  explicit PlainCamera(const View& v) : v_(v) {
    const double length = std::hypot(v.forward.x, v.forward.y, v.forward.z);
    f_ = {v.forward.x / length, v.forward.y / length, v.forward.z / length};
    const double flat = std::hypot(f_.x, f_.y);  // up is z
    r_ = {f_.y / flat, -f_.x / flat, 0};
    u_ = {-f_.x * f_.z / flat, -f_.y * f_.z / flat, flat};
    focal_ = v.heightPixels / 2 / std::tan(v.verticalFieldOfView / 2);
  }
  double depth(const Vec3& p) const { return along(p, f_); }
  Vec2 project(const Vec3& p) const {
    const double z = depth(p);
    return {focal_ * along(p, r_) / z, focal_ * along(p, u_) / z};
  }
  bool sees(const Vec3& p) const {
    const double z = depth(p);
    if (!(z > 0 && z >= v_.nearDistance && z <= v_.farDistance)) return false;
    const Vec2 s = project(p);
    return std::abs(s.x) <= v_.widthPixels / 2 && std::abs(s.y) <= v_.heightPixels / 2;
  }
  /// Pixels between two places before the camera; infinite where one is not.
  double between(const Vec3& p, const Vec3& q) const {
    if (depth(p) <= 0 || depth(q) <= 0) return std::numeric_limits<double>::infinity();
    const Vec2 a = project(p), b = project(q);
    return std::hypot(a.x - b.x, a.y - b.y);
  }

 private:
  double along(const Vec3& p, const Vec3& axis) const {
    return (p.x - v_.eye.x) * axis.x + (p.y - v_.eye.y) * axis.y + (p.z - v_.eye.z) * axis.z;
  }
  View v_;
  Vec3 f_, r_, u_;
  double focal_;
};

/// Offsets of the vertices of any nodes, by the definition.
class PlainOffsets {
 public:
  PlainOffsets(const MultiTriangulation& mt, const View& view, double cutPixels, double offsetPixels)
      : mt_(mt),
        onePixel_({.view = view, .pixels = 1}, mt.arrays().metric),
        cut_(cutPixels),
        offset_(offsetPixels) {}

  struct Moved {
    double offset = 0, onFloor = 0;  ///< its own; the one with which it would be on the moving floor
    double rho = 0, most = 0;
  };
  const Moved& of(std::uint32_t v) {
    if (const auto at = known_.find(v); at != known_.end()) return at->second;
    Moved m;
    if (v >= mt_.rootVertexCount()) {
      const NodeId n(v - mt_.rootVertexCount());
      const double perHeight = 1 / onePixel_.allowedError(mt_.arrays().sphere[n.index()]);
      m.rho = perHeight == 0 ? 0 : mt_.saturatedError(n) * perHeight;
      m.most = offset_ / perHeight;
      const double share = std::clamp(2 - m.rho / cut_, 0.0, 1.0);
      const Vec3 p = mt_.position(VertexId(v));
      const auto [corners, weights] = floorPlace(n, p);
      double base = 0, floor = 0;
      for (int i = 0; i < 3; ++i) {
        base += weights[i] * of(corners[i]).offset;
        floor += weights[i] * mt_.position(VertexId(corners[i])).z;
      }
      m.onFloor = base + floor - p.z;
      if (offset_ > 0) m.offset = std::clamp(base - share * (p.z - floor), -m.most, m.most);
    }
    return known_[v] = m;
  }

 private:
  std::pair<std::array<std::uint32_t, 3>, std::array<double, 3>> floorPlace(NodeId n, const Vec3& p) const {
    std::pair<std::array<std::uint32_t, 3>, std::array<double, 3>> best;
    double bestLeast = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t t : mt_.floor(n)) {
      const auto c = mt_.corners(TriangleId(t));
      std::array<Vec3, 3> q;
      for (int i = 0; i < 3; ++i) q[i] = mt_.position(VertexId(c[i]));
      const double det = (q[1].y - q[2].y) * (q[0].x - q[2].x) + (q[2].x - q[1].x) * (q[0].y - q[2].y);
      const double a = ((q[1].y - q[2].y) * (p.x - q[2].x) + (q[2].x - q[1].x) * (p.y - q[2].y)) / det,
                   b = ((q[2].y - q[0].y) * (p.x - q[2].x) + (q[0].x - q[2].x) * (p.y - q[2].y)) / det;
      const double least = std::min({a, b, 1 - a - b});
      if (least > bestLeast) bestLeast = least, best = {c, {a, b, 1 - a - b}};
    }
    return best;
  }

  const MultiTriangulation& mt_;
  const ViewError onePixel_;
  double cut_, offset_;
  std::map<std::uint32_t, Moved> known_;
};

/// Heights of a front over every sample of a raster, NaN where it has none. height(v): of an MT vertex.
inline std::vector<double> heightsOver(const TerrainModel& model, std::span<const std::uint32_t> front,
                                       const std::function<double(std::uint32_t)>& height) {
  std::vector<double> over(std::size_t(model.columns) * model.rows, std::numeric_limits<double>::quiet_NaN());
  for (const std::uint32_t t : front) {
    const auto corners = model.mt.corners(TriangleId(t));
    std::array<Vec3, 3> p;
    for (int i = 0; i < 3; ++i) {
      p[i] = model.mt.position(VertexId(corners[i]));
      p[i].z = height(corners[i]);
    }
    test::forGridPointsOf(p, [&](int x, int y, double z) { over[std::size_t(y) * model.columns + x] = z; });
  }
  return over;
}

/// The worst of what a surface of so many heights over the samples is off in a camera's picture, in pixels,
/// over the samples in sight.
inline double worstPixels(const TerrainModel& model, const PlainCamera& camera,
                          std::span<const double> heights, std::span<const double> surface,
                          std::size_t* seen = nullptr) {
  const MetricFrame& metric = model.mt.arrays().metric;
  double worst = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (std::isnan(heights[i]) || std::isnan(surface[i])) continue;
    const double x = double(i % model.columns), y = double(i / model.columns);
    const Vec3 real = metric.toMetric({x, y, heights[i]});
    if (!camera.sees(real)) continue;
    if (seen) ++*seen;
    worst = std::max(worst, camera.between(real, metric.toMetric({x, y, surface[i]})));
  }
  return worst;
}

}  // namespace arete
