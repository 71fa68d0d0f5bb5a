// SPDX-License-Identifier: GPL-3.0-or-later
//
// A level that one thread works on, of a piece of the ground. It collects who is due, as any level does. Then
//
//   take      It looks at one after the other and takes who costs no more than the threshold. A vertex with a
//             neighbour beyond the piece is held instead. Who has a neighbour that was taken is passed over,
//             unseen: the neighbour's removal changes what it costs. So the taken are independent, and one
//             look in twelve is saved. Within a level the order is that of the ground, not of the costs,
//             which is why the levels must not be far apart (docs/decisions/0016).
//   remove    Those that were taken, one after the other, each joined at once to what lies around its star:
//             their stars, and what their floors measure, are kept from the look.
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

/// A thread at work on levels of a piece, and the lists that it needs.
template <class Plan, class Errors>
class TileWorker {
 public:
  using State = SimplifyState<Plan, Errors>;
  using Piece = ThresholdList::Piece;

  explicit TileWorker(State& state) : s_(state), cost_(state), remover_(state) {}

  /// A level of those of the piece that may go. `number`: of the level, none of a vertex's levels has the
  /// same. Returns how many went.
  std::size_t levelOf(Piece piece, double threshold, std::uint32_t number, MtRecorder::BatchOrder order) {
    s_.waiting.collect(piece, threshold, due_);
    take(piece, threshold, number);
    if (!taken_.empty()) remove(order);
    return taken_.size();
  }

  /// The vertices that were held since the last call, in no order, some more than once. They are due never.
  std::vector<std::uint32_t>& held() { return held_; }

 private:
  using Note = RemovalRecord::State;

  struct Taken {
    Star star;
    MeasuredFloor floor;  // empty unless the look was of this level
  };

  void take(Piece piece, double threshold, std::uint32_t number) {
    const std::uint32_t isPassedOver = ~number;
    taken_.clear();
    linkSizes_.clear();
    for (std::size_t i = 0; i != due_.size(); ++i) {
      prefetchForLook(s_, due_, i);
      const std::uint32_t v = due_[i];
      RemovalRecord& note = s_.notes[v];
      if (note.candidacy == isPassedOver) continue;
      if (taken_.size() == space_.size()) space_.emplace_back();
      Taken& one = space_[taken_.size()];
      if (!costsNoMoreThan(threshold, v, note, one)) continue;
      const auto link = one.star.linkView();
      if (!std::ranges::all_of(link, [&](std::uint32_t u) { return s_.waiting.isWithin(piece, u); })) {
        held_.push_back(v);
        s_.waiting.set(v, ThresholdList::kNever);
        continue;
      }
      for (const std::uint32_t u : link) s_.notes[u].candidacy = isPassedOver;
      taken_.push_back(v);
      linkSizes_.push_back(static_cast<std::uint8_t>(link.size()));
    }
  }

  /// Whether removing v does: then `one` has its star.
  bool costsNoMoreThan(double threshold, std::uint32_t v, RemovalRecord& note, Taken& one) {
    note.settle();
    one.floor.clear();
    if (note.state == Note::exact) {
      if (note.cost > threshold) return false;
      one.star.gather(s_.mesh, v, kMaxHoleCorners);
      return true;
    }
    cost_.look(v, one.star, threshold, note, one.floor);
    s_.waiting.set(v, note.dueAt());
    return note.state == Note::exact && note.cost <= threshold;
  }

  void remove(MtRecorder::BatchOrder order) {
    const std::uint32_t first = s_.recorder.beginBatch(order, linkSizes_);
    std::size_t dead = 0;
    for (std::size_t i = 0; i != taken_.size(); ++i) {
      if (i + kStarsAhead < taken_.size()) remover_.prefetch(space_[i + kStarsAhead].star);
      Taken& one = space_[i];
      const std::span<Seam> seams(seams_.data(), static_cast<std::size_t>(one.star.linkSize));
      remover_.remove(taken_[i], one.star, one.floor, first + static_cast<std::uint32_t>(i), seams);
      for (const Seam& seam : seams) sewAlone(s_.mesh, seam);
      dead += Star::slotsLeftDead(one.star.isOpen);
    }
    s_.waiting.remove(taken_, LoopThreads::caller);
    s_.liveTriangles -= dead;
  }

  static constexpr std::size_t kStarsAhead = 3;

  State& s_;
  RemovalCost<Plan, Errors> cost_;
  VertexRemover<Plan, Errors> remover_;

  UninitializedVector<std::uint32_t> due_;
  std::vector<std::uint32_t> taken_;
  std::vector<Taken> space_;             // per taken, and kept for those of the next level
  std::vector<std::uint8_t> linkSizes_;  // per taken
  std::array<Seam, kMaxHoleCorners> seams_;
  std::vector<std::uint32_t> held_;
};

}  // namespace arete
