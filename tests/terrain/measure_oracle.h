// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples against every triangle of a mesh, in long double and with other formulas than the measurement;
// random TINs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

#include "engine/base/triangle_mesh.h"

namespace arete::measuring_test {

struct OracleHit {
  bool covers = false, strict = false;
  long double z = 0, turn = 0;
};

inline OracleHit meet(const std::array<Vec3, 3>& corners, long double x, long double y) {
  using Real = long double;
  constexpr Real kTolerance = 1e-6L;
  const auto cross = [](Real ax, Real ay, Real bx, Real by) { return ax * by - ay * bx; };
  const auto& [a, b, c] = corners;
  const Real area = cross(Real(b.x) - a.x, Real(b.y) - a.y, Real(c.x) - a.x, Real(c.y) - a.y);
  OracleHit hit;
  const Real longest =
      std::max({std::hypot(Real(b.x) - a.x, Real(b.y) - a.y), std::hypot(Real(c.x) - b.x, Real(c.y) - b.y),
                std::hypot(Real(a.x) - c.x, Real(a.y) - c.y)});
  if (std::abs(area) <= kTolerance * longest) return hit;
  const Real u = cross(x - a.x, y - a.y, Real(c.x) - a.x, Real(c.y) - a.y) / area;
  const Real v = cross(Real(b.x) - a.x, Real(b.y) - a.y, x - a.x, y - a.y) / area;
  hit.z = a.z + u * (Real(b.z) - a.z) + v * (Real(c.z) - a.z);
  Real toRim = std::numeric_limits<Real>::infinity();
  int cornerAt = -1, sides = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &p = corners[i], &q = corners[(i + 1) % 3];
    const Real dx = Real(q.x) - p.x, dy = Real(q.y) - p.y;
    const Real t = std::clamp(((x - p.x) * dx + (y - p.y) * dy) / (dx * dx + dy * dy), Real(0), Real(1));
    sides += std::abs(cross(dx, dy, x - p.x, y - p.y)) <= kTolerance * std::hypot(dx, dy);
    toRim = std::min(toRim, std::hypot(p.x + t * dx - x, p.y + t * dy - y));
    if (std::hypot(p.x - x, p.y - y) <= kTolerance) cornerAt = i;
  }
  const bool inside = u >= 0 && v >= 0 && u + v <= 1;
  hit.covers = inside || toRim <= kTolerance;
  hit.strict = inside && toRim > kTolerance;
  if (hit.strict) {
    hit.turn = 2 * std::numbers::pi_v<Real>;
  } else if (cornerAt >= 0) {
    const Vec3 &p = corners[cornerAt], &q = corners[(cornerAt + 1) % 3], &r = corners[(cornerAt + 2) % 3];
    const Real qx = Real(q.x) - p.x, qy = Real(q.y) - p.y, rx = Real(r.x) - p.x, ry = Real(r.y) - p.y;
    hit.turn = std::abs(std::atan2(cross(qx, qy, rx, ry), qx * rx + qy * ry));
  } else if (hit.covers && sides == 1) {
    hit.turn = std::numbers::pi_v<Real>;
  }
  return hit;
}

struct OracleSample {
  bool covered = false, interior = false, overlapped = false;
  int strict = 0;
  long double error = 0;  ///< the largest
};

/// Triangles and sample in one frame, in pixels.
inline OracleSample sampleByForce(const TriangleMesh& mesh, double x, double y, double height) {
  OracleSample sample;
  long double turn = 0;
  for (const auto& t : mesh.triangles) {
    const OracleHit hit = meet({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}, x, y);
    sample.covered |= hit.covers;
    sample.strict += hit.strict;
    turn += hit.turn;
    if (hit.covers) sample.error = std::max(sample.error, std::abs(hit.z - height));
  }
  constexpr long double kTurn = 2 * std::numbers::pi_v<long double>;
  sample.interior = turn > kTurn - 1e-2L;
  sample.overlapped = turn > kTurn + 1e-2L;
  return sample;
}

/// A conforming TIN with random vertices: triangles split at random inner points.
inline TriangleMesh randomTin(std::mt19937& random, double width, double height, int splits, bool onSamples) {
  TriangleMesh mesh;
  std::uniform_real_distribution<double> unit(0.05, 0.95), z(0, 500);
  mesh.positions = {
      {0, 0, z(random)}, {width, 0, z(random)}, {width, height, z(random)}, {0, height, z(random)}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (int s = 0; s < splits; ++s) {
    const std::size_t pick = random() % mesh.triangles.size();
    const auto t = mesh.triangles[pick];
    double u = unit(random), v = unit(random) * (1 - u);
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    Vec3 p{a.x + u * (b.x - a.x) + v * (c.x - a.x), a.y + u * (b.y - a.y) + v * (c.y - a.y), z(random)};
    if (onSamples) {
      p.x = std::round(p.x);
      p.y = std::round(p.y);
      const auto side = [&p](const Vec3& f, const Vec3& g) {
        return (g.x - f.x) * (p.y - f.y) - (g.y - f.y) * (p.x - f.x);
      };
      if (side(a, b) <= 0 || side(b, c) <= 0 || side(c, a) <= 0) continue;
    }
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(p);
    mesh.triangles[pick] = {t[0], t[1], n};
    mesh.triangles.push_back({t[1], t[2], n});
    mesh.triangles.push_back({t[2], t[0], n});
  }
  return mesh;
}

}  // namespace arete::measuring_test
