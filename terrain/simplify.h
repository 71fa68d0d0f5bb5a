// SPDX-License-Identifier: GPL-3.0-or-later
//
// The build of de Berg and Dobrindt (1995): repeat { choose an independent set of removable vertices; remove
// each; retriangulate its hole; record the modification } until nothing is removable. A level goes through
// these steps:
//
//   collect   Look through those that may go for whom the level concerns: those of whom too little is known,
//             and those under the threshold (waiting_list.h).
//   evaluate  Triangulate the hole that such a vertex would leave, first where the vertex itself stands, and
//             find the error; give up as soon as it is known to be well beyond the threshold and keep what
//             was found as a lower bound. The triangle that costs most is remembered: while its corners stay,
//             so does the bound (vertex_note.h). In the finest triangulation of a raster a rule gives the
//             error.
//   choose    The vertices under the threshold, in order of their error, each unless a neighbour was chosen
//             before it (independent_set.h).
//   remove    Rewrite each chosen star, record the modification, tell the link.
//   sew       Join the new triangles to their neighbours.
//
// Then the threshold grows by a constant ratio: cheap removals go first everywhere, which is what keeps the
// cuts at any error small (DESIGN: without thresholds the same bound takes 1.9 times as many triangles).
//
// Every step is parallel over vertices: stars of chosen vertices share no triangle. What is chosen depends on
// the errors alone (then on a bijective hash of the vertex), so every level, and hence the whole MT, is the
// same for any number of threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/mt_recorder.h"
#include "engine/parallel_filter.h"
#include "engine/result.h"
#include "engine/run_context.h"
#include "terrain/build_checks.h"
#include "terrain/build_options.h"
#include "terrain/hole.h"
#include "terrain/hole_fidelity.h"
#include "terrain/independent_set.h"
#include "terrain/live_mesh.h"
#include "terrain/measured_floor.h"
#include "terrain/rim.h"
#include "terrain/signed_bound.h"
#include "terrain/star_prefetch.h"
#include "terrain/vertex_note.h"
#include "terrain/waiting_list.h"

namespace arete {

/// What the levels leave: the root.
struct SimplifiedRoot {
  std::vector<std::uint32_t> vertices;
  std::vector<SurvivingTriangle> triangles;
  std::uint32_t levels = 0;
};

/// Plan: LatticePlan or PointPlan. Errors: RasterError or PointError, see there for the interface:
///   Hole hole(star, apex)                        what the hole's triangles are measured against
///   hole.fromApex(i)                             where a corner lies from the apex
///   hole.maximum(i, j, m, limit)                 error of the triangle of three corners
///   hole.maximum(i, j, m, bound)                 the same, with the signed difference at the samples
///   hole.position(i), hole.apexPosition()        corners and apex on the plan, with their heights
///   hole.alongEdge(i, j)                         signed difference along an edge
///   hole.settle(floor)                           after a refill: samples find their new triangles
template <class Plan, class Errors>
class Simplifier {
 public:
  static constexpr std::uint32_t kNone = LiveMesh::kNone;

  Simplifier(LiveMesh& mesh, const Plan& plan, Errors& errors, MtRecorder& recorder, Rim* rim,
             const BuildOptions& options, const RunContext& context)
      : mesh_(mesh),
        plan_(plan),
        errors_(errors),
        recorder_(recorder),
        rim_(rim),
        options_(options),
        context_(context),
        set_(mesh, notes_) {}

  /// Removes what can be removed. `isFixed`: per vertex, not 0 = stays.
  Result<SimplifiedRoot> run(const std::vector<std::uint8_t>& isFixed, const MetricFrame& metric) {
    const auto vertexCount = static_cast<std::uint32_t>(mesh_.vertexHalfedge.size());
    // Vertices are visited in the order of their triangles in memory, which is that of the ground.
    std::vector<std::uint32_t> removable = mesh_.verticesInOrder(isFixed);
    notes_.assign(vertexCount, {});
    liveTriangles_ = mesh_.triangles.size();
    metric_ = metric;

    const auto removableAtStart = static_cast<double>(std::max<std::size_t>(removable.size(), 1));
    waiting_.assign(std::move(removable), vertexCount);
    evaluateFinest();

    // Below a ten-millionth of the relief all errors are alike: noise of the arithmetic must not make levels.
    double threshold = heightRange_ * 1e-7;
    std::uint32_t level = 0;
    while (!waiting_.empty()) {
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "the build was interrupted");
      ++level;
      collectDue(threshold);
      evaluate(threshold, level);
      choose(level);
      if (chosen_.empty()) {
        const double pending = waiting_.least();
        if (!(pending < std::numeric_limits<double>::infinity())) break;
        threshold = std::max(threshold * options_.thresholdRatio, pending);
        continue;
      }
      removeChosen();
      // Most levels are late and short: progress by what is left, on the scale of vertices.
      context_.report("simplify", 1.0 - double(waiting_.size()) / removableAtStart);
      threshold *= options_.thresholdRatio;
    }

    context_.report("simplify", 1);
    SimplifiedRoot root;
    root.levels = level;
    std::vector<std::uint8_t> seen(vertexCount, 0);
    for (const LiveMesh::Triangle& triangle : mesh_.triangles) {
      if (triangle.isDead()) continue;
      root.triangles.push_back({triangle.birth, triangle.corners});
      for (const std::uint32_t v : triangle.corners) seen[v] = 1;
    }
    for (std::uint32_t v = 0; v < vertexCount; ++v)
      if (seen[v]) root.vertices.push_back(v);
    return root;
  }

 private:
  using State = VertexNote::State;

  /// The floor of a vertex whose cost is known exactly.
  void fill(std::uint32_t v, const Star& star, const typename Errors::Hole& hole,
            MeasuredFloor& floor) const {
    if (options_.shape == HoleShape::fidelity) {
      // The cost was found from other corners, in other roundings, and is kept in few digits.
      const double limit =
          std::nextafter(notes_[v].cost, std::numeric_limits<float>::infinity()) + roundingSlack_;
      fillShortest(star.linkSize, hole, options_.minimumAspect, limit, floor);
      if (floor.triangulation.size > 0) return;
    }
    floor.triangulation = triangulateHoleDelaunay(star.linkSize, hole, isDomainConvex_);
    measure(hole, floor);
  }

  /// Whether v may go at all, as its star stands. On a border: only from a straight one, or as the rim
  /// allows.
  bool isRemovable(const Star& star, std::uint32_t v) const {
    if (!star.isOpen) return star.linkSize >= 3;
    if (star.linkSize < 3) return false;
    const std::uint32_t after = star.link[0], before = star.link[star.linkSize - 1];
    const int turn = plan_.orientation(before, v, after);
    if (turn == 0) return true;
    return turn < 0 && rim_ != nullptr && rim_->mayFill(before, v, after);
  }

  bool isFill(const Star& star, std::uint32_t v) const {
    return star.isOpen && plan_.orientation(star.link[star.linkSize - 1], v, star.link[0]) != 0;
  }

  /// Finds whom the level concerns: vertices of whom too little is known, and those under the threshold. In
  /// the order of memory.
  void collectDue(double threshold) {
    const StageClock::Scope stage(context_.clock, "simplify: collect");
    waiting_.collect(threshold, due_);
  }

  /// What removing a vertex costs, or costs at least, where its star is as the finest triangulation made it,
  /// found without a look at the mesh where the errors know a rule.
  void evaluateFinest() {
    const StageClock::Scope stage(context_.clock, "simplify: evaluate");
    waiting_.collect(WaitingList::kNow, due_);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, due_.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const std::uint32_t v = due_[i];
        VertexNote& note = notes_[v];
        if (options_.shape == HoleShape::fidelity) {
          const double bound = errors_.boundInFinest(v);
          if (bound < 0) continue;
          note.cost = static_cast<float>(bound);
          note.state = State::atLeast;
          waiting_.set(v, note.cost);
          continue;
        }
        std::array<std::uint32_t, 3> witness;
        const double cost = errors_.costInFinest(v, witness);
        if (cost < 0) continue;
        note.cost = static_cast<float>(cost);
        note.setWitness(witness[0], witness[1], witness[2]);
        note.linkSize = 6;
        note.state = State::exact;
        waiting_.set(v, note.cost);
      }
    });
  }

  /// Leaves in `due_` the candidates: vertices whose removal costs no more than the threshold.
  void evaluate(double threshold, std::uint32_t level) {
    const StageClock::Scope stage(context_.clock, "simplify: evaluate");
    // Worth knowing exactly a little beyond the threshold: the next levels will ask.
    const double limit = threshold * lookAhead();
    candidates_(due_.size(), 128, due_, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
      Star star;
      for (std::size_t i = begin; i != end; ++i) {
        prefetchStars<StarReach::neighbours>(mesh_, i, due_.size(), [&](std::size_t k) { return due_[k]; });
        if (i + kHeightsAhead < due_.size()) {
          errors_.prefetch(due_[i + kHeightsAhead]);
          __builtin_prefetch(&notes_[due_[i + kHeightsAhead]], 1);
          waiting_.prefetch(due_[i + kHeightsAhead]);
        }
        const std::uint32_t v = due_[i];
        VertexNote& note = notes_[v];
        note.settle();
        if (note.state != State::exact) {
          evaluate(v, note, star, threshold, limit);
          waiting_.set(v, note.state == State::stuck ? WaitingList::kNever : note.cost);
        }
        if (note.state == State::exact && note.cost <= threshold) {
          set_.enter(v, level);
          *to++ = v;
        }
      }
      return to;
    });
  }

  void evaluate(std::uint32_t v, VertexNote& note, Star& star, double threshold, double limit) const {
    if (!star.gather(mesh_, v, static_cast<int>(options_.maxDegree) + 1) ||
        star.triangleCount > static_cast<int>(options_.maxDegree) || !isRemovable(star, v)) {
      note.state = State::stuck;
      return;
    }
    note.linkSize = static_cast<std::uint8_t>(star.linkSize);
    const typename Errors::Hole hole(errors_, star, v);
    if (options_.shape == HoleShape::fidelity) {
      evaluateFidelity(note, star, hole, threshold, limit);
      return;
    }
    double worst = -1;
    /// Whether the triangle leaves the cost within the limit.
    const auto look = [&](int i, int j, int m, bool isOverApex) {
      double error = isOverApex ? hole.apexError(i, j, m) : 0;
      if (error <= limit) error = hole.maximum(i, j, m, limit);
      if (error > worst) {
        worst = error;
        note.setWitness(star.link[i], star.link[j], star.link[m]);
      }
      return worst <= limit;
    };
    const auto conclude = [&] {
      note.cost = static_cast<float>(worst);
      note.state = worst > limit ? State::atLeast : State::exact;
    };
    if (isDomainConvex_) {
      if (wrapHoleFromApex(star.linkSize, hole, look)) return conclude();
      worst = -1;
    }
    const HoleTriangulation floor = triangulateHoleDelaunay(star.linkSize, hole, isDomainConvex_);
    if (floor.size == 0) {
      note.state = limit >= heightRange_ ? State::stuck : State::atLeast;
      note.cost = static_cast<float>(limit * (1 + 1e-6));
      return;
    }
    for (const auto& t : floor.view())
      if (!look(t[0], t[1], t[2], false)) break;
    conclude();
  }

  void evaluateFidelity(VertexNote& note, const Star& star, const typename Errors::Hole& hole,
                        double threshold, double limit) const {
    // No error exceeds the range of the heights: a hole that the aspect bound alone leaves open takes any
    // shape then, Delaunay's.
    const bool isAnyShapeWelcome = limit >= heightRange_;
    FidelitySearch search(star.linkSize, hole, options_.minimumAspect);
    HoleCost cost = search.cost(isAnyShapeWelcome ? limit : threshold, limit);
    if (!cost.isExact && isAnyShapeWelcome) {
      const HoleTriangulation any = triangulateHoleDelaunay(star.linkSize, hole, isDomainConvex_);
      if (any.size == 0) {
        note.state = State::stuck;
        return;
      }
      cost.error = 0;
      for (const auto& t : any.view())
        cost.error = std::max(cost.error, hole.maximum(t[0], t[1], t[2], limit));
      cost.isExact = cost.error <= limit;
    } else if (!cost.isExact) {
      cost.error = std::clamp(cost.error, threshold * (1 + 1e-6), std::max(heightRange_, threshold * 2));
    }
    note.cost = static_cast<float>(cost.error);
    note.state = cost.isExact ? State::exact : State::atLeast;
  }

  void choose(std::uint32_t level) {
    const StageClock::Scope stage(context_.clock, "simplify: choose");
    if (rim_ == nullptr) {
      set_.choose(due_, level, chosen_);
    } else {
      Star star;
      set_.chooseInTurn(due_, level, chosen_, [&](std::uint32_t v) {
        star.gather(mesh_, v, kMaxHoleCorners);
        return !isFill(star, v) || rim_->claim(star.link[star.linkSize - 1], star.link[0], level);
      });
    }
    linkSizes_.resize(chosen_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chosen_.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) linkSizes_[i] = notes_[chosen_[i]].linkSize;
    });
  }

  void removeChosen() {
    const std::uint32_t first = recorder_.beginBatch(linkSizes_);
    const std::uint32_t firstSlot = recorder_.firstSlot(first);
    const auto seamsOf = [&](std::uint32_t removal) {
      const std::uint32_t from = recorder_.firstSlot(removal);
      return std::span(seams_).subspan(from - firstSlot, recorder_.firstSlot(removal + 1) - from);
    };
    seams_.resize(recorder_.firstSlot(recorder_.removalCount()) - firstSlot);
    isOpen_.resize(chosen_.size());
    {
      const StageClock::Scope stage(context_.clock, "simplify: remove");
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chosen_.size(), 64), [&](const auto& range) {
        // The stars of a batch share no triangle, so the next ones can be gathered while others are
        // rewritten, and what the recorder will ask of their children can be on its way.
        std::array<Star, kStarsAhead> ahead;
        RemovalScratch scratch;
        const auto gather = [&](std::size_t i) {
          if (i >= range.end()) return;
          Star& star = ahead[i % kStarsAhead];
          star.gather(mesh_, chosen_[i], kMaxHoleCorners);
          for (int k = 0; k < star.triangleCount; ++k)
            recorder_.prefetch(mesh_.triangles[star.triangle(k)].bearer,
                               mesh_.triangles[star.triangle(k)].birth);
          for (int k = 0; k < star.linkSize; ++k) {
            __builtin_prefetch(&notes_[star.link[k]], 1);
            waiting_.prefetch(star.link[k]);
            __builtin_prefetch(&mesh_.vertexHalfedge[star.link[k]], 1);
          }
          errors_.prefetch(star);
        };
        for (std::size_t i = range.begin(); i < range.begin() + kStarsAhead - 1; ++i) gather(i);
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          // Not beyond the range: the stars there are being rewritten.
          prefetchStars<StarReach::own>(mesh_, i, range.end(), [&](std::size_t k) { return chosen_[k]; });
          if (i + kHeightsAhead < range.end()) errors_.prefetch(chosen_[i + kHeightsAhead]);
          gather(i + kStarsAhead - 1);
          const Star& star = ahead[i % kStarsAhead];
          const std::uint32_t removal = first + static_cast<std::uint32_t>(i);
          isOpen_[i] = star.isOpen;
          remove(chosen_[i], star, removal, seamsOf(removal), scratch);
        }
      });
    }
    const StageClock::Scope stage(context_.clock, "simplify: sew");
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, seams_.size(), 2048), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        if (i + kSeamsAhead < range.end() && seams_[i + kSeamsAhead].beyond != kNone)
          __builtin_prefetch(&mesh_.triangles[LiveMesh::triangleOf(seams_[i + kSeamsAhead].beyond)], 1);
        sew(mesh_, seams_[i], first, seamsOf);
      }
    });
    if (rim_ != nullptr)
      for (std::size_t i = 0; i < chosen_.size(); ++i)
        if (isOpen_[i]) Rim::closeVoid(mesh_, seamsOf(first + static_cast<std::uint32_t>(i)).back().movedTo);
    waiting_.remove(chosen_);
    // A removal leaves two slots dead, one on a border.
    for (const std::uint8_t isOpen : isOpen_) liveTriangles_ -= isOpen ? 1 : 2;
    if (liveTriangles_ < mesh_.triangles.size() / 2) {
      errors_.compact(mesh_.compact());
    }
  }

  /// What a removal works out and hands on: kept for the next one, as clearing it takes longer than many a
  /// step.
  struct RemovalScratch {
    MeasuredFloor filled;
    std::array<FloorCodes, kMaxHoleCorners> codes;
    std::array<std::uint32_t, kMaxHoleCorners> ceiling, bearer;
    std::array<Vec3, kMaxHoleCorners + 1> positions;
  };

  void remove(std::uint32_t v, const Star& star, std::uint32_t removal, std::span<Seam> seams,
              RemovalScratch& scratch) {
    auto& [filled, codes, ceiling, bearer, positions] = scratch;
    typename Errors::Hole hole(errors_, star, v);
    fill(v, star, hole, filled);
    const HoleTriangulation& floor = filled.triangulation;
    const int corners = star.linkSize;

    const FloorJoins joins(floor);

    // Bounds: samples inside each triangle, and its edges.
    for (int d = 0; d < joins.diagonalCount; ++d) {
      const FloorJoins::Diagonal& diagonal = joins.diagonals[d];
      const SignedBound bound = hole.alongEdge(diagonal.from, diagonal.to);
      filled.bounds[diagonal.forth.triangle].include(bound);
      filled.bounds[diagonal.back.triangle].include(bound);
    }
    const OutwardScale& scale = recorder_.scale();
    const auto encode = [&](double bound) { return scale.encode(outward(bound)); };
    for (int f = 0; f < floor.size; ++f)
      codes[f] = {scale.encode(withoutRounding(filled.errors[f])), encode(filled.bounds[f].below),
                  encode(filled.bounds[f].above)};
    // The bounds of the star's triangles hold for their edges: most often the rim adds nothing to those of
    // the floor, and need not be looked at.
    for (int i = 0; i < corners; ++i) {
      FloorCodes& own = codes[joins.rim[i].triangle];
      if (i < star.triangleCount) {
        const FloorCodes beside = recorder_.codes(mesh_.triangles[star.triangle(i)].birth);
        if ((beside.below <= own.below) & (beside.above <= own.above)) continue;
      }
      const SignedBound bound = hole.alongEdge(i, i + 1 < corners ? i + 1 : 0);
      own.below = std::max(own.below, encode(bound.below));
      own.above = std::max(own.above, encode(bound.above));
    }

    for (int i = 0; i < star.triangleCount; ++i) {
      ceiling[i] = mesh_.triangles[star.triangle(i)].birth;
      bearer[i] = mesh_.triangles[star.triangle(i)].bearer;
    }
    for (int i = 0; i < corners; ++i) positions[i] = metric_.toMetric(hole.position(i));
    positions[corners] = metric_.toMetric(hole.apexPosition());

    const auto size = [](int n) { return static_cast<std::size_t>(n); };
    VertexRemoval what;
    what.vertex = v;
    what.link = star.linkView();
    what.isOpen = star.isOpen;
    what.metricPositions = {positions.data(), size(corners + 1)};
    what.ceiling = {ceiling.data(), size(star.triangleCount)};
    what.ceilingBearer = {bearer.data(), size(star.triangleCount)};
    what.floor = {codes.data(), size(floor.size)};
    recorder_.record(removal, what);

    refill(mesh_, star, floor, joins, recorder_.firstBirth(removal), removal, seams);
    hole.settle(floor);

    // Two stars can share a link vertex: both write the same value. What a neighbour must forget cannot be
    // foreseen, so it is told where to write instead of whether.
    const bool isWitnessUnknown = options_.shape != HoleShape::delaunay || star.isOpen;
    for (int i = 0; i < corners; ++i) {
      VertexNote& note = notes_[star.link[i]];
      const bool isWitnessGone = isWitnessUnknown | note.isWitnessedBy(v);
      std::atomic_ref(note.isTouched).store(1, std::memory_order_relaxed);
      std::atomic_ref(isWitnessGone ? note.isWitnessGone : note.isTouched)
          .store(1, std::memory_order_relaxed);
      waiting_.wakeIf(isWitnessGone | (note.state == State::stuck), star.link[i]);
    }
    mesh_.vertexHalfedge[v] = kNone;
  }

  /// Bounds go beyond the rounding of the scan itself: they prove things.
  double outward(double x) const { return x == 0 ? 0 : x * (1 + 1e-9) + roundingSlack_; }
  /// An error that is a code but for the last bits of its arithmetic is that code: integer heights make
  /// errors of exactly 1 common, and a tolerance of 1 must take them. The bits are far below what "equal to
  /// the bound" allows.
  double withoutRounding(double x) const { return std::fmax(0.0, x - roundingSlack_); }

 public:
  /// Heights span [low, high]; the domain has no rims but its convex border.
  void setDomain(double low, double high, bool isConvex) {
    isDomainConvex_ = isConvex;
    roundingSlack_ = roundingSlack(low, high);
    heightRange_ = high - low;
  }

 private:
  double lookAhead() const { return options_.shape == HoleShape::fidelity ? 1.2 : 1.5; }

  static constexpr std::size_t kStarsAhead = 4, kHeightsAhead = 12, kSeamsAhead = 16;

  LiveMesh& mesh_;
  const Plan& plan_;
  Errors& errors_;
  MtRecorder& recorder_;
  Rim* rim_;
  const BuildOptions& options_;
  const RunContext& context_;
  MetricFrame metric_;
  double roundingSlack_ = 0;  // what the arithmetic of a plane can be off by
  double heightRange_ = 0;
  bool isDomainConvex_ = false;

  WaitingList waiting_;
  std::vector<VertexNote> notes_;  // per vertex
  IndependentSet set_;
  std::vector<std::uint32_t> due_;  // of a level: vertices to look at, then the candidates
  ParallelFilter<std::uint32_t> candidates_;
  std::size_t liveTriangles_ = 0;
  std::vector<std::uint32_t> chosen_;
  std::vector<std::uint8_t> linkSizes_;
  std::vector<std::uint8_t> isOpen_;  // per chosen: whether its star is
  std::vector<Seam> seams_;           // per slot of the batch
};

}  // namespace arete
