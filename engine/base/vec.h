// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace arete {

/// A point or a vector of the plan.
struct Vec2 {
  double x = 0, y = 0;
  constexpr bool operator==(const Vec2&) const = default;
};

/// A point or a vector of space.
struct Vec3 {
  double x = 0, y = 0, z = 0;
  constexpr bool operator==(const Vec3&) const = default;
};

/// An axis-aligned box of the plan, both ends included.
struct Box2 {
  double xMin = 0, yMin = 0, xMax = 0, yMax = 0;
};

// Each operation rounds once per component, in the order written; sums of products run from x to z.

constexpr Vec2 operator+(const Vec2& a, const Vec2& b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Vec2 operator-(const Vec2& a, const Vec2& b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Vec2 operator*(const Vec2& a, double s) {
  return {a.x * s, a.y * s};
}
constexpr Vec2 operator*(double s, const Vec2& a) {
  return {s * a.x, s * a.y};
}
constexpr double dot(const Vec2& a, const Vec2& b) {
  return a.x * b.x + a.y * b.y;
}
/// The z component of the cross product: twice the signed area of the triangle 0, a, b.
constexpr double cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}
/// The vector of length 1 in the direction of a. Precondition: a is not 0.
inline Vec2 unit(const Vec2& a) {
  const double length = std::hypot(a.x, a.y);
  return {a.x / length, a.y / length};
}

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(const Vec3& a) {
  return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(const Vec3& a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
constexpr Vec3 operator*(double s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr Vec3 operator/(const Vec3& a, double s) {
  return {a.x / s, a.y / s, a.z / s};
}
constexpr double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Euclidean length.
inline double norm(const Vec3& a) {
  return std::sqrt(dot(a, a));
}
/// The vector of length 1 in the direction of a. Precondition: a is not 0.
inline Vec3 unit(const Vec3& a) {
  return a / norm(a);
}
inline bool isFinite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace arete
