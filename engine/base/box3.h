// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/vec.h"

namespace arete {

/// A box of space, faces included. Its bounds may be infinite.
struct Box3 {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low{-kInfinity, -kInfinity, -kInfinity}, high{kInfinity, kInfinity, kInfinity};

  /// The box of no point, from which include() begins.
  static Box3 empty() { return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}}; }

  void include(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  bool meets(const Box3& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y &&
           low.z <= other.high.z && other.low.z <= high.z;
  }
  double longestSide() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }
  double diagonal() const { return std::hypot(high.x - low.x, high.y - low.y, high.z - low.z); }
};

}  // namespace arete
