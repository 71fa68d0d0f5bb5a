// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes in space, and the distance to them by an oracle: every triangle, in long double, by the normal
// equations instead of cross products.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "engine/base/triangle_mesh.h"

namespace arete::measuring_test {

/// A surface over [0, 1]^2 of n x n cells.
inline TriangleMesh sheet(std::uint32_t n, const std::function<Vec3(double u, double v)>& at) {
  TriangleMesh mesh;
  for (std::uint32_t r = 0; r <= n; ++r)
    for (std::uint32_t c = 0; c <= n; ++c) mesh.positions.push_back(at(double(c) / n, double(r) / n));
  for (std::uint32_t r = 0; r < n; ++r)
    for (std::uint32_t c = 0; c < n; ++c) {
      const std::uint32_t i = r * (n + 1) + c;
      mesh.triangles.push_back({i, i + 1, i + n + 2});
      mesh.triangles.push_back({i, i + n + 2, i + n + 1});
    }
  return mesh;
}

inline TriangleMesh plane(std::uint32_t n, double size, double z) {
  return sheet(n, [=](double u, double v) { return Vec3{size * u, size * v, z}; });
}

inline TriangleMesh sphere(std::uint32_t n, double radius) {
  return sheet(n, [=](double u, double v) {
    const double around = 2 * std::numbers::pi * u, down = std::numbers::pi * v;
    return Vec3{radius * std::sin(down) * std::cos(around), radius * std::sin(down) * std::sin(around),
                radius * std::cos(down)};
  });
}

inline TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.positions) p = {p.x + by.x, p.y + by.y, p.z + by.z};
  return mesh;
}

/// A vertex of n triangles, which stands off the ring of the others by a height, and below them a lid that is
/// a fan around one of the ring.
inline TriangleMesh fans(std::uint32_t n, double height) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    mesh.positions.push_back({std::cos(angle), std::sin(angle), 0});
  }
  mesh.positions.push_back({0, 0, height});
  for (std::uint32_t i = 0; i < n; ++i) mesh.triangles.push_back({n, i, (i + 1) % n});
  for (std::uint32_t i = 1; i + 1 < n; ++i) mesh.triangles.push_back({0, i + 1, i});
  return mesh;
}

/// Triangles anywhere, every fifth one a sliver, a segment or a point.
inline TriangleMesh soup(std::size_t triangles, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  TriangleMesh mesh;
  const auto point = [&] { return Vec3{anywhere(random), anywhere(random), anywhere(random)}; };
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const Vec3 a = point(), b = point();
    Vec3 c = point();
    const double along = anywhere(random) * 2, aside = t % 10 == 0 ? 1e-7 : 0;
    if (t % 5 == 0)
      c = {a.x + along * (b.x - a.x) + aside, a.y + along * (b.y - a.y), a.z + along * (b.z - a.z)};
    mesh.positions.insert(mesh.positions.end(), {a, t % 15 == 5 ? a : b, t % 15 == 5 ? a : c});
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

using Real = long double;
struct Real3 {
  Real x, y, z;
};
inline Real3 minus(const Vec3& a, const Vec3& b) {
  return {Real(a.x) - b.x, Real(a.y) - b.y, Real(a.z) - b.z};
}
inline Real dot(const Real3& a, const Real3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Least |p - a - u (b - a) - v (c - a)| over the triangle: inside where the free minimum lies there, and on
/// the three sides in any case.
inline Real distanceTo(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto residual = [&](const Real3& w, const Real3& e, const Real3& f, Real u, Real v) {
    const Real x = w.x - u * e.x - v * f.x, y = w.y - u * e.y - v * f.y, z = w.z - u * e.z - v * f.z;
    return std::sqrt(x * x + y * y + z * z);
  };
  Real least = std::numeric_limits<Real>::infinity();
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    const Real3 w = minus(p, from), e = minus(to, from);
    const Real length = dot(e, e), u = length > 0 ? std::clamp(dot(w, e) / length, Real(0), Real(1)) : 0;
    least = std::min(least, residual(w, e, e, u, 0));
  }
  const Real3 w = minus(p, a), e = minus(b, a), f = minus(c, a);
  const Real ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), det = ee * ff - ef * ef;
  if (det > 1e-16L * ee * ff) {
    const Real u = (dot(w, e) * ff - dot(w, f) * ef) / det, v = (dot(w, f) * ee - dot(w, e) * ef) / det;
    if (u >= 0 && v >= 0 && u + v <= 1) least = std::min(least, residual(w, e, f, u, v));
  }
  return least;
}

inline Real distanceTo(const Vec3& p, const TriangleMesh& mesh) {
  Real least = std::numeric_limits<Real>::infinity();
  for (const auto& t : mesh.triangles)
    least = std::min(least, distanceTo(p, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
  return least;
}

}  // namespace arete::measuring_test
