// SPDX-License-Identifier: GPL-3.0-or-later
//
// A straight line in polar coordinates about the centre of the effective Earth obeys
//
//     h'' = k (2 h'^2 + r^2) / r,     r = 1 + k h,
//
// so all Taylor coefficients follow from a height and a slope, by power series, without the cancellation
// that a difference of radii would have. Height and slope at the middle of each piece are the closed form's.
#include "terrain/sight_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arete {
namespace {

/// The longest piece on which the first power that is left out is worth less than 1e-7 m: that is about
/// radius * (length / (2 radius))^6 / 12.
double longestPiece(double curvature) {
  return 60000 * std::pow(std::fabs(curvature) * 6.371e6, -5.0 / 6);
}

/// sin(k x) / k, for k = 0 too.
double sn(double k, double x) {
  const double t = k * x;
  return std::fabs(t) < 1e-9 ? x : std::sin(t) / k;
}

struct HeightAndSlope {
  double height, slope;
};

/// The closed form and its derivative, in metres.
HeightAndSlope closedForm(double k, double h0, double h1, double length, double s) {
  const double snS = sn(k, length), sns = sn(k, s), snr = sn(k, length - s);
  const double cs = std::cos(k * s), cr = std::cos(k * (length - s));
  const double q = -4 * k * sn(k, length / 2) * sn(k, s / 2) * sn(k, (length - s) / 2);
  const double n = h0 * (snS - sns) + h1 * (snS - snr) + k * h0 * h1 * snS + q;
  const double d = (1 + k * h0) * sns + (1 + k * h1) * snr;
  const double dq = 2 * sn(k, length / 2) * std::sin(k * (s - length / 2));  // (cos k(S - s) - cos k s) / k
  const double dn = h1 * cr - h0 * cs + dq;
  const double dd = (1 + k * h0) * cs - (1 + k * h1) * cr;
  return {n / d, (dn - n / d * dd) / d};
}

/// Coefficients of the powers of the distance, from the first two: both sides of r h'' = k (2 h'^2 + r^2),
/// power by power.
void continueSeries(double k, std::array<double, 6>& c) {
  std::array<double, 6> r{}, slope{};
  r[0] = 1 + k * c[0];
  for (int n = 0; n + 2 < 6; ++n) {
    r[n + 1] = k * c[n + 1];
    slope[n] = (n + 1) * c[n + 1];
    double right = 0, left = 0;
    for (int i = 0; i <= n; ++i) right += 2 * slope[i] * slope[n - i] + r[i] * r[n - i];
    for (int i = 1; i <= n; ++i) left += r[i] * (n - i + 2) * (n - i + 1) * c[n - i + 2];
    c[n + 2] = (k * right - left) / (r[0] * (n + 2) * (n + 1));
  }
}

}  // namespace

SightLine::SightLine(SightTrack track, double fromHeight, double toHeight, double heightUnitMetres)
    : track_(std::move(track)),
      length_(track_.points.back().distance),
      unit_(heightUnitMetres),
      from_(fromHeight),
      to_(toHeight),
      tolerance_((1e-6 + 1e-12 * length_) / heightUnitMetres) {
  const double k = track_.curvature;
  const auto count =
      k == 0 ? std::size_t{1}
             : std::max(std::size_t{1}, static_cast<std::size_t>(std::ceil(length_ / longestPiece(k))));
  pieces_.resize(count);
  piecesPerMetre_ = length_ > 0 ? static_cast<double>(count) / length_ : 0;
  for (std::size_t i = 0; i < count; ++i) {
    Piece& piece = pieces_[i];
    if (!(length_ > 0)) {
      piece.c[0] = std::min(from_, to_);
      continue;
    }
    if (k == 0) {  // exact at the first point
      piece.c[0] = from_;
      piece.c[1] = (to_ - from_) / length_;
      continue;
    }
    piece.middle = length_ * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const HeightAndSlope at = closedForm(k, from_ * unit_, to_ * unit_, length_, piece.middle);
    piece.c[0] = at.height;
    piece.c[1] = at.slope;
    continueSeries(k, piece.c);
    for (double& c : piece.c) c /= unit_;
    const double x = length_ / static_cast<double>(2 * count);
    sag_ = std::max(sag_, 2 * std::fabs(piece.c[2]) +
                              x * (6 * std::fabs(piece.c[3]) +
                                   x * (12 * std::fabs(piece.c[4]) + x * 20 * std::fabs(piece.c[5]))));
  }
}

double SightLine::slope(double s) const {
  const auto i = static_cast<std::size_t>(s * piecesPerMetre_);
  return pieces_[std::min(i, pieces_.size() - 1)].slope(s);
}

SightLine::Least SightLine::least(double s0, double z0, double s1, double z1) const {
  const double c0 = height(s0) - z0, c1 = height(s1) - z1, d = s1 - s0;
  Least least = c0 <= c1 ? Least{c0, s0} : Least{c1, s1};
  if (sag_ == 0 || !(d > 0)) return least;
  // Convex: inside only where it falls at the beginning and rises at the end. Newton's method, kept inside,
  // on a slope that is all but straight.
  const double rise = (z1 - z0) / d;
  double low = s0, high = s1, lowSlope = slope(s0) - rise, highSlope = slope(s1) - rise;
  if (!(lowSlope < 0 && highSlope > 0)) return least;
  for (int i = 0; i < 8; ++i) {
    const double s = low + (high - low) * (lowSlope / (lowSlope - highSlope));
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
