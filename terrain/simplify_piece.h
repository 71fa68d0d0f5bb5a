// SPDX-License-Identifier: GPL-3.0-or-later
//
// A level that one thread works on, of a piece of the ground. It collects who is due, as any level does. Then
//
//   take      It looks at one after the other. A vertex with a neighbour beyond the piece, were it to go, is
//             held instead. One that costs no more than the level before allowed is late, and taken at once;
//             the others are candidates, and taken in order of their cost when all have been looked at. Who
//             has a neighbour that was taken is passed over, unseen: the neighbour's removal changes what it
//             costs. So the taken are independent, hardly dearer ones go first than in an independent set of
//             all candidates, and one look in twelve is saved (docs/decisions/0016).
//   remove    Those that were taken: their stars, and what their floors measure, are kept from the look.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/loop_threads.h"
#include "engine/stage_clock.h"
#include "engine/uninitialized_vector.h"
#include "terrain/measured_floor.h"
#include "terrain/simplify_batch.h"
#include "terrain/simplify_cost.h"
#include "terrain/simplify_removal.h"
#include "terrain/simplify_state.h"
#include "terrain/star_prefetch.h"

namespace arete {

/// A thread at work on levels of a piece, and the lists that it needs.
template <class Plan, class Errors>
class PieceWorker {
 public:
  using State = SimplifyState<Plan, Errors>;
  using Piece = WaitingList::Piece;

  /// `clock` may be null.
  PieceWorker(State& state, StageClock* clock)
      : s_(state), cost_(state), remover_(state), batch_(state, LoopThreads::caller, clock), clock_(clock) {}

  /// A level of those of the piece that may go. `number`: of the level, none of a vertex's levels has the
  /// same. Returns how many went.
  std::size_t levelOf(Piece piece, double threshold, std::uint32_t number, MtRecorder::BatchOrder order) {
    {
      const StageClock::Scope stage(clock_, "simplify: collect");
      s_.waiting.collect(piece, threshold, due_);
    }
    take(piece, threshold, number);
    if (taken_.empty()) return 0;
    remove(order);
    batch_.end(taken_);
    return taken_.size();
  }

  /// The vertices that were held since the last call, in no order, some more than once. They are due never.
  std::vector<std::uint32_t>& held() { return held_; }

 private:
  using Note = VertexNote::State;

  struct Candidate {
    std::uint32_t vertex;
    float cost;
    Star star;
    MeasuredFloor floor;  // empty unless the look was of this level
  };

  void take(Piece piece, double threshold, std::uint32_t number) {
    const StageClock::Scope stage(clock_, "simplify: evaluate");
    // A look of the fidelity shape takes so long that those of candidates that are then blocked are dear.
    const double late =
        s_.options.shape == HoleShape::fidelity ? threshold : threshold / s_.options.thresholdRatio;
    const std::uint32_t isPassedOver = ~number;
    candidates_ = 0;
    later_.clear();
    taken_.clear();
    takenFrom_.clear();
    linkSizes_.clear();
    const auto takeOne = [&](std::uint32_t candidate) {
      const Candidate& one = space_[candidate];
      for (const std::uint32_t u : one.star.linkView()) s_.notes[u].candidacy = isPassedOver;
      taken_.push_back(one.vertex);
      takenFrom_.push_back(candidate);
      linkSizes_.push_back(static_cast<std::uint8_t>(one.star.linkSize));
    };
    for (std::size_t i = 0; i != due_.size(); ++i) {
      prefetchForLook(s_, due_, i);
      const std::uint32_t v = due_[i];
      VertexNote& note = s_.notes[v];
      if (note.candidacy == isPassedOver) continue;
      if (candidates_ == space_.size()) space_.emplace_back();
      Candidate& one = space_[candidates_];
      if (!isCandidate(v, note, threshold, one)) continue;
      if (!std::ranges::all_of(one.star.linkView(),
                               [&](std::uint32_t u) { return s_.waiting.isWithin(piece, u); })) {
        held_.push_back(v);
        s_.waiting.set(v, WaitingList::kNever);
        continue;
      }
      one.vertex = v;
      one.cost = note.cost;
      if (double(note.cost) <= late)
        takeOne(candidates_);
      else
        later_.push_back(candidates_);
      ++candidates_;
    }
    std::ranges::sort(later_, [&](std::uint32_t a, std::uint32_t b) {
      return space_[a].cost != space_[b].cost ? space_[a].cost < space_[b].cost : a < b;
    });
    for (const std::uint32_t candidate : later_)
      if (s_.notes[space_[candidate].vertex].candidacy != isPassedOver) takeOne(candidate);
  }

  /// Whether removing v costs no more than the threshold: then `one` has its star.
  bool isCandidate(std::uint32_t v, VertexNote& note, double threshold, Candidate& one) {
    note.settle();
    one.floor.triangulation.size = 0;
    if (note.state == Note::exact) {
      if (note.cost > threshold) return false;
      one.star.gather(s_.mesh, v, kMaxHoleCorners);
      return true;
    }
    if (one.star.gather(s_.mesh, v, static_cast<int>(s_.options.maxDegree) + 1))
      cost_.look(v, one.star, threshold, note, one.floor);
    else
      note.state = Note::stuck;
    s_.waiting.set(v, note.state == Note::stuck ? WaitingList::kNever : note.cost);
    return note.state == Note::exact && note.cost <= threshold;
  }

  void remove(MtRecorder::BatchOrder order) {
    const StageClock::Scope stage(clock_, "simplify: remove");
    batch_.begin(order, linkSizes_);
    for (std::size_t i = 0; i != taken_.size(); ++i) {
      if (i + kStarsAhead < taken_.size()) remover_.prefetch(space_[takenFrom_[i + kStarsAhead]].star);
      Candidate& one = space_[takenFrom_[i]];
      batch_.setOpen(i, one.star.isOpen);
      remover_.remove(one.vertex, one.star, one.floor, batch_.removal(i), batch_.seams(i));
    }
  }

  static constexpr std::size_t kStarsAhead = 3;

  State& s_;
  RemovalCost<Plan, Errors> cost_;
  VertexRemover<Plan, Errors> remover_;
  RemovalBatch<Plan, Errors> batch_;
  StageClock* clock_;

  UninitializedVector<std::uint32_t> due_;
  std::vector<Candidate> space_;  // kept from level to level
  std::uint32_t candidates_ = 0;  // of this one
  std::vector<std::uint32_t> later_;
  std::vector<std::uint32_t> taken_, takenFrom_;  // vertices, and their candidates
  std::vector<std::uint8_t> linkSizes_;           // per taken
  std::vector<std::uint32_t> held_;
};

}  // namespace arete
