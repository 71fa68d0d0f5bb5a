// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "engine/criteria/motion.h"
#include "engine/criteria/view.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// Tests many balls at once in single precision: whether an error exceeds errorPerReach * Frustum::reach() if
/// the ball is in sight, or outsideError anywhere. Cases too close to call are returned to the caller, who
/// decides them in double precision.
class FrustumFilter {
 public:
  /// Precondition: the view is valid.
  FrustumFilter(const View& view, double errorPerReach, double outsideError);

  struct Verdicts {
    std::uint64_t exceeds = 0;  ///< bit i: the error of ball i exceeds the allowed one
    std::uint64_t unsure = 0;   ///< bit i: too close to call; if neither bit is set, it does not exceed it
  };
  /// Precondition: at most 64 balls, as many errors.
  Verdicts test(std::span<const Sphere> balls, std::span<const float> errors) const;
  /// test(), and how long each verdict holds: a view that has moved from this one by at most units[i] * rate
  /// has the same verdict on ball i, computed in double precision.
  /// @param rate The unit of motion; all parts are positive.
  /// @param units Receives as many numbers as balls; 0 if unsure.
  Verdicts testFor(std::span<const Sphere> balls, std::span<const float> errors, const Motion& rate,
                   std::span<float> units) const;

 private:
  struct Lanes;
  struct Ball;
  static void load(std::span<const Sphere> balls, std::span<const float> errors, Lanes& lanes);
  Ball evaluate(const Lanes& lanes, std::size_t i) const;

  struct Axis {
    float x, y, z;
  };
  bool isUsable_, isParallel_;
  Axis eyeHigh_, eyeLow_, right_, up_, forward_;
  float slopeX_, slopeY_, halfX_, halfY_, lengthX_, lengthY_, near_, far_, leastCosine_, errorPerReach_,
      outsideError_, rounding_;
  float lengthens_;  // 1 where the reach grows with the distance, 0 in parallel projection
};

}  // namespace arete
