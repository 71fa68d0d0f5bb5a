// SPDX-License-Identifier: GPL-3.0-or-later
//
// The formulas are those of view.cpp, written without branches, so that a compiler makes vector code of the
// loop, and arranged against cancellation: the angle between the axis and the ball's centre by its sine
// rho / d as well as its cosine, the angle that the ball covers by sqrt((d - r) (d + r)) / d.
//
// The eye is subtracted as the sum of two floats, so a place relative to the eye is off by at most 1e-6 of
// its distance d. The windows around what is computed allow for more: 1e-5 (d + r) for planes and depths;
// 2e-3 of nearest * reached^2, where nearest = d - r is at least d / 1000 (below that it is only known to be
// at most 1.1e-3 d, and at least 0) and the cosine at the frustum's corner is at least 1/20 (wider frusta are
// not filtered). Balls whose squared distance leaves the range of floats are unsure.
#include "engine/frustum_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/float_bounds.h"
#include "engine/vector_clones.h"

namespace arete {
namespace {

constexpr std::size_t kMost = 64, kLanes = 16;

/// The second where the first is no number.
float larger(float a, float b) {
  return a > b ? a : b;
}

/// Bit i is flag i. Flags are 0 or 1.
std::uint64_t toBits(const std::array<std::uint8_t, kMost>& flags) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < kMost; i += 8) {
    std::uint64_t eight = 0;
    for (std::size_t k = 0; k < 8; ++k) eight |= std::uint64_t(flags[i + k]) << (8 * k);
    bits |= (eight * 0x0102040810204080u >> 56) << i;  // the eight low bits, side by side
  }
  return bits;
}

}  // namespace

FrustumFilter::FrustumFilter(const View& view, double errorPerReach, double outsideError) {
  const Frustum::Planes p = Frustum(view).planes();
  const auto axis = [](const Vec3& v) {
    return Axis{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  eyeHigh_ = axis(view.eye);
  eyeLow_ = axis({view.eye.x - eyeHigh_.x, view.eye.y - eyeHigh_.y, view.eye.z - eyeHigh_.z});
  right_ = axis(p.right);
  up_ = axis(p.up);
  forward_ = axis(p.forward);
  slopeX_ = static_cast<float>(p.slopeX);
  slopeY_ = static_cast<float>(p.slopeY);
  lengthX_ = static_cast<float>(p.lengthX);
  lengthY_ = static_cast<float>(p.lengthY);
  near_ = static_cast<float>(view.nearDistance);
  far_ = static_cast<float>(view.farDistance);
  leastCosine_ = static_cast<float>(p.leastCosine);
  errorPerReach_ = static_cast<float>(errorPerReach);
  outsideError_ = floatAtMost(outsideError);
  constexpr double kMostCoordinate = 1e15, kLeast = 1e-30;
  isUsable_ = p.leastCosine >= 0.05 && std::abs(view.eye.x) < kMostCoordinate &&
              std::abs(view.eye.y) < kMostCoordinate && std::abs(view.eye.z) < kMostCoordinate &&
              errorPerReach > kLeast && errorPerReach < 1 / kLeast &&
              (view.nearDistance == 0 || view.nearDistance > kLeast) && view.nearDistance < kMostCoordinate &&
              view.farDistance > kLeast;
}

ARETE_VECTOR_CLONES
FrustumFilter::Verdicts FrustumFilter::test(std::span<const Sphere> balls,
                                            std::span<const float> errors) const {
  const std::size_t count = balls.size();
  const std::uint64_t all = count < kMost ? (std::uint64_t(1) << count) - 1 : ~std::uint64_t(0);
  if (!isUsable_) return {0, all};

  std::array<float, kMost> x{}, y{}, z{}, r{}, e{};
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = balls[i].x;
    y[i] = balls[i].y;
    z[i] = balls[i].z;
    r[i] = balls[i].radius;
    e[i] = errors[i];
  }
  std::array<std::uint8_t, kMost> exceeds{}, unsure{};
  const std::size_t lanes = (count + kLanes - 1) / kLanes * kLanes;
  for (std::size_t i = 0; i < lanes; ++i) {
    const float dx = (x[i] - eyeHigh_.x) - eyeLow_.x, dy = (y[i] - eyeHigh_.y) - eyeLow_.y,
                dz = (z[i] - eyeHigh_.z) - eyeLow_.z, radius = r[i], error = e[i];
    const float px = dx * right_.x + dy * right_.y + dz * right_.z, py = dx * up_.x + dy * up_.y + dz * up_.z,
                pz = dx * forward_.x + dy * forward_.y + dz * forward_.z;
    const float squaredFromAxis = px * px + py * py, squared = squaredFromAxis + pz * pz;
    const float distance = std::sqrt(squared), nearest = distance - radius, size = distance + radius;
    const float slack = 1e-5f * size;

    // What the least of the ball's distances and its largest angle say of z^2 / d.
    const float covered = nearest * size;
    const float covering = std::sqrt(larger(covered, 0));
    const float cosine = (pz * covering - std::sqrt(squaredFromAxis) * radius) / squared;
    const float reached = larger(cosine, leastCosine_);
    const float byAngle = nearest * reached * reached;
    const float angleLow = byAngle * 0.998f, angleHigh = byAngle * 1.002f, closeHigh = 1.1e-3f * distance;
    const bool isClose = nearest <= 1e-3f * distance;
    // What its least depth says.
    const float depth = pz - radius;
    const float depthLow = larger(depth - slack, near_) * leastCosine_,
                depthHigh = larger(depth + slack, near_) * leastCosine_;
    const float low = larger(isClose ? 0 : angleLow, depthLow) * errorPerReach_ * 0.9999f,
                high = larger(isClose ? closeHigh : angleHigh, depthHigh) * errorPerReach_ * 1.0001f;

    // How far the ball is beyond the planes.
    const float beyondX = std::abs(px) - slopeX_ * pz - radius * lengthX_,
                beyondY = std::abs(py) - slopeY_ * pz - radius * lengthY_;
    const float slackX = slack * (1 + slopeX_), slackY = slack * (1 + slopeY_);
    const float beyondNear = near_ - pz - radius, beyondFar = depth - far_;
    const bool isMaybeSeen =
        (beyondX <= slackX) & (beyondY <= slackY) & (beyondNear <= slack) & (beyondFar <= slack);
    const bool isSeen =
        (beyondX < -slackX) & (beyondY < -slackY) & (beyondNear < -slack) & (beyondFar < -slack);

    const bool isInRange = (squared > 1e-30f) & (squared < 1e30f);
    const bool isIn = (error > outsideError_) | (isSeen & (error > high) & isInRange);
    exceeds[i] = isIn;
    unsure[i] = (isInRange == false) | (isMaybeSeen & (error > low));
  }
  const std::uint64_t surely = toBits(exceeds) & all;
  return {surely, toBits(unsure) & all & ~surely};
}

}  // namespace arete
