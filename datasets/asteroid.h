// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/triangle_mesh.h"

namespace arete {

struct AsteroidOptions {
  std::uint32_t vertices = 150'000;  ///< about so many, at least 8
  std::uint64_t seed = 1;
};

/// A small body of rock with hills and craters: a closed surface of genus 0, about 2.5 units long, with z up.
/// Arithmetic and square roots only, so the same bits on every machine; coordinates are floats. O(vertices).
TriangleMesh generateAsteroid(const AsteroidOptions& options = {});

}  // namespace arete
