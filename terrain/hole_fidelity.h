// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "terrain/hole.h"

namespace arete {

/// The triangulation of a star polygon with the least largest vertical error, then the least sum of errors;
/// where those are equal, as they often are over heights in whole units, the one of the bluntest triangles.
///
/// Some triangle covers the apex, and its error is at least that at the apex, which is known without a look
/// at any sample. So the search starts from the triangles over the apex, in the order of that bound: most
/// holes are turned down, or left with one or two to choose from, before a sample is read. What such a
/// triangle leaves are up to three pockets, polygons over one of its edges; each is filled by dynamic
/// programming over its diagonals (Klincsek 1980, with the largest error in place of the length), when asked
/// for, and kept. A pocket, like the whole, has the least largest error first and the least sum then.
///
/// A triangle is admitted when it turns counter-clockwise, is not thinner than the aspect bound and keeps the
/// limit. Triangles that all turn the same way and share the polygon's rim tile it, so nothing else needs
/// checking. A triangle beyond the best known filling is given up early.
///
/// Hole: fromApex(i), the place and height of a corner from the apex, in the metric that shapes are judged
/// in; maximum(i, j, m, limit), the error of a triangle, or some value beyond the limit.
template <class Hole>
class FidelitySearch {
 public:
  FidelitySearch(int corners, const Hole& hole, double minimumAspect)
      : hole_(hole), corners_(corners), minimumAspect_(std::max(minimumAspect, kLeastAspect)) {
    double spread = 0;
    for (int i = 0; i < corners; ++i) {
      const auto [x, y, z] = hole.fromApex(i);
      x_[i] = x;
      y_[i] = y;
      z_[i] = z;
      spread = std::max(spread, std::max(std::abs(x), std::abs(y)));
    }
    for (int i = 0; i < corners; ++i)
      for (int j = i + 1; j < corners; ++j) cross_[i][j] = x_[i] * y_[j] - y_[i] * x_[j];
    slack_ = spread * spread * kRounding;
  }

  /// Empty when every triangulation costs more than the threshold and that shows at the apex already, or when
  /// none keeps the limit; `leastError` is then a bound from below of what any triangulation costs (infinite
  /// when the aspect bound alone leaves none), and the error itself otherwise. Precondition: threshold <=
  /// limit. O(corners^3), one error each at most.
  HoleTriangulation run(double threshold, double limit, double& leastError) {
    HoleTriangulation result;
    leastError = listRoots(limit);
    double leastBound = leastError;
    for (int k = 0; k < rootCount_; ++k) leastBound = std::min(leastBound, roots_[k].bound);
    if (leastBound > threshold) {
      leastError = leastBound;
      return result;
    }
    limit_ = limit;
    for (int i = 0; i < corners_; ++i) known_[i] = 0;
    Best best = {kInfinity, kInfinity, 0};
    std::array<std::uint8_t, 3> bestRoot{};
    for (;;) {
      int next = 0;
      for (int k = 1; k < rootCount_; ++k)
        if (roots_[k].bound < roots_[next].bound) next = k;
      const Root root = roots_[next];
      if (!(root.bound <= limit_)) break;
      roots_[next].bound = kInfinity;
      const auto [i, j, m] = root.corners;
      const double thinness = thinnessOf(i, j, m);
      if (thinness * minimumAspect_ > 1) continue;
      const double error = hole_.maximum(i, j, m, limit_);
      Best mine = {std::max(root.bound, error), error + kThinness * thinness, 0};
      if (error > limit_ || !takePocket(i, j, mine) || !takePocket(j, m, mine) || !takePocket(m, i, mine)) {
        leastError = std::min(leastError, mine.worst);
        continue;
      }
      if (!isBetter(mine, best)) continue;
      best = mine;
      bestRoot = root.corners;
      limit_ = best.worst;
    }
    if (!(best.worst <= limit)) return result;
    leastError = best.worst;
    const auto [i, j, m] = bestRoot;
    result.triangles[result.size++] = bestRoot;
    emitPocket(i, j, result);
    emitPocket(j, m, result);
    emitPocket(m, i, result);
    return result;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // Far below any shape worth having, far above what rounding can turn around: what is not that thin turns
  // counter-clockwise exactly.
  static constexpr double kLeastAspect = 1e-9;
  static constexpr double kRounding = 1e-14;
  // What a triangle's thinness weighs among errors: less than any difference between them that counts.
  static constexpr double kThinness = 1e-9;

  // Beyond the limit `worst` is a bound from below: errors given up early, sides not pursued.
  struct Best {
    double worst, sum;
    std::uint8_t apex;
  };
  struct Root {
    double bound;
    std::array<std::uint8_t, 3> corners;
  };

  static bool isBetter(const Best& a, const Best& b) {
    return a.worst < b.worst || (a.worst == b.worst && a.sum < b.sum);
  }
  int after(int i) const { return i + 1 < corners_ ? i + 1 : 0; }

  double squaredLength(int i, int j) const {
    const double dx = x_[i] - x_[j], dy = y_[i] - y_[j];
    return dx * dx + dy * dy;
  }
  /// Longest edge over least altitude; infinite when i, j, m do not turn counter-clockwise.
  double thinnessOf(int i, int j, int m) const {
    const double area = (x_[j] - x_[i]) * (y_[m] - y_[i]) - (y_[j] - y_[i]) * (x_[m] - x_[i]);
    if (!(area > 0)) return kInfinity;
    return std::max(std::max(squaredLength(i, j), squaredLength(j, m)), squaredLength(m, i)) / area;
  }

  /// The triangles over the apex whose error there keeps the limit; returns the least of the others' bounds.
  /// Corners go once around the apex at most.
  double listRoots(double limit) {
    double least = kInfinity;
    rootCount_ = 0;
    for (int i = 0; i + 2 < corners_; ++i)
      for (int j = i + 1; j + 1 < corners_ && cross_[i][j] >= -slack_; ++j)
        for (int m = corners_ - 1; m > j && cross_[i][m] <= slack_; --m) {
          if (cross_[j][m] < -slack_) continue;
          const double atI = cross_[j][m], atJ = -cross_[i][m], atM = cross_[i][j];
          const double bound = std::abs(z_[i] * atI + z_[j] * atJ + z_[m] * atM) / (atI + atJ + atM);
          if (bound > limit)
            least = std::min(least, bound);
          else
            roots_[rootCount_++] = {bound, {std::uint8_t(i), std::uint8_t(j), std::uint8_t(m)}};
        }
    return least;
  }

  bool takePocket(int i, int j, Best& mine) {
    if (after(i) == j) return true;
    const Best& pocket = fillPocket(i, j);
    mine.worst = std::max(mine.worst, pocket.worst);
    mine.sum += pocket.sum;
    return pocket.worst <= limit_;
  }

  /// The polygon i, i + 1, ..., j (around the end of the list, if need be) with the diagonal j -> i. The
  /// limit only falls, so what has failed once need not be tried again.
  const Best& fillPocket(int i, int j) {
    Best& best = pockets_[i][j];
    if (known_[i] >> j & 1) return best;
    known_[i] |= std::uint64_t(1) << j;
    best = {kInfinity, kInfinity, 0};
    for (int m = after(i); m != j; m = after(m)) {
      const double thinness = thinnessOf(i, m, j);
      if (thinness * minimumAspect_ > 1) continue;
      const double error = hole_.maximum(i, m, j, std::min(best.worst, limit_));
      Best mine = {error, error + kThinness * thinness, std::uint8_t(m)};
      if (error <= limit_ && error <= best.worst && takePocket(i, m, mine)) takePocket(m, j, mine);
      if (isBetter(mine, best)) best = mine;
    }
    return best;
  }

  void emitPocket(int i, int j, HoleTriangulation& result) const {
    if (after(i) == j) return;
    const int m = pockets_[i][j].apex;
    std::array<std::uint8_t, 3> t{std::uint8_t(i), std::uint8_t(m), std::uint8_t(j)};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    result.triangles[result.size++] = t;
    emitPocket(i, m, result);
    emitPocket(m, j, result);
  }

  static constexpr int kMostRoots = kMaxHoleCorners * (kMaxHoleCorners - 1) * (kMaxHoleCorners - 2) / 6;

  const Hole& hole_;
  int corners_;
  double minimumAspect_;
  double limit_ = 0;  // the least of the limit and what the best filling costs
  double slack_;      // what rounding may take from a cross product
  int rootCount_ = 0;
  std::array<double, kMaxHoleCorners> x_, y_, z_;
  std::array<std::array<double, kMaxHoleCorners>, kMaxHoleCorners> cross_;  // of corners i < j
  std::array<std::uint64_t, kMaxHoleCorners> known_;                        // bit j of i: pockets_[i][j] is
  std::array<std::array<Best, kMaxHoleCorners>, kMaxHoleCorners> pockets_;
  std::array<Root, kMostRoots> roots_;
};

}  // namespace arete
