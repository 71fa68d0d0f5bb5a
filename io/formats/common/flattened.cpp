// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two products of doubles are equal if and only if they round to the same double and leave the same rest,
// which a fused multiply-add gives exactly.
#include "io/formats/common/flattened.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/counted.h"

namespace arete {
namespace {

bool areEqualProducts(double a, double b, double c, double d) {
  const double p = a * b, q = c * d;
  return p == q && std::fma(a, b, -p) == std::fma(c, d, -q);
}

bool isFlat(const std::array<Vec3, 3>& c) {
  const Vec3 u = c[1] - c[0], v = c[2] - c[0];
  return areEqualProducts(u.x, v.y, u.y, v.x) && areEqualProducts(u.y, v.z, u.z, v.y) &&
         areEqualProducts(u.z, v.x, u.x, v.z);
}

}  // namespace

std::uint64_t countFlattened(const TriangleMesh& mesh,
                             const std::function<std::array<float, 3>(std::uint32_t)>& rounded) {
  std::uint64_t count = 0;
  for (const auto& t : mesh.triangles) {
    std::array<Vec3, 3> after;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<float, 3> p = rounded(t[k]);
      after[k] = {p[0], p[1], p[2]};
    }
    if (!isFlat(after)) continue;
    count += isFlat({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}) ? 0 : 1;
  }
  return count;
}

std::string flattenedLoss(std::uint64_t count) {
  if (count == 0) return {};
  return counted(count, "triangle, which has no area in 32-bit floats",
                 "triangles, which have no area in 32-bit floats");
}

}  // namespace arete
