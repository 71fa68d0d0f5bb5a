// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cost of a removal: the largest error of the floor that would fill the hole.
//
// An evaluation triangulates the hole, starting with the triangle over the vertex, and finds the errors. It
// stops when the error is known to be well above the threshold, and stores what it has found as a lower
// bound. The corners of the worst triangle are stored as the witness: while they remain, so does the bound
// (removal_record.h). In the finest triangulation of a raster a formula gives the error without an
// evaluation.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "terrain/simplify/measured_floor.h"
#include "terrain/simplify/state.h"
#include "terrain/triangulation/data_dependent_hole.h"
#include "terrain/triangulation/delaunay_hole.h"

namespace arete {

template <class Plan, class Errors>
class RemovalCost {
 public:
  explicit RemovalCost(const SimplifyState<Plan, Errors>& state) : s_(state) {}

  /// Costs are found exactly up to the threshold times this: the next levels use them.
  static constexpr double kExactUpTo = 1.2;

  /// Stores the cost of removing v, or a lower bound, by the formula for the finest triangulation; leaves the
  /// record as it is if there is none. Precondition: no neighbour of v is removed.
  void evaluateInFinest(VertexId v, RemovalRecord& record) const {
    if (s_.options.shape == HoleShape::dataDependent) {
      const double bound = s_.errors.boundInFinest(v);
      if (bound < 0) return;
      record.cost = static_cast<float>(bound);
      record.state = State::atLeast;
      return;
    }
    std::array<VertexId, 3> witness;
    const double cost = s_.errors.costInFinest(v, witness);
    if (cost < 0) return;
    record.cost = static_cast<float>(cost);
    record.setWitness(witness[0], witness[1], witness[2]);
    record.linkSize = 6;
    record.state = State::exact;
  }

  /// Stores the cost of removing v in its record, exactly if it is at most threshold * kExactUpTo.
  /// @param star receives the star of v, unless its link is too large for a removal.
  void evaluate(VertexId v, Star& star, double threshold, RemovalRecord& record) const {
    evaluateAndKeep(v, star, threshold, record, KeepNothing{});
  }
  /// The same; `floor` receives the floor whose error the cost is, if the evaluation finished and has one.
  /// Undefined unless the cost is exact. Precondition: `floor` is empty.
  void evaluate(VertexId v, Star& star, double threshold, RemovalRecord& record, MeasuredFloor& floor) const {
    evaluateAndKeep(v, star, threshold, record, KeepFloor{floor});
  }

 private:
  using State = RemovalRecord::State;
  using Hole = typename Errors::Hole;

  // What an evaluation does with the triangles that it measures.
  struct KeepNothing {
    double measure(const Hole& hole, int i, int j, int m, double limit) const {
      return hole.maximum(i, j, m, limit);
    }
    void startAgain() const {}
  };
  struct KeepFloor {
    MeasuredFloor& floor;
    double measure(const Hole& hole, int i, int j, int m, double limit) const {
      SignedBound bound;
      double rounding;
      const double error = hole.maximum(i, j, m, limit, bound, rounding);
      const auto f = static_cast<std::size_t>(floor.triangulation.size);
      floor.roundings[f] = rounding;
      floor.errors[f] = error;
      floor.bounds[f] = bound;
      floor.triangulation.add(i, j, m);
      return error;
    }
    void startAgain() const { floor.clear(); }
  };

  template <class Keep>
  void evaluateAndKeep(VertexId v, Star& star, double threshold, RemovalRecord& record,
                       const Keep& keep) const {
    const auto most = static_cast<int>(s_.options.maxDegree);
    if (!star.gather(s_.mesh, v, most + 1) || star.triangleCount > most || !s_.isRemovable(star, v)) {
      record.state = State::stuck;
      return;
    }
    record.linkSize = static_cast<std::uint8_t>(star.linkSize);
    const double limit = threshold * kExactUpTo;
    const Hole hole(s_.errors, star, v);
    if (s_.options.shape == HoleShape::dataDependent)
      evaluateDataDependent(star, hole, threshold, limit, record);
    else
      evaluateDelaunay(star, hole, limit, record, keep);
  }

  template <class Keep>
  void evaluateDelaunay(const Star& star, const Hole& hole, double limit, RemovalRecord& record,
                        const Keep& keep) const {
    const bool isUnconstrained = hole.isUnconstrained();
    double worst = -1;
    /// Measures a triangle; returns whether the cost is still within the limit.
    const auto measure = [&](int i, int j, int m, bool isOverApex) {
      double error = isOverApex ? hole.apexError(i, j, m) : 0;
      // Written so that a NaN does not leave the triangle out of the floor.
      if (!(error > limit)) error = keep.measure(hole, i, j, m, limit);
      if (error > worst) {
        worst = error;
        record.setWitness(star.link[i], star.link[j], star.link[m]);
      }
      return worst <= limit;
    };
    const auto conclude = [&] {
      // Above a limit of 0 the cost must be above 0, or the vertex would be due in every level.
      record.cost =
          std::max(static_cast<float>(worst), worst > limit ? std::numeric_limits<float>::min() : 0);
      record.state = worst > limit ? State::atLeast : State::exact;
    };
    if (isUnconstrained) {
      if (wrapHoleFromApex(star.linkSize, hole, measure)) return conclude();
      worst = -1;
      keep.startAgain();
    }
    const HoleTriangulation floor = triangulateHoleDelaunay(star.linkSize, hole, isUnconstrained);
    if (floor.size == 0) {
      record.state = limit >= s_.heightRange ? State::stuck : State::atLeast;
      record.cost = static_cast<float>(limit * (1 + 1e-6));
      return;
    }
    for (const auto& t : floor.view())
      if (!measure(t[0], t[1], t[2], false)) break;
    conclude();
  }

  void evaluateDataDependent(const Star& star, const Hole& hole, double threshold, double limit,
                             RemovalRecord& record) const {
    // No error exceeds the range of the heights. So at such a limit only the aspect bound can rule out every
    // triangulation of the hole; the Delaunay triangulation is taken then.
    const bool isAnyShapeTaken = limit >= s_.heightRange;
    DataDependentSearch search(star.linkSize, hole, s_.options.minimumAspect);
    HoleCost cost = search.cost(isAnyShapeTaken ? limit : threshold, limit);
    if (!cost.isExact && isAnyShapeTaken) {
      const HoleTriangulation any = triangulateHoleDelaunay(star.linkSize, hole, false);
      if (any.size == 0) {
        record.state = State::stuck;
        return;
      }
      cost.error = 0;
      for (const auto& t : any.view())
        cost.error = std::max(cost.error, hole.maximum(t[0], t[1], t[2], limit));
      cost.isExact = cost.error <= limit;
    } else if (!cost.isExact) {
      cost.error = std::clamp(cost.error, threshold * (1 + 1e-6), std::max(s_.heightRange, threshold * 2));
    }
    record.cost = static_cast<float>(cost.error);
    record.state = cost.isExact ? State::exact : State::atLeast;
  }

  const SimplifyState<Plan, Errors>& s_;
};

}  // namespace arete
