// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a camera sees of a mesh, computed in the map's own coordinates and in double precision, triangle by
// triangle and pixel by pixel: no OpenGL, no metric space, no view of the engine's.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "terrain/model/camera.h"

namespace arete::test {

/// A camera over a map with metres along all three axes.
class MapCamera {
 public:
  explicit MapCamera(const Camera& c)
      : eye_{c.xy.x, c.xy.y, c.height}, width_(c.widthPixels), height_(c.heightPixels) {
    const double a = c.azimuthDegrees * std::numbers::pi / 180, p = c.pitchDegrees * std::numbers::pi / 180;
    forward_ = {std::sin(a) * std::cos(p), std::cos(a) * std::cos(p), std::sin(p)};
    right_ = {std::cos(a), -std::sin(a), 0};
    up_ = {-std::sin(a) * std::sin(p), -std::cos(a) * std::sin(p), std::cos(p)};
    focal_ = c.heightPixels / 2 / std::tan(c.verticalFieldOfViewDegrees * std::numbers::pi / 360);
  }
  /// Pixels to the right and down from the upper left corner, depth.
  Vec3 project(const Vec3& p) const { return onScreen(toEye(p)); }
  Vec3 toEye(const Vec3& p) const {
    const Vec3 d{p.x - eye_.x, p.y - eye_.y, p.z - eye_.z};
    return {dot(d, right_), dot(d, up_), dot(d, forward_)};
  }
  Vec3 onScreen(const Vec3& e) const {
    return {width_ / 2 + focal_ * e.x / e.z, height_ / 2 - focal_ * e.y / e.z, e.z};
  }
  bool sees(const Vec3& p) const {
    const Vec3 s = project(p);
    return s.z > 0 && s.x >= 0 && s.x <= width_ && s.y >= 0 && s.y <= height_;
  }
  /// What is at so much depth in the middle of a pixel.
  Vec3 placeAt(double x, double y, double depth) const {
    const double right = (x + 0.5 - width_ / 2) / focal_ * depth,
                 up = (height_ / 2 - y - 0.5) / focal_ * depth;
    return {eye_.x + depth * forward_.x + right * right_.x + up * up_.x,
            eye_.y + depth * forward_.y + right * right_.y + up * up_.y,
            eye_.z + depth * forward_.z + right * right_.z + up * up_.z};
  }
  double heightAt(int x, int y, double depth) const { return placeAt(x, y, depth).z; }

 private:
  static double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  Vec3 eye_, forward_, right_, up_;
  double width_, height_, focal_ = 1;
};

/// Depths along the camera's axis by pixel, infinite where it sees nothing.
struct ReferencePicture {
  int width = 0, height = 0;
  std::vector<double> depth;
  double at(int x, int y) const { return depth[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  bool isCovered(int x, int y) const { return std::isfinite(at(x, y)); }
};

namespace detail {

/// A triangle before the eye, its corners in eye coordinates.
inline void drawTriangle(const std::array<Vec3, 3>& e, const MapCamera& camera, ReferencePicture& picture) {
  std::array<Vec3, 3> s;
  for (std::size_t i = 0; i < 3; ++i) s[i] = camera.onScreen(e[i]);
  const double area = (s[1].x - s[0].x) * (s[2].y - s[0].y) - (s[1].y - s[0].y) * (s[2].x - s[0].x);
  if (area == 0) return;
  const auto [left, right] = std::minmax({s[0].x, s[1].x, s[2].x});
  const auto [top, bottom] = std::minmax({s[0].y, s[1].y, s[2].y});
  const int x0 = int(std::max(0.0, std::floor(left - 0.5))),
            x1 = int(std::min(picture.width - 1.0, std::ceil(right)));
  const int y0 = int(std::max(0.0, std::floor(top - 0.5))),
            y1 = int(std::min(picture.height - 1.0, std::ceil(bottom)));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      std::array<double, 3> part;
      bool isIn = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = s[(i + 1) % 3], &b = s[(i + 2) % 3];
        part[i] = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
        isIn = isIn && part[i] >= 0;
      }
      if (!isIn) continue;
      // 1 / depth is linear on the screen.
      const double depth = 1 / (part[0] / s[0].z + part[1] / s[1].z + part[2] / s[2].z);
      double& nearest = picture.depth[std::size_t(y) * std::size_t(picture.width) + std::size_t(x)];
      nearest = std::min(nearest, depth);
    }
}

}  // namespace detail

inline ReferencePicture drawReference(std::span<const Vec3> vertices,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      const Camera& stated, double nearDepth) {
  const MapCamera camera(stated);
  ReferencePicture picture{int(stated.widthPixels), int(stated.heightPixels), {}};
  picture.depth.assign(std::size_t(picture.width) * std::size_t(picture.height),
                       std::numeric_limits<double>::infinity());
  for (const auto& t : triangles) {
    std::array<Vec3, 3> e;
    for (std::size_t i = 0; i < 3; ++i) e[i] = camera.toEye(vertices[t[i]]);
    // What is nearer than the near plane is cut off: a corner or two.
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = e[i], &b = e[(i + 1) % 3];
      if (a.z >= nearDepth) kept.push_back(a);
      if ((a.z >= nearDepth) != (b.z >= nearDepth)) {
        const double part = (nearDepth - a.z) / (b.z - a.z);
        kept.push_back({a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), nearDepth});
      }
    }
    for (std::size_t i = 2; i < kept.size(); ++i)
      detail::drawTriangle({kept[0], kept[i - 1], kept[i]}, camera, picture);
  }
  return picture;
}

}  // namespace arete::test
