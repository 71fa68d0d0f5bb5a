// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/writer/local_positions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/geo/crs/local_origin.h"

namespace arete {
namespace {

constexpr std::array<double Vec3::*, 3> kAxes = {&Vec3::x, &Vec3::y, &Vec3::z};
constexpr double kLargest = std::numeric_limits<float>::max();

/// Whether floats hold the coordinates on an axis.
bool areFloats(std::span<const Vec3> positions, double Vec3::*axis) {
  return std::ranges::all_of(positions, [&](const Vec3& p) {
    return std::abs(p.*axis) <= kLargest && double{static_cast<float>(p.*axis)} == p.*axis;
  });
}

/// Whether the coordinates on an axis are far from 0, compared with their range.
bool areFar(std::span<const Vec3> positions, double Vec3::*axis) {
  constexpr double kWorthwhile = 8;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : positions) {
    low = std::min(low, p.*axis);
    high = std::max(high, p.*axis);
  }
  return std::max(std::abs(low), std::abs(high)) > kWorthwhile * (high - low);
}

}  // namespace

Result<LocalPositions> localPositions(std::span<const Vec3> positions, const std::optional<Vec3>& origin) {
  LocalPositions local;
  const Vec3 middle = origin.value_or(localOrigin(positions));
  for (double Vec3::*const axis : kAxes) {
    if (areFloats(positions, axis)) continue;
    if (origin || areFar(positions, axis)) local.translation.*axis = middle.*axis;
  }
  local.positions.reserve(positions.size());
  for (const Vec3& p : positions) {
    Float3 rounded{};
    for (std::size_t k = 0; k < kAxes.size(); ++k) {
      const double Vec3::*const axis = kAxes[k];
      const double origin_k = local.translation.*axis;
      // Without a translation -0 stays.
      const double relative = origin_k == 0 ? p.*axis : p.*axis - origin_k;
      if (!(std::abs(relative) <= kLargest))
        return failure(ErrorCode::invalidData,
                       fmt::format("the position {}, {}, {} is too far for 32-bit floats", p.x, p.y, p.z));
      rounded[k] = static_cast<float>(relative);
      const double back = double{rounded[k]} + origin_k;
      double& most = local.rounding.*kAxes[k];
      most = std::max(most, std::abs(back - p.*axis));
    }
    local.positions.push_back(rounded);
  }
  return local;
}

}  // namespace arete
