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

/// Vertical error of triangles over scattered points, exactly. Every triangle slot of the live mesh keeps the
/// removed points that it covers; a removal shares the points of its star out among the triangles of the
/// floor (exact predicates; a point on an edge goes to either side, whose planes agree there).
class PointError {
 public:
  static constexpr std::uint32_t kNone = LiveMesh::kNone;

  /// Keeps the rings of the finest triangulation, in which bounds along edges are found. `points`: those of
  /// the plan, with their heights.
  PointError(const PointPlan& plan, std::span<const Vec3> points, const LiveMesh& finest)
      : plan_(plan), points_(points), finest_(finest), head_(finest.triangles.size()), next_(points.size()) {
    std::ranges::fill(head_, kNone);
  }

  const Vec3& position(std::uint32_t point) const { return points_[point]; }
  [[gnu::always_inline]] void prefetch(std::uint32_t point) const {
    __builtin_prefetch(points_.data() + point);
  }
  [[gnu::always_inline]] void prefetch(const Star& star) const {
    for (int i = 0; i < star.triangleCount; ++i) __builtin_prefetch(&head_[star.slot(i)]);
    for (const std::uint32_t u : star.linkView()) finest_.prefetch(u);
  }
  /// RasterError knows a rule for the finest triangulation; for points there is none.
  double costInFinest(std::uint32_t, std::array<std::uint32_t, 3>&) const { return -1; }
  double boundInFinest(std::uint32_t) const { return -1; }
  /// See RasterError. Of points the levels are where a build takes most memory.
  static constexpr double kLeastLive = 0.75;
  /// The live mesh has moved its triangles (LiveMesh::compact): their points move with them.
  void compact(const SlotMap& newSlot);

  /// The triangles of one hole, named by corners of its link, against the points of the star and its apex.
  /// One at a time in each thread: they share the arrays that points are gathered into.
  class Hole {
   public:
    Hole(PointError& errors, const Star& star, std::uint32_t apex)
        : errors_(errors), star_(star), apex_(apex), polygon_(errors.plan_, apex, star.linkView()) {}
    double maximum(int i, int j, int m, double limit) const;
    double maximum(int i, int j, int m, double limit, SignedBound& bound) const;
    const PointPlan::Polygon& polygon() const { return polygon_; }
    int orientationToApex(int i, int j) const { return polygon_.orientationToApex(i, j); }
    template <class PrefersLater>
    int third(int i, int j, const PrefersLater& prefersLater) const {
      return polygon_.third(i, j, prefersLater);
    }
    /// Where corner i lies from the apex, in the metric of the plan, and by how much it is higher.
    Vec3 fromApex(int i) const;
    /// Corner i, and the apex, on the plan and with their heights.
    Vec3 position(int i) const { return errors_.position(star_.link[i]); }
    Vec3 apexPosition() const { return errors_.position(apex_); }
    /// |z - plane| at the apex, of a triangle over it.
    double apexError(int i, int j, int m) const;
    SignedBound alongEdge(int i, int j) const { return errors_.alongEdge(star_.link[i], star_.link[j]); }
    /// See RasterError. The domain of points is their convex hull.
    bool isUnconstrained() const { return true; }
    void settle(const HoleTriangulation& floor);

   private:
    const ConflictLists& below() const;
    ConflictLists::Triangle triangle(int i, int j, int m) const;
    bool isCovered(const ConflictLists::Found& found, int i, int j, int m) const;

    PointError& errors_;
    const Star& star_;
    std::uint32_t apex_;
    const PointPlan::Polygon polygon_;
    mutable const ConflictLists* below_ =
        nullptr;  // gathered when first asked for: half of the looks never do
  };

  /// Signed difference between the segment a-b and the finest triangulation where it crosses its edges. A
  /// walk through the triangles it meets.
  SignedBound alongEdge(std::uint32_t a, std::uint32_t b) const;

 private:
  bool covers(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const;
  double difference(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const;
  double differenceOnLine(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const;

  const PointPlan& plan_;
  std::span<const Vec3> points_;
  const VertexRings finest_;
  PagedArray<std::uint32_t> head_;           // per triangle slot: its first point
  UninitializedVector<std::uint32_t> next_;  // per point that a triangle has
};

}  // namespace arete
