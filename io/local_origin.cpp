// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/local_origin.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace arete {

namespace {

/// The coordinate of a vertex that is nearest to the middle of all.
double nearestToMiddle(const TriangleMesh& mesh, double Vec3::*axis) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : mesh.positions) {
    low = std::min(low, p.*axis);
    high = std::max(high, p.*axis);
  }
  const double middle = low / 2 + high / 2;
  double nearest = low;
  for (const Vec3& p : mesh.positions)
    if (std::abs(p.*axis - middle) < std::abs(nearest - middle)) nearest = p.*axis;
  return nearest;
}

}  // namespace

Vec3 localOrigin(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return {};
  return {nearestToMiddle(mesh, &Vec3::x), nearestToMiddle(mesh, &Vec3::y), 0};
}

double float32Rounding(double largestAbsolute, double origin) {
  constexpr double kHalfUlp32 = 0x1p-24, kUlp64 = 0x1p-52;
  return largestAbsolute * kHalfUlp32 + (largestAbsolute + std::abs(origin)) * kUlp64 +
         (largestAbsolute == 0 ? 0 : 0x1p-150);
}

}  // namespace arete
