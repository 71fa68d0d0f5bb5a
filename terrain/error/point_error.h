// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "engine/memory/paged_array.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/simplify/live_mesh.h"
#include "terrain/error/conflict_lists.h"
#include "terrain/error/signed_bound.h"
#include "terrain/triangulation/point_plan.h"
#include "terrain/triangulation/vertex_rings.h"

namespace arete {

/// The exact vertical error of triangles over scattered points. Every triangle slot of the live mesh has a
/// conflict list [ClarksonShor1989] of the removed points that it covers. A removal distributes the points of
/// its star among the triangles of the floor by exact predicates; a point on an edge goes to one of the two
/// sides, whose planes agree there; alongEdge() finds it for the other side. A point has the number of
/// its vertex.
class PointError {
 public:
  /// See RasterError: points on an edge are with one of its triangles.
  static constexpr bool kCoversEdges = false;

  /// Refers to `plan` and `points`; copies the vertex rings of `finest`, which alongEdge() walks. O(points).
  /// @param points  those of the plan, with their heights
  /// @param finest  the finest triangulation of the points
  PointError(const PointPlan& plan, std::span<const Vec3> points, const LiveMesh& finest)
      : plan_(plan), points_(points), finest_(finest), head_(finest.triangles.size()), next_(points.size()) {
    std::ranges::fill(head_, VertexId());
  }

  const Vec3& position(VertexId point) const { return points_[point.index()]; }
  [[gnu::always_inline]] void prefetch(VertexId point) const {
    __builtin_prefetch(points_.data() + point.index());
  }
  [[gnu::always_inline]] void prefetch(const Star& star) const {
    for (int i = 0; i < star.triangleCount; ++i) __builtin_prefetch(&head_[star.slot(i)]);
    for (const VertexId u : star.linkView()) finest_.prefetch(u);
  }
  /// See RasterError. -1: points have no closed form in the finest triangulation.
  double costInFinest(VertexId, std::array<VertexId, 3>&) const { return -1; }
  double boundInFinest(VertexId) const { return -1; }
  /// See RasterError. A build of points uses most memory in the levels of removals, so it compacts sooner.
  static constexpr double kLeastLive = 0.75;
  /// Moves the conflict lists with their triangles after LiveMesh::compact(). O(live slots).
  void compact(const SlotMap& newSlot);

  /// The hole that a removed vertex (the apex) leaves: geometry and errors of the triangles that may fill it,
  /// over the apex and the points that its star covers. Triangles are given by the indices of their corners
  /// in the apex's link. At most one exists per thread at a time: all share the thread's arrays.
  class Hole {
   public:
    Hole(PointError& errors, const Star& star, VertexId apex)
        : errors_(errors), star_(star), apex_(apex), polygon_(errors.plan_, apex, star.linkView()) {}
    /// See RasterError::maximum().
    double maximum(int i, int j, int m, double limit) const;
    double maximum(int i, int j, int m, double limit, SignedBound& bound, double& rounding) const;
    double maximum(int i, int j, int m, double limit, SignedBound& bound) const {
      double rounding;
      return maximum(i, j, m, limit, bound, rounding);
    }
    /// Whether the error of the triangle exceeds `bound`. Exact arithmetic decides points near it.
    bool isAbove(int i, int j, int m, double error, double rounding, double bound) const;
    const PointPlan::Polygon& polygon() const { return polygon_; }
    int orientationToApex(int i, int j) const { return polygon_.orientationToApex(i, j); }
    template <class PrefersLater>
    int third(int i, int j, const PrefersLater& prefersLater) const {
      return polygon_.third(i, j, prefersLater);
    }
    /// Corner i relative to the apex: x and y in the plan's metric, z in the vertical unit.
    Vec3 fromApex(int i) const;
    /// Plan position and height of corner i, and of the apex.
    Vec3 position(int i) const { return errors_.position(star_.link[i]); }
    Vec3 apexPosition() const { return errors_.position(apex_); }
    /// |z - plane| at the apex. Precondition: the triangle covers the apex.
    double apexError(int i, int j, int m) const;
    EdgeDifference alongEdge(int i, int j) const { return errors_.alongEdge(star_.link[i], star_.link[j]); }
    /// Whether the error at a point on the edge exceeds `bound`, exactly.
    bool isAboveOnEdge(int i, int j, double bound) const {
      return errors_.isAboveOnEdge(star_.link[i], star_.link[j], bound);
    }
    /// See RasterError. Always true: the domain of points is their convex hull.
    bool isUnconstrained() const { return true; }
    /// Distributes the star's points and the apex among the triangles of the floor that replaces the star.
    void settle(const HoleTriangulation& floor);

   private:
    const ConflictLists& conflicts() const;
    ConflictLists::Triangle triangle(int i, int j, int m) const;
    bool isCovered(const ConflictLists::Found& found, int i, int j, int m) const;

    PointError& errors_;
    const Star& star_;
    VertexId apex_;
    const PointPlan::Polygon polygon_;
    mutable const ConflictLists* conflicts_ =
        nullptr;  // built on first use: half of the evaluations need none
  };

  /// Bounds of the signed difference between the segment a-b and the finest triangulation at the points where
  /// the segment crosses its edges. Walks through the triangles that the segment meets: O(their number).
  EdgeDifference alongEdge(VertexId a, VertexId b) const;
  bool isAboveOnEdge(VertexId a, VertexId b, double bound) const;

 private:
  /// @param visit  called with every point on the segment, but for its ends
  template <class Visit>
  EdgeDifference alongEdge(VertexId a, VertexId b, const Visit& visit) const;
  bool covers(VertexId a, VertexId b, VertexId c, VertexId p) const;
  struct Difference {
    double value;     ///< z of the plane minus z of the point
    double rounding;  ///< bounds the rounding error of `value`
  };
  Difference difference(VertexId a, VertexId b, VertexId c, VertexId p) const;
  double differenceOnLine(VertexId a, VertexId b, VertexId c, VertexId p) const;

  const PointPlan& plan_;
  std::span<const Vec3> points_;
  const VertexRings finest_;
  IdArray<SlotId, PagedArray<VertexId>> head_;  // the first point of the conflict list of a triangle
  IdArray<VertexId, UninitializedVector<VertexId>>
      next_;  // of a point in a list: the next one of the triangle
};

}  // namespace arete
