// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "engine/criteria/motion.h"
#include "engine/criteria/view.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// Decides for most balls at once, in single precision, what Frustum says of one in double: whether an error
/// exceeds errorPerReach * reach() where the ball is in sight, or outsideError anywhere. What is too close to
/// call is left to the caller.
class FrustumFilter {
 public:
  /// Precondition: the view validates.
  FrustumFilter(const View& view, double errorPerReach, double outsideError);

  struct Verdicts {
    std::uint64_t exceeds = 0;  ///< bit i: ball i surely does
    std::uint64_t unsure = 0;   ///< bit i: it may; where neither is set, it surely does not
  };
  /// Precondition: at most 64 balls, as many errors.
  Verdicts test(std::span<const Sphere> balls, std::span<const float> errors) const;
  /// As test(), and how many times `rate` a view may have moved from here and still give the verdict on ball
  /// i, when its frustum is asked in double: at least units[i]. 0 of the unsure. Preconditions: as many units
  /// as balls; the parts of `rate` are positive.
  Verdicts testFor(std::span<const Sphere> balls, std::span<const float> errors, const Motion& rate,
                   std::span<float> units) const;

 private:
  struct Lanes;
  struct Ball;
  static void load(std::span<const Sphere> balls, std::span<const float> errors, Lanes& lanes);
  Ball look(const Lanes& lanes, std::size_t i) const;

  struct Axis {
    float x, y, z;
  };
  bool isUsable_;
  Axis eyeHigh_, eyeLow_, right_, up_, forward_;
  float slopeX_, slopeY_, lengthX_, lengthY_, near_, far_, leastCosine_, errorPerReach_, outsideError_,
      rounding_;
};

}  // namespace arete
