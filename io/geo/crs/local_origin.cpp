// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two passes per axis: the range of the coordinates, then the vertex that is nearest to its middle.
#include "io/geo/crs/local_origin.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace arete {

namespace {

/// The coordinate of the vertex that is nearest to the middle of all, on one axis.
double nearestToMiddle(std::span<const Vec3> positions, double Vec3::*axis) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : positions) {
    low = std::min(low, p.*axis);
    high = std::max(high, p.*axis);
  }
  const double middle = low / 2 + high / 2;
  double nearest = low;
  for (const Vec3& p : positions)
    if (std::abs(p.*axis - middle) < std::abs(nearest - middle)) nearest = p.*axis;
  return nearest;
}

/// With origin 0, float32 holds the heights of most DEMs, which are float32 or integers, exactly.
double heightOrigin(std::span<const Vec3> positions) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool areExact = true;
  for (const Vec3& p : positions) {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
    areExact = areExact && std::abs(p.z) <= double{std::numeric_limits<float>::max()} &&
               static_cast<double>(static_cast<float>(p.z)) == p.z;
  }
  constexpr double kWorthwhile = 8;
  const bool areFar = std::max(std::abs(low), std::abs(high)) > kWorthwhile * (high - low);
  return areFar && !areExact ? nearestToMiddle(positions, &Vec3::z) : 0;
}

}  // namespace

Vec3 localOrigin(std::span<const Vec3> positions) {
  if (positions.empty()) return {};
  return {nearestToMiddle(positions, &Vec3::x), nearestToMiddle(positions, &Vec3::y),
          heightOrigin(positions)};
}

double float32Rounding(double largestAbsolute, double origin) {
  constexpr double kHalfUlp32 = 0x1p-24, kUlp64 = 0x1p-52;
  return largestAbsolute * kHalfUlp32 + (largestAbsolute + std::abs(origin)) * kUlp64 +
         (largestAbsolute == 0 ? 0 : 0x1p-150);
}

}  // namespace arete
