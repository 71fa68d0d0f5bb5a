// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

namespace arete {

/// Computes slopes at the knots for a cubic Hermite curve through (knots, values) that has a continuous slope
/// and stays between the two values of each interval: no overshoot (Fritsch and Butland 1984). `isClosed`:
/// the slopes at both ends are equal, whatever the values there. Precondition: two knots at least, strictly
/// rising. O(knots).
std::vector<double> monotoneSlopes(std::span<const double> knots, std::span<const double> values,
                                   bool isClosed = false);

/// The cubic with values y0, y1 and slopes m0, m1 at the ends of an interval of length h, `u` of the way.
inline double hermite(double u, double h, double y0, double m0, double y1, double m1) {
  const double w = 1 - u;
  return y0 * (1 + 2 * u) * w * w + y1 * u * u * (3 - 2 * u) + h * u * w * (m0 * w - m1 * u);
}

/// The curve of monotoneSlopes().
class MonotoneCurve {
 public:
  MonotoneCurve() = default;
  /// Preconditions: as above.
  MonotoneCurve(std::vector<double> knots, std::vector<double> values, bool isClosed = false);

  /// Before the first knot and behind the last the value there. O(log knots).
  double at(double knot) const;

 private:
  std::vector<double> knots_, values_, slopes_;
};

}  // namespace arete
