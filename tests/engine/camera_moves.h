// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "datasets/terrain_generator.h"
#include "engine/criteria/view.h"
#include "terrain/builder/build.h"

namespace arete {

/// Terrain large enough that a camera in the middle sees a part of it.
inline const MultiTriangulation& mountains() {
  static const TerrainModel model = [] {
    const auto field = generateTerrain({.columns = 257, .rows = 257, .seed = 5});
    auto made = build(*field, {});
    if (!made) ADD_FAILURE() << made.error().describe();
    return std::move(*made);
  }();
  return model.mt;
}

inline Vec3 turned(const Vec3& p, const Vec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double along = (axis.x * p.x + axis.y * p.y + axis.z * p.z) * (1 - c);
  return {p.x * c + (axis.y * p.z - axis.z * p.y) * s + axis.x * along,
          p.y * c + (axis.z * p.x - axis.x * p.z) * s + axis.y * along,
          p.z * c + (axis.x * p.y - axis.y * p.x) * s + axis.z * along};
}

/// A random unit vector.
inline Vec3 direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  for (;;) {
    const Vec3 v{normal(random), normal(random), normal(random)};
    const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    if (length > 0.1) return {v.x / length, v.y / length, v.z / length};
  }
}

inline void turn(View& view, const Vec3& axis, double angle) {
  view.forward = turned(view.forward, axis, angle);
  view.up = turned(view.up, axis, angle);
}

inline void advance(View& view, double step) {
  const Vec3& f = view.forward;
  const double length = std::sqrt(f.x * f.x + f.y * f.y + f.z * f.z);
  view.eye = {view.eye.x + step * f.x / length, view.eye.y + step * f.y / length, view.eye.z};
}

}  // namespace arete
