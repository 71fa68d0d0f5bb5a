// SPDX-License-Identifier: GPL-3.0-or-later
//
// Inside, the slope is a weighted harmonic mean of the secants on either side, 0 where they differ in sign:
// at most three times the lesser secant, which is enough for a cubic to be monotone
// [FritschCarlson1980]. At an end it is that of the parabola through three points, held to the same bounds;
// of two points, their secant.
#include "viewer/camera/monotone_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace arete {
namespace {

double slopeBetween(double h0, double d0, double h1, double d1) {
  if (!(d0 * d1 > 0)) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

/// At the end of the interval h0, whose other neighbour is h1.
double slopeAtEnd(double h0, double d0, double h1, double d1) {
  const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (!(slope * d0 > 0)) return 0;
  return std::abs(slope) > 3 * std::abs(d0) ? 3 * d0 : slope;
}

}  // namespace

std::vector<double> monotoneSlopes(std::span<const double> knots, std::span<const double> values,
                                   bool isClosed) {
  const std::size_t last = knots.size() - 1;
  std::vector<double> h(last), secant(last), slopes(last + 1);
  for (std::size_t i = 0; i < last; ++i) {
    h[i] = knots[i + 1] - knots[i];
    secant[i] = (values[i + 1] - values[i]) / h[i];
  }
  for (std::size_t i = 1; i < last; ++i) slopes[i] = slopeBetween(h[i - 1], secant[i - 1], h[i], secant[i]);
  if (isClosed) {
    slopes[0] = slopes[last] = slopeBetween(h[last - 1], secant[last - 1], h[0], secant[0]);
  } else if (last == 1) {
    slopes[0] = slopes[1] = secant[0];
  } else {
    slopes[0] = slopeAtEnd(h[0], secant[0], h[1], secant[1]);
    slopes[last] = slopeAtEnd(h[last - 1], secant[last - 1], h[last - 2], secant[last - 2]);
  }
  return slopes;
}

MonotoneCurve::MonotoneCurve(std::vector<double> knots, std::vector<double> values, bool isClosed)
    : knots_(std::move(knots)),
      values_(std::move(values)),
      slopes_(monotoneSlopes(knots_, values_, isClosed)) {}

double MonotoneCurve::at(double knot) const {
  if (knot <= knots_.front()) return values_.front();
  if (knot >= knots_.back()) return values_.back();
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(knots_, knot) - knots_.begin());
  const double h = knots_[next] - knots_[next - 1];
  const double value = hermite((knot - knots_[next - 1]) / h, h, values_[next - 1], slopes_[next - 1],
                               values_[next], slopes_[next]);
  // Rounding may leave the interval by one bit, and a pitch above 90 degrees is invalid.
  const auto [low, high] = std::minmax(values_[next - 1], values_[next]);
  return std::clamp(value, low, high);
}

}  // namespace arete
