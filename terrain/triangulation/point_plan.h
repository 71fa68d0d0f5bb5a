// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/ids.h"
#include "engine/base/vec.h"
#include "terrain/triangulation/delaunay_hole.h"

namespace arete {

/// The plan geometry of scattered points: CGAL's exact predicates on the doubles themselves. The Delaunay
/// metric stretches x by a power of two near the ground aspect of the CRS: exact, so that no orientation
/// changes.
class PointPlan {
 public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_2;

  /// Precondition: xStretch is a power of two.
  PointPlan(std::span<const Vec3> points, double xStretch) : points_(points), xStretch_(xStretch) {}

  Vec2 planPosition(VertexId v) const { return {points_[v.index()].x, points_[v.index()].y}; }
  Point point(VertexId v) const { return {points_[v.index()].x * xStretch_, points_[v.index()].y}; }

  /// > 0 when a, b, c turn counter-clockwise; exact.
  int orientation(VertexId a, VertexId b, VertexId c) const {
    return static_cast<int>(CGAL::orientation(point(a), point(b), point(c)));
  }

  /// A star polygon and its apex; the same queries as LatticePlan::Polygon.
  class Polygon {
   public:
    Polygon(const PointPlan& plan, VertexId apex, std::span<const VertexId> link) : apex_(plan.point(apex)) {
      for (std::size_t i = 0; i < link.size(); ++i) corners_[i] = plan.point(link[i]);
    }
    int orientation(int i, int j, int m) const {
      return static_cast<int>(CGAL::orientation(corners_[i], corners_[j], corners_[m]));
    }
    int orientationToApex(int i, int j) const {
      return static_cast<int>(CGAL::orientation(corners_[i], corners_[j], apex_));
    }
    int inCircle(int i, int j, int m, int n) const {
      return static_cast<int>(
          CGAL::side_of_oriented_circle(corners_[i], corners_[j], corners_[m], corners_[n]));
    }
    /// The corner between i and j with the largest angle, i.e. the smallest cotangent, dot / cross. Floating-
    /// point filters decide where the rounding errors permit it ([Shewchuk1997], section 4, has the exact
    /// constants; kVanishing covers underflow), exact predicates elsewhere.
    template <class PrefersLater>
    int third(int i, int j, const PrefersLater& prefersLater) const {
      constexpr double kCross = 0x1p-51, kGap = 0x1p-49, kVanishing = 0x1p-500;
      const Point &a = corners_[i], &b = corners_[j];
      int best = -1;
      double bestDot = 1, bestCross = 0, bestDotTerms = 1, bestCrossTerms = 0;
      for (int m = i + 1; m < j; ++m) {
        const double ux = a.x() - corners_[m].x(), uy = a.y() - corners_[m].y(), vx = b.x() - corners_[m].x(),
                     vy = b.y() - corners_[m].y();
        const double forth = vx * uy, back = vy * ux, cross = forth - back,
                     crossTerms = std::abs(forth) + std::abs(back) + kVanishing;
        if (!(std::abs(cross) > kCross * crossTerms)) {
          if (orientation(i, m, j) <= 0) continue;
        } else if (cross < 0) {
          continue;
        }
        const double dx = ux * vx, dy = uy * vy, dot = dx + dy,
                     dotTerms = std::abs(dx) + std::abs(dy) + kVanishing;
        const double gap = bestDot * cross - dot * bestCross,
                     gapTerms = bestDotTerms * crossTerms + dotTerms * bestCrossTerms;
        bool isBetter = gap > 0;
        if (!(std::abs(gap) > kGap * gapTerms)) {
          const int inside = best < 0 ? 1 : inCircle(i, best, j, m);
          isBetter = inside > 0 || (inside == 0 && prefersLater(best, m));
        }
        best = isBetter ? m : best;
        bestDot = isBetter ? dot : bestDot;
        bestCross = isBetter ? cross : bestCross;
        bestDotTerms = isBetter ? dotTerms : bestDotTerms;
        bestCrossTerms = isBetter ? crossTerms : bestCrossTerms;
      }
      return best;
    }

   private:
    Point apex_;
    std::array<Point, kMaxHoleCorners> corners_;
  };

 private:
  std::span<const Vec3> points_;
  double xStretch_;
};

}  // namespace arete
