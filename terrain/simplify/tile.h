// SPDX-License-Identifier: GPL-3.0-or-later
//
// A level of one tile, on one thread. It collects the vertices that are due, as any level does. Its steps:
//
//   take      Evaluate one vertex after the other and take each that costs at most the threshold. A vertex
//             with a neighbour outside the tile is held instead. A vertex with a neighbour that was taken is
//             skipped without an evaluation, as the neighbour's removal changes its cost: so the taken
//             vertices are independent, and one evaluation in twelve is saved. Within a level the order is
//             that of the ground, not of the costs, so the thresholds of levels must be close together
//             (docs/decisions/0016).
//   remove    Remove the taken vertices one after the other. Each new floor is joined to its neighbours at
//             once. The stars and the measured floors are kept from the evaluation.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "engine/parallel/loop_threads.h"
#include "terrain/simplify/cost.h"
#include "terrain/simplify/evaluation_prefetch.h"
#include "terrain/simplify/measured_floor.h"
#include "terrain/simplify/removal.h"
#include "terrain/simplify/state.h"

namespace arete {

/// Runs levels of tiles on one thread, and owns the lists that they need.
template <class Plan, class Errors>
class TileWorker {
 public:
  using State = SimplifyState<Plan, Errors>;
  using Tile = ThresholdList::Tile;

  explicit TileWorker(State& state) : s_(state), cost_(state), remover_(state) {}

  /// A level of the vertices of a tile that may be removed.
  /// @param number of the level; different for all levels of a vertex.
  /// @return how many vertices were removed.
  std::size_t levelOf(Tile tile, double threshold, std::uint32_t number, MtRecorder::BatchOrder order) {
    s_.thresholds.collect(tile, threshold, due_);
    take(tile, threshold, number);
    if (!taken_.empty()) remove(order);
    return taken_.size();
  }

  /// The vertices that levelOf() has held, in no order, some more than once; their threshold is kNever. The
  /// caller empties the list.
  std::vector<VertexId>& held() { return held_; }

 private:
  using RecordState = RemovalRecord::State;

  struct Taken {
    Star star;
    MeasuredFloor floor;  // empty unless it was measured in this level
  };

  void take(Tile tile, double threshold, std::uint32_t number) {
    const std::uint32_t isSkipped = ~number;
    taken_.clear();
    linkSizes_.clear();
    for (std::size_t i = 0; i != due_.size(); ++i) {
      prefetchForEvaluation(s_, due_, i);
      const VertexId v = due_[i];
      RemovalRecord& record = s_.records[v];
      if (record.selection == isSkipped) continue;
      if (taken_.size() == space_.size()) space_.emplace_back();
      Taken& one = space_[taken_.size()];
      if (!costsAtMost(threshold, v, record, one)) continue;
      const auto link = one.star.linkView();
      if (!std::ranges::all_of(link, [&](VertexId u) { return s_.thresholds.isWithin(tile, u); })) {
        held_.push_back(v);
        s_.thresholds.set(v, ThresholdList::kNever);
        continue;
      }
      for (const VertexId u : link) s_.records[u].selection = isSkipped;
      taken_.push_back(v);
      linkSizes_.push_back(static_cast<std::uint8_t>(link.size()));
    }
  }

  /// Whether removing v costs at most the threshold; then `one` has its star.
  bool costsAtMost(double threshold, VertexId v, RemovalRecord& record, Taken& one) {
    record.settle();
    one.floor.clear();
    if (record.state == RecordState::exact) {
      if (record.cost > threshold) return false;
      one.star.gather(s_.mesh, v, kMaxHoleCorners);
      return true;
    }
    cost_.evaluate(v, one.star, threshold, record, one.floor);
    s_.thresholds.set(v, record.nextThreshold());
    return record.state == RecordState::exact && record.cost <= threshold;
  }

  void remove(MtRecorder::BatchOrder order) {
    const RemovalId first = s_.recorder.beginBatch(order, linkSizes_);
    std::size_t dead = 0;
    for (std::size_t i = 0; i != taken_.size(); ++i) {
      if (i + kStarsAhead < taken_.size()) remover_.prefetch(space_[i + kStarsAhead].star);
      Taken& one = space_[i];
      const std::span<Seam> seams(seams_.data(), static_cast<std::size_t>(one.star.linkSize));
      remover_.remove(taken_[i], one.star, one.floor,
                      RemovalId(first.index() + static_cast<std::uint32_t>(i)), seams);
      for (const Seam& seam : seams) sewAlone(s_.mesh, seam);
      dead += Star::slotsLeftDead(one.star.isOpen);
    }
    s_.thresholds.remove(taken_, LoopThreads::caller);
    s_.liveTriangles -= dead;
  }

  static constexpr std::size_t kStarsAhead = 3;

  State& s_;
  RemovalCost<Plan, Errors> cost_;
  VertexRemover<Plan, Errors> remover_;

  UninitializedVector<VertexId> due_;
  std::vector<VertexId> taken_;
  std::vector<Taken> space_;             // per taken; reused by the next level
  std::vector<std::uint8_t> linkSizes_;  // per taken
  std::array<Seam, kMaxHoleCorners> seams_;
  std::vector<VertexId> held_;
};

}  // namespace arete
