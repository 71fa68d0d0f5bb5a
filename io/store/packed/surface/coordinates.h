// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "io/store/entropy/ordinals.h"
#include "io/store/packed/nodes/arrays.h"

namespace arete::packed {

/// Coordinates of a surface as whole numbers: multiples of its step, or ordinals of their type.
class Coordinates {
 public:
  explicit Coordinates(const MtKind& kind) : step_(kind.step), hasDoubles_(kind.hasDoubles) {}

  std::int64_t whole(double x) const {
    if (step_ > 0) return static_cast<std::int64_t>(x / step_);  // exact: the step is a power of two
    if (hasDoubles_) return static_cast<std::int64_t>(ordinal(x));
    return ordinal(static_cast<float>(x));
  }
  /// The whole number nearest to a prediction, which may be any number.
  std::int64_t nearest(double predicted) const {
    constexpr double kMost = 0x1p53;
    if (step_ > 0)
      return std::isnan(predicted)
                 ? 0
                 : static_cast<std::int64_t>(std::floor(std::clamp(predicted / step_, -kMost, kMost) + 0.5));
    return whole(predicted);
  }
  /// The inverse of whole(). Not finite for a whole number that is none of a coordinate.
  double coordinate(std::int64_t whole) const {
    if (step_ > 0) {
      const double x = static_cast<double>(whole) * step_;
      return hasDoubles_ ? x : static_cast<double>(static_cast<float>(x));
    }
    if (hasDoubles_) return fromOrdinal(static_cast<std::uint64_t>(whole));
    return static_cast<double>(fromOrdinal(static_cast<std::uint32_t>(whole)));
  }

  /// The class of how many whole numbers lie within a distance of a prediction, as its binary logarithm.
  /// @return below `classes`
  unsigned classOf(double distance, double predicted, unsigned classes) const {
    if (!(distance > 0)) return 0;
    // Doubles have more octaves than there are classes; the lowest ones share class 0.
    constexpr int kFloatBits = 23, kDoubleBits = 52, kSharedBits = 18;
    int octaves = std::ilogb(distance);
    if (step_ > 0) {
      octaves -= std::ilogb(step_);
    } else {
      octaves -=
          std::ilogb(std::max(std::fabs(predicted), distance)) - (hasDoubles_ ? kDoubleBits : kFloatBits);
      if (hasDoubles_) octaves -= kSharedBits;
    }
    return static_cast<unsigned>(std::clamp(octaves + 1, 0, static_cast<int>(classes) - 1));
  }

 private:
  double step_;
  bool hasDoubles_;
};

}  // namespace arete::packed
