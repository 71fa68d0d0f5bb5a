// SPDX-License-Identifier: GPL-3.0-or-later
//
// Legs are cubic Hermite curves over knots that are apart by the square root of the leg's chord: centripetal.
// The slope of the plan at a point is that of the parabola through it and its neighbours (which is what
// Barry and Goldman's pyramid gives); at a free end the second derivative is 0. The slope of z is monotone.
//
// The length of a leg is integrated by Gauss and Legendre over pieces, halved until the halves agree with the
// whole: a sharp bend takes many, a gentle one few. A length is looked up among the sums and its place in the
// piece found by Newton's steps, each held inside the piece.
#include "viewer/camera/path_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "viewer/camera/monotone_curve.h"

namespace arete {
namespace {

constexpr int kMostHalvings = 40;
constexpr double kSlack = 1e-11;  // of a leg's length, for each piece

double slopeOfParabola(double h0, double d0, double h1, double d1) {
  return (d0 * h1 + d1 * h0) / (h0 + h1);
}

}  // namespace

PathCurve::PathCurve(std::span<const Vec3> points, bool isClosed) : points_(points.begin(), points.end()) {
  const std::size_t last = points_.size() - 1;
  std::vector<double> knots(last + 1), heights(last + 1);
  std::vector<Vec2> secants(last);
  knotSteps_.resize(last);
  for (std::size_t i = 0; i < last; ++i) {
    const Vec3 d = points_[i + 1] - points_[i];
    const double h = std::sqrt(std::hypot(d.x, d.y, d.z));
    knotSteps_[i] = h;
    knots[i + 1] = knots[i] + h;
    secants[i] = {d.x / h, d.y / h};
  }
  // Heights have slopes of their own, so that the path never leaves the range between two keys.
  for (std::size_t i = 0; i <= last; ++i) heights[i] = points_[i].z;
  const std::vector<double> climbs = monotoneSlopes(knots, heights, isClosed);

  slopes_.resize(last + 1);
  const auto between = [&](std::size_t before, std::size_t after) -> Vec3 {
    const double h0 = knotSteps_[before], h1 = knotSteps_[after];
    return {slopeOfParabola(h0, secants[before].x, h1, secants[after].x),
            slopeOfParabola(h0, secants[before].y, h1, secants[after].y), 0};
  };
  for (std::size_t i = 1; i < last; ++i) slopes_[i] = between(i - 1, i);
  if (isClosed) {
    slopes_[0] = slopes_[last] = between(last - 1, 0);
  } else {
    const auto free = [](Vec2 secant, const Vec3& other) -> Vec3 {
      return {(3 * secant.x - other.x) / 2, (3 * secant.y - other.y) / 2, 0};
    };
    // A single leg has no other secant and is straight.
    const Vec3 straight{secants[0].x, secants[0].y, 0};
    slopes_[0] = last == 1 ? straight : free(secants[0], slopes_[1]);
    slopes_[last] = last == 1 ? straight : free(secants[last - 1], slopes_[last - 1]);
  }
  for (std::size_t i = 0; i <= last; ++i) slopes_[i].z = climbs[i];

  lengths_ = {0};
  atPoints_ = {0};
  for (std::size_t leg = 0; leg < last; ++leg) {
    const double length = quadrature(leg, 0, 1);
    addPieces({leg, 0, 1}, length, kSlack * length, 0);
    atPoints_.push_back(lengths_.back());
  }
}

void PathCurve::addPieces(const Piece& piece, double length, double slack, int depth) {
  const double middle = (piece.from + piece.to) / 2;
  const double left = quadrature(piece.leg, piece.from, middle);
  const double right = quadrature(piece.leg, middle, piece.to);
  // Both halves keep the slack of the whole leg; the depth bounds the work at a cusp.
  if (depth < kMostHalvings && std::abs(left + right - length) > slack) {
    addPieces({piece.leg, piece.from, middle}, left, slack, depth + 1);
    addPieces({piece.leg, middle, piece.to}, right, slack, depth + 1);
    return;
  }
  pieces_.push_back(piece);
  lengths_.push_back(lengths_.back() + left + right);
}

Vec3 PathCurve::valueAt(std::size_t leg, double u) const {
  const Vec3 &p = points_[leg], &q = points_[leg + 1], &m = slopes_[leg], &n = slopes_[leg + 1];
  const double h = knotSteps_[leg];
  // The slopes of z are monotone, so the clamp only takes rounding away.
  const auto [low, high] = std::minmax(p.z, q.z);
  return {hermite(u, h, p.x, m.x, q.x, n.x), hermite(u, h, p.y, m.y, q.y, n.y),
          std::clamp(hermite(u, h, p.z, m.z, q.z, n.z), low, high)};
}

double PathCurve::speedAt(std::size_t leg, double u) const {
  const double h = knotSteps_[leg], w = 1 - u;
  const auto part = [&](double p, double m, double q, double n) {
    return 6 * u * w * (q - p) + h * (m * w * (1 - 3 * u) + n * u * (3 * u - 2));
  };
  const Vec3 &p = points_[leg], &q = points_[leg + 1], &m = slopes_[leg], &n = slopes_[leg + 1];
  return std::hypot(part(p.x, m.x, q.x, n.x), part(p.y, m.y, q.y, n.y), part(p.z, m.z, q.z, n.z));
}

double PathCurve::quadrature(std::size_t leg, double from, double to) const {
  // These are places and weights of the rule of five points, which is exact up to degree 9.
  constexpr std::array<double, 3> kAt = {0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> kWeight = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double middle = (from + to) / 2, half = (to - from) / 2;
  double sum = kWeight[0] * speedAt(leg, middle);
  for (std::size_t i = 1; i < kAt.size(); ++i)
    sum += kWeight[i] * (speedAt(leg, middle - half * kAt[i]) + speedAt(leg, middle + half * kAt[i]));
  return half * sum;
}

Vec3 PathCurve::at(double length) const {
  if (!(length > 0)) return points_.front();
  if (length >= lengths_.back()) return points_.back();
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(lengths_, length) - lengths_.begin());
  const auto& [leg, from, to] = pieces_[next - 1];
  // The place stays between low and high: a step of Newton's that would leave them becomes a bisection.
  const double wanted = length - lengths_[next - 1];
  double low = from, high = to;
  double u = low + (high - low) * wanted / (lengths_[next] - lengths_[next - 1]);
  for (int step = 0; step < 50; ++step) {
    const double off = quadrature(leg, from, u) - wanted;
    (off > 0 ? high : low) = u;
    if (std::abs(off) <= 1e-13 * lengths_.back()) break;
    const double newton = u - off / speedAt(leg, u);
    u = newton > low && newton < high ? newton : (low + high) / 2;
  }
  return valueAt(leg, u);
}

}  // namespace arete
