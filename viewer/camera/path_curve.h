// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// A smooth curve through points in space, parametrised by its length. In the plan it is a centripetal
/// Catmull-Rom spline (Barry and Goldman 1988; Yuksel, Schaefer, Keyser 2011), which keeps close to the
/// points and, of points at one height, makes no loop or cusp between two of them; its z is a cubic that
/// stays between the two heights of each leg. The direction is continuous.
class PathCurve {
 public:
  PathCurve() = default;
  /// `isClosed`: the last point is the first again, and the direction is continuous there. Precondition: two
  /// points at least, no two neighbours equal, all finite. O(points).
  explicit PathCurve(std::span<const Vec3> points, bool isClosed = false);

  double length() const { return lengths_.back(); }
  /// The lengths at which the curve meets its points, from 0 to length(), strictly rising.
  std::span<const double> lengthsAtPoints() const { return atPoints_; }
  /// The point at a length, which is clamped to 0..length(). Relative error of lengths: about 1e-9. O(log
  /// points).
  Vec3 at(double length) const;

 private:
  /// A part of a leg whose length one quadrature computes.
  struct Piece {
    std::size_t leg = 0;
    double from = 0, to = 1;
  };

  Vec3 valueAt(std::size_t leg, double u) const;
  double speedAt(std::size_t leg, double u) const;
  double quadrature(std::size_t leg, double from, double to) const;
  void addPieces(const Piece& piece, double length, double slack, int depth);

  std::vector<Vec3> points_, slopes_;
  std::vector<double> knotSteps_;
  std::vector<Piece> pieces_;
  std::vector<double> lengths_;  // before each piece, and of all
  std::vector<double> atPoints_;
};

}  // namespace arete
