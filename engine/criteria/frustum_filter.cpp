// SPDX-License-Identifier: GPL-3.0-or-later
//
// The formulas are those of view.cpp, branch-free, so that the compiler vectorizes the loop, and arranged to
// avoid cancellation: the angle between the axis and the ball's centre by its sine rho / d as well as its
// cosine, the angle that the ball covers by sqrt((d - r) (d + r)) / d.
//
// The eye is subtracted as the sum of two floats, so a position relative to the eye is off by at most 1e-6 of
// its distance d. The margins around the results allow for more: 1e-5 (d + r) for planes and depths; 2e-3 of
// nearest * reached^2, where nearest = d - r is at least d / 1000 (for smaller ones only the bounds 0
// and 1.1e-3 d are used) and the cosine at the frustum's corner is at least 1/20 (wider frusta are not
// filtered). Balls whose squared distance leaves the range of floats are unsure. In parallel projection the
// reach is 1 without any error.
#include "engine/criteria/frustum_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/base/float_bounds.h"
#include "engine/base/vector_clones.h"

namespace arete {
namespace {

constexpr std::size_t kMost = 64, kLanes = 16;

/// Returns b if a is NaN.
float larger(float a, float b) {
  return a > b ? a : b;
}

/// Bits are collected in words as wide as a float, so that vector flags need not be repacked.
constexpr std::size_t kPerWord = 32;
constexpr auto kBit = [] {
  std::array<std::uint32_t, kPerWord> bit{};
  for (std::size_t i = 0; i < kPerWord; ++i) bit[i] = std::uint32_t(1) << i;
  return bit;
}();

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
  halfX_ = static_cast<float>(p.halfX);
  halfY_ = static_cast<float>(p.halfY);
  isParallel_ = view.isParallel();
  lengthens_ = isParallel_ ? 0 : 1;
  lengthX_ = static_cast<float>(p.lengthX);
  lengthY_ = static_cast<float>(p.lengthY);
  near_ = static_cast<float>(view.nearDistance);
  far_ = static_cast<float>(view.farDistance);
  leastCosine_ = static_cast<float>(p.leastCosine);
  errorPerReach_ = static_cast<float>(errorPerReach);
  outsideError_ = floatAtMost(outsideError);
  rounding_ = static_cast<float>(
      1e-13 * std::max({std::abs(view.eye.x), std::abs(view.eye.y), std::abs(view.eye.z)}));
  constexpr double kMostCoordinate = 1e15, kLeast = 1e-30;
  isUsable_ = p.leastCosine >= 0.05 && std::abs(view.eye.x) < kMostCoordinate &&
              std::abs(view.eye.y) < kMostCoordinate && std::abs(view.eye.z) < kMostCoordinate &&
              errorPerReach > kLeast && errorPerReach < 1 / kLeast &&
              (view.nearDistance == 0 || std::abs(view.nearDistance) > kLeast) &&
              view.nearDistance < kMostCoordinate && std::abs(view.farDistance) > kLeast &&
              p.halfX < kMostCoordinate && p.halfY < kMostCoordinate;
}

/// Balls and errors by coordinate; unused lanes are 0.
struct FrustumFilter::Lanes {
  std::array<float, kMost> x, y, z, r, e;
  std::size_t count;
  std::uint64_t all;
};

/// A ball relative to the frustum. Distances beyond planes are positive outside, in units of the lengths of
/// the planes' normals; depths and reaches are lower and upper bounds.
struct FrustumFilter::Ball {
  float distance, nearest, fromAxis, slack;
  float byDepthLow, byDepthHigh, byAngleLow, byAngleHigh;
  float reached;  // cosine of the largest angle, at least that at the corner
  float beyondX, beyondY, beyondNear, beyondFar;
  bool isInRange;
};

[[gnu::always_inline]] inline void FrustumFilter::load(std::span<const Sphere> balls,
                                                       std::span<const float> errors, Lanes& lanes) {
  lanes.count = balls.size();
  lanes.all = lanes.count < kMost ? (std::uint64_t(1) << lanes.count) - 1 : ~std::uint64_t(0);
  std::array<Sphere, kMost> few;
  const Sphere* ball = balls.data();
  if (lanes.count < kMost) {
    few.fill({});
    std::copy(balls.begin(), balls.end(), few.begin());
    ball = few.data();
    lanes.e.fill(0);
  }
  for (std::size_t i = 0; i < kMost; ++i) {
    lanes.x[i] = ball[i].x;
    lanes.y[i] = ball[i].y;
    lanes.z[i] = ball[i].z;
    lanes.r[i] = ball[i].radius;
  }
  std::copy(errors.begin(), errors.end(), lanes.e.begin());
}

[[gnu::always_inline]] inline FrustumFilter::Ball FrustumFilter::evaluate(const Lanes& lanes,
                                                                          std::size_t i) const {
  const float dx = (lanes.x[i] - eyeHigh_.x) - eyeLow_.x, dy = (lanes.y[i] - eyeHigh_.y) - eyeLow_.y,
              dz = (lanes.z[i] - eyeHigh_.z) - eyeLow_.z, radius = lanes.r[i];
  const float px = dx * right_.x + dy * right_.y + dz * right_.z, py = dx * up_.x + dy * up_.y + dz * up_.z,
              pz = dx * forward_.x + dy * forward_.y + dz * forward_.z;
  const float squaredFromAxis = px * px + py * py, squared = squaredFromAxis + pz * pz;
  Ball b;
  b.fromAxis = std::sqrt(squaredFromAxis);
  b.distance = std::sqrt(squared);
  b.nearest = b.distance - radius;
  const float size = b.distance + radius;
  b.slack = 1e-5f * size;

  // Bounds of z^2 / d by the ball's least distance and its largest angle.
  const float covered = b.nearest * size;
  const float covering = std::sqrt(larger(covered, 0));
  const float cosine = (pz * covering - b.fromAxis * radius) / squared;
  b.reached = larger(cosine, leastCosine_);
  const float byAngle = b.nearest * b.reached * b.reached;
  const bool isClose = b.nearest <= 1e-3f * b.distance;
  b.byAngleLow = isParallel_ ? 1 : isClose ? 0 : byAngle * 0.998f;
  b.byAngleHigh = isParallel_ ? 1 : isClose ? 1.1e-3f * b.distance : byAngle * 1.002f;
  // Bounds by its least depth.
  const float depth = pz - radius;
  b.byDepthLow = isParallel_ ? 1 : larger(depth - b.slack, near_) * leastCosine_;
  b.byDepthHigh = isParallel_ ? 1 : larger(depth + b.slack, near_) * leastCosine_;

  // Distances of the ball beyond the planes.
  b.beyondX = std::abs(px) - slopeX_ * pz - halfX_ - radius * lengthX_;
  b.beyondY = std::abs(py) - slopeY_ * pz - halfY_ - radius * lengthY_;
  b.beyondNear = near_ - pz - radius;
  b.beyondFar = depth - far_;
  b.isInRange = (squared > 1e-30f) & (squared < 1e30f);
  return b;
}

ARETE_VECTOR_CLONES
FrustumFilter::Verdicts FrustumFilter::test(std::span<const Sphere> balls,
                                            std::span<const float> errors) const {
  Lanes lanes;
  load(balls, errors, lanes);
  if (!isUsable_) return {0, lanes.all};
  std::uint64_t exceeds = 0, unsure = 0;
  const std::size_t end = (lanes.count + kLanes - 1) / kLanes * kLanes;
  for (std::size_t first = 0; first < end; first += kPerWord) {
    std::uint32_t exceedsHere = 0, unsureHere = 0;
    for (std::size_t k = 0; k < std::min(kPerWord, end - first); ++k) {
      const Ball b = evaluate(lanes, first + k);
      const float error = lanes.e[first + k];
      const float low = larger(b.byAngleLow, b.byDepthLow) * errorPerReach_ * 0.9999f,
                  high = larger(b.byAngleHigh, b.byDepthHigh) * errorPerReach_ * 1.0001f;
      const float slackX = b.slack * (1 + slopeX_), slackY = b.slack * (1 + slopeY_);
      const bool isMaybeSeen = (b.beyondX <= slackX) & (b.beyondY <= slackY) & (b.beyondNear <= b.slack) &
                               (b.beyondFar <= b.slack);
      const bool isSeen = (b.beyondX < -slackX) & (b.beyondY < -slackY) & (b.beyondNear < -b.slack) &
                          (b.beyondFar < -b.slack);
      const bool isIn = (error > outsideError_) | (isSeen & (error > high) & b.isInRange);
      const bool isUnsure = (b.isInRange == false) | (isMaybeSeen & (error > low));
      exceedsHere |= isIn ? kBit[k] : 0;
      unsureHere |= isUnsure ? kBit[k] : 0;
    }
    exceeds |= std::uint64_t(exceedsHere) << first;
    unsure |= std::uint64_t(unsureHere) << first;
  }
  const std::uint64_t surely = exceeds & lanes.all;
  return {surely, unsure & lanes.all & ~surely};
}

// A verdict depends on three distances, and holds until they have shrunk to 0: from the ball to the planes of
// the frustum, and from each of the two bounds of its reach to the reach that its error needs. In the eye's
// axes the ball's centre moves by travel + d turn, and so do its distances from the planes. A depth changes
// by its share of that: travel + rho turn + d turn^2 / 2, rho the distance from the axis. The other bound,
// nearest * cos^2(phi), has a gradient of less than 1.16 (1.1547 at r = 0 and sin^2 phi = 1/3), and a turn
// alone changes it by nearest * (sin(2 phi) turn + turn^2) at most. The allowed error changes by a factor of
// exp(scale), which is a part `scale` of the larger side. The verdict "in sight and too coarse" ends with the
// first of the three, its opposite with the last. In parallel projection the reaches do not change, and a
// picture that becomes larger moves its planes as travel does.
ARETE_VECTOR_CLONES
FrustumFilter::Verdicts FrustumFilter::testFor(std::span<const Sphere> balls, std::span<const float> errors,
                                               const Motion& rate, std::span<float> units) const {
  Lanes lanes;
  load(balls, errors, lanes);
  std::fill(units.begin(), units.end(), 0.0f);
  if (!isUsable_) return {0, lanes.all};
  constexpr float kForever = 1e30f, kMostReach = 1e30f;
  const auto travel = static_cast<float>(rate.travel), turn = static_cast<float>(rate.turn),
             scale = static_cast<float>(rate.scale);
  const float reachPerError = 1 / errorPerReach_, perLengthX = 1 / lengthX_, perLengthY = 1 / lengthY_;
  // The least t with way <= b t + a t^2.
  const auto timeFor = [](float way, float b, float a) {
    const float left = larger(way, 0);
    return 2 * left / (b + std::sqrt(b * b + 4 * a * left));
  };
  std::uint64_t exceeds = 0, unsure = 0;
  std::array<float, kMost> times;
  const std::size_t end = (lanes.count + kLanes - 1) / kLanes * kLanes;
  for (std::size_t first = 0; first < end; first += kPerWord) {
    std::uint32_t exceedsHere = 0, unsureHere = 0;
    for (std::size_t k = 0; k < std::min(kPerWord, end - first); ++k) {
      const std::size_t i = first + k;
      const Ball b = evaluate(lanes, i);
      const float error = lanes.e[i], needed = error * reachPerError;
      const float neededLow = (needed < kMostReach ? needed : kMostReach) * 0.9998f - rounding_,
                  neededHigh = needed * 1.0002f + rounding_;
      const float nearest = larger(b.nearest, 0);

      const float scaleOfDepth = scale * larger(needed, b.byDepthHigh),
                  scaleOfAngle = scale * larger(needed, b.byAngleHigh);
      const float depthRate = lengthens_ * leastCosine_ * (travel + b.fromAxis * turn) + scaleOfDepth,
                  depthBend = lengthens_ * 0.5f * leastCosine_ * b.distance * turn * turn;
      const float sine2 = 2 * b.reached * std::sqrt(larger(1 - b.reached * b.reached, 0)) + 0.02f;
      const float angleRate = lengthens_ * (1.16f * travel + nearest * sine2 * turn) + scaleOfAngle,
                  angleBend = lengthens_ * nearest * turn * turn;
      const float sightRate = travel + b.distance * turn;

      const float slack = b.slack + rounding_;
      const float slackX = slack * (1 + slopeX_), slackY = slack * (1 + slopeY_);
      const float inside =
          -larger(larger((b.beyondX + slackX) * perLengthX, (b.beyondY + slackY) * perLengthY),
                  larger(b.beyondNear + slack, b.beyondFar + slack));
      const float outside =
          larger(larger((b.beyondX - slackX) * perLengthX, (b.beyondY - slackY) * perLengthY),
                 larger(b.beyondNear - slack, b.beyondFar - slack));

      const float tooFine =
          std::min({timeFor(neededLow - b.byDepthHigh, depthRate, depthBend),
                    timeFor(neededLow - b.byAngleHigh, angleRate, angleBend), timeFor(inside, sightRate, 0)});
      const float fine = std::max({timeFor(b.byDepthLow - neededHigh, depthRate, depthBend),
                                   timeFor(b.byAngleLow - neededHigh, angleRate, angleBend),
                                   timeFor(outside, sightRate, 0)});
      const bool isAlways = error > outsideError_, isNever = (error <= 0) & !isAlways;
      const bool isIn = isAlways | ((tooFine > 0) & b.isInRange);
      const bool isOut = isNever | (!isAlways & (fine > 0) & b.isInRange);
      exceedsHere |= isIn ? kBit[k] : 0;
      unsureHere |= (isIn | isOut) ? 0 : kBit[k];
      times[i] = (isAlways | isNever) ? kForever : (isIn ? tooFine : (isOut ? fine : 0)) * 0.998f;
    }
    exceeds |= std::uint64_t(exceedsHere) << first;
    unsure |= std::uint64_t(unsureHere) << first;
  }
  std::copy_n(times.begin(), lanes.count, units.begin());
  const std::uint64_t surely = exceeds & lanes.all;
  return {surely, unsure & lanes.all & ~surely};
}

}  // namespace arete
