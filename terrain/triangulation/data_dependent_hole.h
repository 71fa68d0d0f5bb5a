// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "terrain/triangulation/delaunay_hole.h"

namespace arete {

/// The cost of filling a hole: the least largest error of all its triangulations.
struct HoleCost {
  double error;  ///< the cost, or a lower bound of it
  bool isExact;  ///< `error` is the cost: a triangulation with this error exists
};

/// The triangulation of a star polygon with the least largest vertical error, and of all of those the one
/// with the least sum of squared diagonals: a data-dependent triangulation [DynLevinRippa1990], found by
/// dynamic programming over the polygon's diagonals [Klincsek1980]. The worst triangle is the cost of a
/// removal; the other triangles affect the costs of later removals, and short edges keep these lower than
/// small errors do (docs/decisions/0013).
///
/// A build needs the cost often and the triangulation once, so two functions find them.
///
/// cost(): Some triangle covers the apex, and its error is at least that at the apex, which is known without
/// reading a sample. So the search starts from the triangles over the apex, in the order of that bound: most
/// holes are rejected, or have one or two candidates left, before a sample is read. A triangle over the apex
/// leaves up to three pockets, polygons over one of its edges. Each pocket is filled by dynamic programming
/// with the largest error in place of the length, when it is first needed, and the result is kept. A pocket's
/// search stops at the bound of the triangle over the apex: a smaller error cannot lower the cost.
///
/// shortest(): Dynamic programming over all diagonals for the least sum, with the errors at the apex alone.
/// Then the errors of the triangles found are measured; triangles above the limit are excluded, and the
/// search is repeated.
///
/// A triangle is admitted if it turns counter-clockwise, is not thinner than the aspect bound, and its error
/// is at most the limit. Triangles that all turn the same way and share the polygon's rim tile it, so nothing
/// else needs checking.
///
/// Hole: fromApex(i), position and height of a corner relative to the apex, in the metric of the aspect
/// bound; maximum(i, j, m, limit), the error of a triangle, or some value above the limit.
template <class Hole>
class DataDependentSearch {
 public:
  DataDependentSearch(int corners, const Hole& hole, double minimumAspect)
      : hole_(hole), corners_(corners), minimumAspect_(std::max(minimumAspect, kLeastAspect)) {
    for (int i = 0; i < corners; ++i) {
      const auto [x, y, z] = hole.fromApex(i);
      x_[i] = x;
      y_[i] = y;
      z_[i] = z;
    }
  }

  /// The cost of the hole, exact to a relative 1e-12. A lower bound if the errors at the apex alone exceed
  /// the threshold, or if every triangulation exceeds the limit (infinity: the aspect bound admits none).
  /// O(corners^3), at most one error measured for each triangle. Precondition: threshold <= limit.
  HoleCost cost(double threshold, double limit) {
    double least = withCorners(corners_, [&](auto known) { return listRoots<known>(limit); });
    int next = leastRoot();
    if (std::min(least, roots_[next].bound) > threshold) return {std::min(least, roots_[next].bound), false};
    limit_ = limit;
    for (int i = 0; i < corners_; ++i) known_[i] = 0;
    double best = kInfinity;
    for (;; next = leastRoot()) {
      const Root root = roots_[next];
      if (!(root.bound <= limit_)) break;
      roots_[next].bound = kInfinity;
      const auto [i, j, m] = root.corners;
      const double beside = std::max({knownOf(i, j), knownOf(j, m), knownOf(m, i)});
      if (beside > limit_) {
        least = std::min(least, beside);
        continue;
      }
      if (isTooThin(i, j, m)) continue;
      enough_ = root.bound * (1 + kSame);
      double mine = std::max(root.bound, hole_.maximum(i, j, m, limit_));
      if (mine > limit_ || !takePocket(i, j, mine) || !takePocket(j, m, mine) || !takePocket(m, i, mine)) {
        least = std::min(least, mine);
        continue;
      }
      best = mine;
      if (best <= enough_) break;
      limit_ = best * (1 - kSame);
    }
    return best <= limit ? HoleCost{best, true} : HoleCost{least, false};
  }

  /// The triangulation; empty if every one exceeds the limit. O(corners^3) and mostly one error measured for
  /// each triangle.
  /// @param errorOf errorOf(i, m, j): the error of corners i < m < j, exact up to the limit. Called for every
  /// triangle of the result, and for no other triangle on its edge i - j after it.
  template <class ErrorOf>
  HoleTriangulation shortest(double limit, const ErrorOf& errorOf) {
    return withCorners(corners_, [&](auto known) { return shortestWithin<known>(limit, errorOf); });
  }

 private:
  using Masks = std::array<std::array<std::uint64_t, kMaxHoleCorners>, kMaxHoleCorners>;

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // Far thinner than any useful shape, and far above the rounding errors: a triangle that is not as thin as
  // this turns counter-clockwise exactly.
  static constexpr double kLeastAspect = 1e-9;
  static constexpr double kRounding = 1e-14;
  // Errors that differ by less count as equal, as the bound at the apex and the measured error there do.
  static constexpr double kSame = 1e-12;
  // Refills before all triangles are checked. Nearly all holes need less.
  static constexpr int kRounds = 8;

  /// Added to a number: infinity unless a condition holds, without a branch.
  static constexpr std::array<double, 2> kZeroIf = {kInfinity, 0};

  struct Root {
    double bound;
    std::array<std::uint8_t, 3> corners;
  };

  static std::uint64_t bit(int m) { return std::uint64_t(1) << m; }
  // Branch-free min and max; return the first operand if either is NaN.
  static double lesser(double a, double b) { return b < a ? b : a; }
  static double greater(double a, double b) { return a < b ? b : a; }
  /// Calls f with 0, 1, ... as constants.
  template <int kTimes, class F>
  [[gnu::always_inline]] static void inTurn(const F& f) {
    [&]<int... k>(std::integer_sequence<int, k...>) {
      (f(std::integral_constant<int, k>()), ...);
    }
    (std::make_integer_sequence<int, kTimes>());
  }
  template <int kCorners>
  int corners() const {
    return kCorners > 0 ? kCorners : corners_;
  }
  int after(int i) const { return i + 1 < corners_ ? i + 1 : 0; }

  double squaredLength(int i, int j) const {
    const double dx = x_[i] - x_[j], dy = y_[i] - y_[j];
    return dx * dx + dy * dy;
  }
  /// Whether the least altitude is below the aspect bound's part of the longest edge, or i, j, m do not turn
  /// counter-clockwise.
  bool isTooThin(int i, int j, int m) const {
    const double area = (x_[j] - x_[i]) * (y_[m] - y_[i]) - (y_[j] - y_[i]) * (x_[m] - x_[i]);
    return !(area >= greater(greater(squaredLength(i, j), squaredLength(j, m)), squaredLength(m, i)) *
                         minimumAspect_);
  }

  template <int kCorners>
  void findCrosses() {
    const auto find = [&](int i, int j) { cross_[i][j] = x_[i] * y_[j] - y_[i] * x_[j]; };
    if constexpr (kCorners > 0) {
      inTurn<kCorners>([&](auto i) { inTurn<kCorners - i - 1>([&](auto k) { find(i, i + 1 + k); }); });
    } else {
      for (int i = 0; i < corners_; ++i)
        for (int j = i + 1; j < corners_; ++j) find(i, j);
    }
  }

  /// Whether the triangle of corners i < m < j is not too thin, and within the limit at the apex if it covers
  /// the apex. Branch-free, as the result is not predictable.
  bool isAdmitted(int i, int m, int j, double limit) const {
    const double atI = cross_[m][j], atM = -cross_[i][j], atJ = cross_[i][m];
    const int isThin = isTooThin(i, m, j), isOver = lesser(lesser(atI, atM), atJ) >= 0,
              isBeyond =
                  std::abs(z_[i] * atI + z_[m] * atM + z_[j] * atJ) > limit * (1 + kSame) * (atI + atM + atJ);
    return (isThin | (isOver & isBeyond)) == 0;
  }

  /// Lists the triangles over the apex whose error there is at most the limit; returns the least bound of the
  /// others.
  template <int kCorners>
  double listRoots(double limit) {
    const int corners = this->corners<kCorners>();
    findCrosses<kCorners>();
    double spread = 0;
    for (int i = 0; i < corners; ++i) spread = std::max(spread, std::max(std::abs(x_[i]), std::abs(y_[i])));
    const double slack = spread * spread * kRounding;  // what rounding may take from a cross product
    double least = kInfinity;
    rootCount_ = 0;
    const auto list = [&](int i, int j, int m, double atI, double atJ, double atM, bool isOver)
        __attribute__((always_inline)) {
      const double bound = std::abs(z_[i] * atI + z_[j] * atJ + z_[m] * atM) / (atI + atJ + atM);
      const int counts = isOver, keeps = bound <= limit;
      roots_[rootCount_] = {bound, {std::uint8_t(i), std::uint8_t(j), std::uint8_t(m)}};
      rootCount_ += counts & keeps;
      least = lesser(least, greater(bound, kZeroIf[counts & ~keeps]));
    };
    if constexpr (kCorners > 0) {
      // Few enough to test all of them, without a branch.
      inTurn<kCorners - 2>([&](auto i) {
        inTurn<kCorners - 2 - i>([&](auto k) {
          constexpr int j = i + 1 + k;
          inTurn<kCorners - 1 - j>([&](auto l) {
            constexpr int m = j + 1 + l;
            const double atM = cross_[i][j], atI = cross_[j][m], atJ = -cross_[i][m];
            list(i, j, m, atI, atJ, atM, lesser(lesser(atI, atJ), atM) >= -slack);
          });
        });
      });
      return least;
    }
    // Corners go once around the apex at most: those left of a corner, and those right of it, are
    // consecutive. Of the corners after i: the last not right of it, and the first not left of it.
    std::array<std::uint8_t, kMaxHoleCorners> lastLeft, firstRight;
    for (int i = 0, left = 0; i < corners_; ++i) {
      left = std::max(left, i);
      while (left + 1 < corners_ && cross_[i][left + 1] >= -slack) ++left;
      int right = left + 1;
      while (right - 1 > i && cross_[i][right - 1] <= slack) --right;  // those straight across are both
      lastLeft[i] = static_cast<std::uint8_t>(left);
      firstRight[i] = static_cast<std::uint8_t>(right);
    }
    for (int i = 0; i + 2 < corners; ++i)
      for (int j = i + 1; j <= lastLeft[i]; ++j)
        for (int m = std::max<int>(firstRight[i], j + 1); m <= lastLeft[j]; ++m)
          list(i, j, m, cross_[j][m], -cross_[i][m], cross_[i][j], true);
    return least;
  }
  /// The index of the first root with the least bound; of one with an infinite bound if none is left.
  int leastRoot() {
    roots_[rootCount_].bound = kInfinity;
    int least = 0;
    double bound = roots_[0].bound;
    for (int k = 1; k < rootCount_; ++k) {
      least = roots_[k].bound < bound ? k : least;
      bound = lesser(bound, roots_[k].bound);
    }
    return least;
  }

  /// The known lower bound of a pocket, 0 if it was not filled.
  double knownOf(int i, int j) const { return known_[i] & bit(j) ? pockets_[i][j] : 0; }

  bool takePocket(int i, int j, double& mine) {
    if (after(i) == j) return true;
    mine = std::max(mine, fillPocket(i, j));
    return mine <= limit_;
  }

  /// The least largest error over the polygon i, i + 1, ..., j (around the end of the list, if need be) with
  /// the diagonal j -> i; or any error at most enough_; or, above the limit, a lower bound. The limit only
  /// falls and enough_ only grows, so a known result stays valid.
  double fillPocket(int i, int j) {
    double& best = pockets_[i][j];
    if (known_[i] & bit(j)) return best;
    known_[i] |= bit(j);
    best = kInfinity;
    for (int m = after(i); m != j && best > enough_; m = after(m)) {
      if (isTooThin(i, m, j)) continue;
      const double beside = std::max(knownOf(i, m), knownOf(m, j));
      if (beside > limit_ || beside >= best) {
        best = std::min(best, beside);
        continue;
      }
      double mine = hole_.maximum(i, m, j, std::min(best, limit_));
      if (mine <= limit_ && mine < best && takePocket(i, m, mine)) takePocket(m, j, mine);
      best = std::min(best, mine);
    }
    return best;
  }

  /// See shortest().
  template <int kCorners, class ErrorOf>
  HoleTriangulation shortestWithin(double limit, const ErrorOf& errorOf) {
    const int corners = this->corners<kCorners>();
    findCrosses<kCorners>();
    // Bit m of i, j: the triangle of these three corners, i < m < j, may be used; keeps the limit.
    Masks allowed, kept;
    for (int i = 0; i < corners; ++i)
      for (int j = i + 2; j < corners; ++j) {
        std::uint64_t mask = 0;
        for (int m = i + 1; m < j; ++m) mask |= std::uint64_t{isAdmitted(i, m, j, limit)} << m;
        allowed[i][j] = mask;
        kept[i][j] = 0;
      }
    const auto check = [&](int i, int m, int j) {
      if (kept[i][j] == bit(m)) return true;
      const bool isKept = errorOf(i, m, j) <= limit;
      kept[i][j] = isKept ? bit(m) : 0;
      if (!isKept) allowed[i][j] &= ~bit(m);
      return isKept;
    };
    for (int round = 0;; ++round) {
      const HoleTriangulation found = shortestOf<kCorners>(allowed);
      bool isKept = true;
      for (const auto& t : found.view()) isKept = check(t[0], t[1], t[2]) && isKept;
      if (isKept) return found;
      if (round < kRounds) continue;
      for (int i = 0; i < corners; ++i)
        for (int j = i + 2; j < corners; ++j)
          for (int m = i + 1; m < j; ++m)
            if (allowed[i][j] & bit(m)) check(i, m, j);
    }
  }

  /// Of the allowed triangles. Empty when there is none.
  template <int kCorners>
  HoleTriangulation shortestOf(const Masks& allowed) const {
    const int corners = this->corners<kCorners>();
    std::array<std::array<double, kMaxHoleCorners>, kMaxHoleCorners> length;
    std::array<std::array<std::uint8_t, kMaxHoleCorners>, kMaxHoleCorners> third;
    for (int i = 0; i + 1 < corners; ++i) length[i][i + 1] = 0;
    for (int span = 2; span < corners; ++span)
      for (int i = 0; i + span < corners; ++i) {
        const int j = i + span;
        double least = kInfinity;
        int best = i + 1;
        for (int m = i + 1; m < j; ++m) {
          const double mine = length[i][m] + length[m][j] + kZeroIf[allowed[i][j] >> m & 1];
          best = mine < least ? m : best;
          least = lesser(least, mine);
        }
        third[i][j] = static_cast<std::uint8_t>(best);
        length[i][j] = least + squaredLength(i, j);
      }
    HoleTriangulation result;
    if (!(length[0][corners - 1] < kInfinity)) return result;
    std::array<std::array<std::uint8_t, 2>, kMaxHoleCorners> stack;
    int top = 0;
    stack[top++] = {0, static_cast<std::uint8_t>(corners - 1)};
    while (top > 0) {
      const auto [i, j] = stack[--top];
      if (j - i < 2) continue;
      const std::uint8_t m = third[i][j];
      result.triangles[result.size++] = {i, m, j};
      stack[top++] = {i, m};
      stack[top++] = {m, j};
    }
    return result;
  }

  // One more than there are, as each is written before it is known whether it is one.
  static constexpr int kMostRoots = kMaxHoleCorners * (kMaxHoleCorners - 1) * (kMaxHoleCorners - 2) / 6 + 1;

  const Hole& hole_;
  int corners_;
  double minimumAspect_;
  double limit_ = 0;   // the least of the limit and what the best filling costs
  double enough_ = 0;  // below this errors do not matter any more
  int rootCount_ = 0;
  std::array<double, kMaxHoleCorners> x_, y_, z_;
  std::array<std::array<double, kMaxHoleCorners>, kMaxHoleCorners> cross_;  // of corners i < j
  std::array<std::uint64_t, kMaxHoleCorners> known_;                        // bit j of i: pockets_[i][j] is
  std::array<std::array<double, kMaxHoleCorners>, kMaxHoleCorners> pockets_;
  std::array<Root, kMostRoots> roots_;
};

}  // namespace arete
