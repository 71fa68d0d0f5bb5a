// SPDX-License-Identifier: GPL-3.0-or-later
//
// A level that all threads work on together. Its steps:
//
//   collect   Scan the vertices that may be removed for those that are due: their cost is unknown, or at most
//             the threshold (threshold_list.h).
//   evaluate  Find the costs of removing them (cost.h), and keep the floors if they are few (floor_cache.h).
//             Those that cost at most the threshold are the candidates.
//   choose    Take an independent set of the candidates, in the order of their costs (independent_set.h).
//   remove    Rewrite each chosen star, record the modification, update the records of the link (removal.h).
//   sew       Join the new triangles to their neighbours (engine/simplify/removal_batch.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/parallel/loop_threads.h"
#include "engine/parallel/parallel_filter.h"
#include "engine/parallel/stage_clock.h"
#include "engine/simplify/independent_set.h"
#include "engine/simplify/removal_batch.h"
#include "terrain/simplify/cost.h"
#include "terrain/simplify/evaluation_prefetch.h"
#include "terrain/simplify/floor_cache.h"
#include "terrain/simplify/measured_floor.h"
#include "terrain/simplify/removal.h"
#include "terrain/simplify/state.h"
#include "terrain/triangulation/rim.h"

namespace arete {

/// Runs levels on all threads, and owns the lists that they need.
template <class Plan, class Errors>
class LevelWorkers {
 public:
  using State = SimplifyState<Plan, Errors>;

  /// `clock` may be null.
  LevelWorkers(State& state, StageClock* clock)
      : s_(state),
        cost_(state),
        set_(state.mesh, state.records),
        batch_(state.mesh, state.recorder, state.thresholds, state.liveTriangles, clock),
        clock_(clock) {}

  /// A level of all vertices that may be removed.
  /// @param number of the level; different for all levels of a vertex.
  /// @return how many vertices were removed.
  std::size_t levelOfAll(double threshold, std::uint32_t number, MtRecorder::BatchOrder order) {
    {
      const StageClock::Scope stage(clock_, "simplify: collect");
      s_.thresholds.collect(threshold, due_, filter_);
    }
    return level(threshold, number, order);
  }
  /// A level of some of them.
  std::size_t levelOf(std::span<const VertexId> some, double threshold, std::uint32_t number,
                      MtRecorder::BatchOrder order) {
    {
      const StageClock::Scope stage(clock_, "simplify: collect");
      s_.thresholds.collect(some, threshold, due_, filter_);
    }
    return level(threshold, number, order);
  }

 private:
  using RecordState = RemovalRecord::State;

  std::size_t level(double threshold, std::uint32_t number, MtRecorder::BatchOrder order) {
    if (due_.empty()) return 0;
    evaluate(threshold, number);
    choose(number);
    if (chosen_.empty()) return 0;
    remove(order);
    batch_.end(chosen_);
    if (s_.rim != nullptr) closeVoids();
    return chosen_.size();
  }

  /// Reduces `due_` to the candidates: vertices whose removal costs at most the threshold.
  void evaluate(double threshold, std::uint32_t number) {
    const StageClock::Scope stage(clock_, "simplify: evaluate");
    // The cost of the data-dependent shape is found without its floor: the removal finds the floor.
    if (s_.options.shape == HoleShape::delaunay) floors_.begin(due_.size(), s_.thresholds.all().size());
    filter_(due_.size(), shareOf(due_.size(), 128), due_,
            [&](std::size_t begin, std::size_t end, VertexId* to) {
              Star star;
              for (std::size_t i = begin; i != end; ++i) {
                prefetchForEvaluation(s_, due_, i);
                const VertexId v = due_[i];
                RemovalRecord& record = s_.records[v];
                record.settle();
                MeasuredFloor* const floor = floors_.keep(i, s_.thresholds.indexOf(v));
                if (record.state != RecordState::exact) {
                  if (floor != nullptr)
                    cost_.evaluate(v, star, threshold, record, *floor);
                  else
                    cost_.evaluate(v, star, threshold, record);
                  s_.thresholds.set(v, record.nextThreshold());
                }
                if (record.state != RecordState::exact || record.cost > threshold) continue;
                set_.enter(v, number);
                *to++ = v;
              }
              return to;
            });
  }

  void choose(std::uint32_t number) {
    const StageClock::Scope stage(clock_, "simplify: choose");
    if (s_.rim == nullptr) {
      set_.choose(due_, number, chosen_);
    } else {
      Star star;
      set_.chooseInTurn(due_, number, chosen_, [&](VertexId v) {
        star.gather(s_.mesh, v, kMaxHoleCorners);
        const VertexId before = star.link[star.linkSize - 1], after = star.link[0];
        const bool isFill = star.isOpen && s_.plan.orientation(before, v, after) != 0;
        return !isFill || s_.rim->claim(before, after, number);
      });
    }
    linkSizes_.resize(chosen_.size());
    forRanges(LoopThreads::all, chosen_.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) linkSizes_[i] = s_.records[chosen_[i]].linkSize;
    });
  }

  void remove(MtRecorder::BatchOrder order) {
    const StageClock::Scope stage(clock_, "simplify: remove");
    batch_.begin(order, linkSizes_);
    const std::size_t grain = shareOf(chosen_.size(), 64);
    forRanges(LoopThreads::all, chosen_.size(), grain, [&](std::size_t begin, std::size_t end) {
      // The stars of a batch share no triangle, so the next ones can be gathered while others are rewritten,
      // and the recorder's data of their triangles prefetched.
      std::array<Star, kStarsAhead> ahead;
      VertexRemover<Plan, Errors> remover(s_);
      MeasuredFloor unknown;
      const auto gather = [&](std::size_t i) {
        if (i >= end) return;
        Star& star = ahead[i % kStarsAhead];
        star.gather(s_.mesh, chosen_[i], kMaxHoleCorners);
        remover.prefetch(star);
      };
      for (std::size_t i = begin; i < begin + kStarsAhead - 1; ++i) gather(i);
      for (std::size_t i = begin; i != end; ++i) {
        // Not beyond the range: other threads rewrite the stars there.
        prefetchStars(s_.mesh, i, end, [&](std::size_t k) { return chosen_[k]; });
        if (i + kHeightsAhead < end) s_.errors.prefetch(chosen_[i + kHeightsAhead]);
        gather(i + kStarsAhead - 1);
        const Star& star = ahead[i % kStarsAhead];
        batch_.setOpen(i, star.isOpen);
        unknown.clear();
        MeasuredFloor* const kept = floors_.of(s_.thresholds.indexOf(chosen_[i]));
        remover.remove(chosen_[i], star, kept != nullptr ? *kept : unknown, batch_.removal(i),
                       batch_.seams(i));
      }
    });
  }

  void closeVoids() {
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      if (batch_.isOpen(i)) Rim::closeVoid(s_.mesh, batch_.seams(i).back().movedTo);
  }

  /// The grain of a parallel loop over `size` vertices, at most `most`: late levels have few vertices with
  /// wide holes, which all threads share.
  static std::size_t shareOf(std::size_t size, std::size_t most) {
    return std::clamp<std::size_t>(size / 32, 4, most);
  }

  static constexpr std::size_t kStarsAhead = 4;

  State& s_;
  RemovalCost<Plan, Errors> cost_;
  FloorCache floors_;
  IndependentSet set_;
  RemovalBatch batch_;
  StageClock* clock_;

  ParallelFilter<VertexId> filter_;
  std::vector<VertexId> due_;  // vertices to evaluate, then the candidates
  std::vector<VertexId> chosen_;
  std::vector<std::uint8_t> linkSizes_;  // per chosen
};

}  // namespace arete
