// SPDX-License-Identifier: GPL-3.0-or-later
//
// In polar coordinates about the centre of the effective Earth, 1 / r of a straight line is the sum of a sine
// and a cosine of the angle, however high it goes; its height itself grows beyond any power of the distance.
// So the Taylor series is that of
//
//     w = h / (1 + k h) = (1 - 1 / r) / k,     r = 1 + k h,     w'' = k (1 - k w).
//
// Its coefficients follow from a value and a slope, without the cancellation of a difference of radii, and
// h = w / (1 - k w). The value and slope in the middle of each polynomial are computed by the closed form. If
// no end is high, the series of w is turned into that of h, which saves a division per evaluation.
#include "terrain/sight/line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/caught_failure.h"

namespace arete {
namespace {

/// The longest length of a polynomial on which the first omitted power is less than 1e-9 r metres. That power
/// is radius * r * (length / (2 radius))^6 / 720.
double longestPolynomial(double curvature) {
  return 60000 * std::pow(std::fabs(curvature) * 6.371e6, -5.0 / 6);
}

/// In radii of the effective Earth. Deeper heights are errors in the data; the line's formula ends there.
constexpr double kDeepest = -0.5;
/// In radii of the effective Earth. Up to here the series of the height itself is good to 1e-8 m.
constexpr double kHigh = 2e-3;
/// In curvatures of the Earth. A line with a larger second derivative somewhere has a much smaller one
/// elsewhere.
constexpr double kSteep = 10;

/// sin(k x) / k; its limit x for k = 0.
double sn(double k, double x) {
  const double t = k * x;
  return std::fabs(t) < 1e-9 ? x : std::sin(t) / k;
}

struct ValueAndSlope {
  double value, slope;
};

/// Replaces the series of w by that of h = w / (1 - k w), comparing powers of h - k h w = w.
void takeHeight(double k, std::array<double, 6>& c) {
  const std::array<double, 6> w = c;
  for (std::size_t n = 0; n < c.size(); ++n) {
    double known = w[n];
    for (std::size_t i = 0; i < n; ++i) known += k * c[i] * w[n - i];
    c[n] = known / (1 - k * w[0]);
  }
}

/// w and its derivative at s, in metres, from w at the ends.
ValueAndSlope closedForm(double k, double w0, double w1, double length, double s) {
  const double whole = sn(k, length), half = sn(k, length / 2);
  const double sag = 4 * k * half * sn(k, s / 2) * sn(k, (length - s) / 2);
  return {
      (w0 * sn(k, length - s) + w1 * sn(k, s) - sag) / whole,
      (w1 * std::cos(k * s) - w0 * std::cos(k * (length - s)) + 2 * half * std::sin(k * (s - length / 2))) /
          whole};
}

}  // namespace

Status checkSightHeights(const SightTrack& track, double fromHeight, double toHeight,
                         double heightUnitMetres) try {
  for (const double h : {fromHeight, toHeight})
    if (!std::isfinite(h) || track.curvature * h * heightUnitMetres < kDeepest)
      return failure(ErrorCode::invalidData, fmt::format("a height of {:g} makes no line of sight", h));
  return {};
} catch (...) {
  return caughtFailure();
}

SightLine::SightLine(SightTrack track, double fromHeight, double toHeight, double heightUnitMetres)
    : track_(std::move(track)),
      length_(track_.points.back().distance),
      unit_(heightUnitMetres),
      from_(fromHeight),
      to_(toHeight),
      tolerance_((1e-6 + 1e-12 * length_) / heightUnitMetres) {
  const double k = track_.curvature;
  bend_ = k * unit_;
  const auto count =
      k == 0 ? std::size_t{1}
             : std::max(std::size_t{1}, static_cast<std::size_t>(std::ceil(length_ / longestPolynomial(k))));
  polynomials_.resize(count);
  if (!(length_ > 0)) {
    bend_ = 0;
    polynomials_[0].c[0] = std::min(from_, to_);
    return;
  }
  polynomialsPerMetre_ = static_cast<double>(count) / length_;
  if (k == 0) {  // expanded about the first point, so that it is exact there
    polynomials_[0].c[0] = from_;
    polynomials_[0].c[1] = (to_ - from_) / length_;
    return;
  }
  const double r0 = 1 + k * from_ * unit_, r1 = 1 + k * to_ * unit_;
  const double w0 = from_ * unit_ / r0, w1 = to_ * unit_ / r1;
  isHigh_ = std::fabs(k * unit_) * std::max(std::fabs(from_), std::fabs(to_)) > kHigh;
  for (std::size_t i = 0; i < count; ++i) {
    Polynomial& polynomial = polynomials_[i];
    polynomial.middle = length_ * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const ValueAndSlope at = closedForm(k, w0, w1, length_, polynomial.middle);
    polynomial.c[0] = at.value;
    polynomial.c[1] = at.slope;
    polynomial.c[2] = k * (1 - k * at.value) / 2;
    for (std::size_t n = 3; n < polynomial.c.size(); ++n)
      polynomial.c[n] = -k * k * polynomial.c[n - 2] / static_cast<double>(n * (n - 1));
    if (!isHigh_) takeHeight(k, polynomial.c);
    for (double& c : polynomial.c) c /= unit_;
  }
  if (k < 0) return;
  // h'' = k r (1 + 2 (r w')^2), and 1 / r is concave: r and the slope of w are greatest at an end.
  const double steepest = std::max(std::fabs(closedForm(k, w0, w1, length_, 0).slope),
                                   std::fabs(closedForm(k, w0, w1, length_, length_).slope));
  const double r = std::max(r0, r1), slope = r * steepest;
  sag_ = k * r * (1 + 2 * slope * slope) * (1 + 1e-12) / unit_;
  isSteep_ = sag_ * unit_ > kSteep * k;
}

double SightLine::slope(double s) const {
  const Polynomial& polynomial = polynomialAt(s);
  const double r = isHigh_ ? 1 / (1 - bend_ * polynomial.at(s)) : 1;
  return polynomial.slope(s) * r * r;
}

double SightLine::tangentBound(double s0, double z0, double s1, double z1) const {
  const double c0 = height(s0) - z0, c1 = height(s1) - z1, d = s1 - s0;
  if (!(d > 0)) return std::min(c0, c1);
  const double rise = (z1 - z0) / d, fall = slope(s0) - rise, climb = slope(s1) - rise;
  if (!(fall < 0 && climb > 0)) return std::min(c0, c1);
  const double meet = std::clamp((c1 - c0 - climb * d) / (fall - climb), 0.0, d);
  return std::min(std::min(c0, c1), std::min(c0 + fall * meet, c1 + climb * (meet - d)));
}

SightLine::Least SightLine::least(double s0, double z0, double s1, double z1) const {
  const double c0 = height(s0) - z0, c1 = height(s1) - z1, d = s1 - s0;
  Least least = c0 <= c1 ? Least{c0, s0} : Least{c1, s1};
  if (sag_ == 0 || !(d > 0)) return least;
  // The clearance is convex, so its minimum is inside only if it falls at s0 and rises at s1. The secant
  // method on the slope, which is nearly linear; every third step bisects, for high lines, whose slope is
  // not.
  const double rise = (z1 - z0) / d;
  double low = s0, high = s1, lowSlope = slope(s0) - rise, highSlope = slope(s1) - rise;
  if (!(lowSlope < 0 && highSlope > 0)) return least;
  for (int i = 0; i < 100; ++i) {
    const double s = low + (high - low) * (i % 3 == 2 ? 0.5 : lowSlope / (lowSlope - highSlope));
    if (!(s > low && s < high)) break;
    const double at = slope(s) - rise, clearance = height(s) - (z0 + rise * (s - s0));
    if (clearance < least.clearance) least = {clearance, s};
    if (std::fabs(at) * (high - low) * unit_ < 1e-9) break;
    (at < 0 ? low : high) = s;
    (at < 0 ? lowSlope : highSlope) = at;
  }
  return least;
}

Vec2 SightLine::planAt(double s) const {
  const auto& points = track_.points;
  const auto after = std::upper_bound(points.begin() + 1, points.end() - 1, s,
                                      [](double at, const SightPoint& p) { return at < p.distance; });
  const SightPoint &p = *(after - 1), &q = *after;
  const double d = q.distance - p.distance, t = d > 0 ? (s - p.distance) / d : 0;
  return {p.plan.x + t * (q.plan.x - p.plan.x), p.plan.y + t * (q.plan.y - p.plan.y)};
}

double sightTangent(double k, double height0, double distance, double height) {
  // 1 - cos(k d) = 2 sin^2(k d / 2)
  const double half = sn(k, distance / 2);
  return (height - height0 - (1 + k * height) * 2 * k * half * half) / ((1 + k * height) * sn(k, distance));
}

double sightHeight(double k, double height0, double distance, double tangent) {
  const double half = std::sin(k * distance / 2);
  const double drop = 2 * half * half, along = k == 0 ? distance : std::sin(k * distance) / k;
  const double left = 1 - drop - tangent * k * along;
  if (!(left > 0)) return std::numeric_limits<double>::infinity();
  return (height0 + (k == 0 ? 0 : drop / k) + tangent * along) / left;
}

}  // namespace arete
