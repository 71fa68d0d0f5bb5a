// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a removal costs: the largest error of the floor that would fill the hole.
//
// A look triangulates the hole, first where the vertex itself stands, and finds the error; it gives up as
// soon as that is known to be well beyond the threshold and keeps what was found as a lower bound. The
// triangle that costs most is remembered: while its corners stay, so does the bound (vertex_note.h). In the
// finest triangulation of a raster a rule gives the error without a look.
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

  /// How far beyond the threshold a cost is worth knowing exactly: the next levels will ask.
  static constexpr double kLookAhead = 1.2;

  /// Writes down what removing v costs, or costs at least, by the finest triangulation's rule, where it has
  /// one. Precondition: nothing around v has gone.
  void lookInFinest(std::uint32_t v, RemovalRecord& note) const {
    if (s_.options.shape == HoleShape::dataDependent) {
      const double bound = s_.errors.boundInFinest(v);
      if (bound < 0) return;
      note.cost = static_cast<float>(bound);
      note.state = State::atLeast;
      return;
    }
    std::array<std::uint32_t, 3> witness;
    const double cost = s_.errors.costInFinest(v, witness);
    if (cost < 0) return;
    note.cost = static_cast<float>(cost);
    note.setWitness(witness[0], witness[1], witness[2]);
    note.linkSize = 6;
    note.state = State::exact;
  }

  /// Writes down what removing v costs, exactly where that is within threshold * kLookAhead. `star` receives
  /// v's, unless it is larger than any that may go.
  void look(std::uint32_t v, Star& star, double threshold, RemovalRecord& note) const {
    lookAndKeep(v, star, threshold, note, KeepNothing{});
  }
  /// The same, and keeps the floor that the cost is of: where the look was through with it, and knows it.
  /// Precondition: it is empty. What it holds unless the cost is exact means nothing.
  void look(std::uint32_t v, Star& star, double threshold, RemovalRecord& note, MeasuredFloor& floor) const {
    lookAndKeep(v, star, threshold, note, KeepFloor{floor});
  }

 private:
  using State = RemovalRecord::State;
  using Hole = typename Errors::Hole;

  /// What becomes of triangles that a look has measured.
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
      const double error = hole.maximum(i, j, m, limit, bound);
      const auto f = static_cast<std::size_t>(floor.triangulation.size);
      floor.errors[f] = error;
      floor.bounds[f] = bound;
      floor.triangulation.add(i, j, m);
      return error;
    }
    void startAgain() const { floor.clear(); }
  };

  template <class Keep>
  void lookAndKeep(std::uint32_t v, Star& star, double threshold, RemovalRecord& note,
                   const Keep& keep) const {
    const auto most = static_cast<int>(s_.options.maxDegree);
    if (!star.gather(s_.mesh, v, most + 1) || star.triangleCount > most || !s_.isRemovable(star, v)) {
      note.state = State::stuck;
      return;
    }
    note.linkSize = static_cast<std::uint8_t>(star.linkSize);
    const double limit = threshold * kLookAhead;
    const Hole hole(s_.errors, star, v);
    if (s_.options.shape == HoleShape::dataDependent)
      evaluateDataDependent(star, hole, threshold, limit, note);
    else
      lookDelaunay(star, hole, limit, note, keep);
  }

  template <class Keep>
  void lookDelaunay(const Star& star, const Hole& hole, double limit, RemovalRecord& note,
                    const Keep& keep) const {
    const bool isUnconstrained = hole.isUnconstrained();
    double worst = -1;
    /// Whether the triangle leaves the cost within the limit.
    const auto measure = [&](int i, int j, int m, bool isOverApex) {
      double error = isOverApex ? hole.apexError(i, j, m) : 0;
      // No number is no reason to leave a triangle out of the floor.
      if (!(error > limit)) error = keep.measure(hole, i, j, m, limit);
      if (error > worst) {
        worst = error;
        note.setWitness(star.link[i], star.link[j], star.link[m]);
      }
      return worst <= limit;
    };
    const auto conclude = [&] {
      // Beyond the limit is not nothing, or it would be due for ever.
      note.cost = std::max(static_cast<float>(worst), worst > limit ? std::numeric_limits<float>::min() : 0);
      note.state = worst > limit ? State::atLeast : State::exact;
    };
    if (isUnconstrained) {
      if (wrapHoleFromApex(star.linkSize, hole, measure)) return conclude();
      worst = -1;
      keep.startAgain();
    }
    const HoleTriangulation floor = triangulateHoleDelaunay(star.linkSize, hole, isUnconstrained);
    if (floor.size == 0) {
      note.state = limit >= s_.heightRange ? State::stuck : State::atLeast;
      note.cost = static_cast<float>(limit * (1 + 1e-6));
      return;
    }
    for (const auto& t : floor.view())
      if (!measure(t[0], t[1], t[2], false)) break;
    conclude();
  }

  void evaluateDataDependent(const Star& star, const Hole& hole, double threshold, double limit,
                             RemovalRecord& note) const {
    // No error exceeds the range of the heights: a hole that the aspect bound alone leaves open takes any
    // shape then, Delaunay's.
    const bool isAnyShapeWelcome = limit >= s_.heightRange;
    DataDependentSearch search(star.linkSize, hole, s_.options.minimumAspect);
    HoleCost cost = search.cost(isAnyShapeWelcome ? limit : threshold, limit);
    if (!cost.isExact && isAnyShapeWelcome) {
      const HoleTriangulation any = triangulateHoleDelaunay(star.linkSize, hole, false);
      if (any.size == 0) {
        note.state = State::stuck;
        return;
      }
      cost.error = 0;
      for (const auto& t : any.view())
        cost.error = std::max(cost.error, hole.maximum(t[0], t[1], t[2], limit));
      cost.isExact = cost.error <= limit;
    } else if (!cost.isExact) {
      cost.error = std::clamp(cost.error, threshold * (1 + 1e-6), std::max(s_.heightRange, threshold * 2));
    }
    note.cost = static_cast<float>(cost.error);
    note.state = cost.isExact ? State::exact : State::atLeast;
  }

  const SimplifyState<Plan, Errors>& s_;
};

}  // namespace arete
