// SPDX-License-Identifier: GPL-3.0-or-later
//
// A level, of all of the ground or of a piece of it. It goes through these steps:
//
//   collect   Look through those that may go for whom the level concerns: those of whom too little is known,
//             and those under the threshold (waiting_list.h).
//   evaluate  Find what removing them costs (simplify_cost.h). The candidates are those under the threshold.
//   choose    An independent set of them, in order of their cost (independent_set.h).
//   remove    Rewrite each chosen star, record the modification, tell the link (simplify_removal.h).
//   sew       Join the new triangles to their neighbours.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/loop_threads.h"
#include "engine/parallel_filter.h"
#include "engine/stage_clock.h"
#include "terrain/independent_set.h"
#include "terrain/simplify_cost.h"
#include "terrain/simplify_removal.h"
#include "terrain/simplify_state.h"
#include "terrain/star_prefetch.h"

namespace arete {

/// Who works on levels, and the lists that are needed for it. All threads on the whole ground together, or
/// each on a piece of its own: then a vertex with a neighbour beyond the piece, were it to go, is held
/// instead.
template <class Plan, class Errors>
class LevelWorker {
 public:
  using State = SimplifyState<Plan, Errors>;
  using Piece = WaitingList::Piece;

  /// `clock` may be null.
  LevelWorker(State& state, LoopThreads threads, StageClock* clock)
      : s_(state), cost_(state), set_(state.mesh, state.notes), threads_(threads), clock_(clock) {}

  /// A level of those of the piece that may go. `number`: of the level, none of a vertex's levels has the
  /// same. Returns how many went. Only of everything when all threads work together.
  std::size_t levelOf(Piece piece, double threshold, std::uint32_t number, MtRecorder::BatchOrder order) {
    {
      const StageClock::Scope stage(clock_, "simplify: collect");
      s_.waiting.collect(piece, threshold, due_, filter_, threads_);
    }
    piece_ = piece;
    return level(threshold, number, order);
  }
  /// A level of some vertices. Precondition: all threads work together.
  std::size_t levelOf(std::span<const std::uint32_t> some, double threshold, std::uint32_t number,
                      MtRecorder::BatchOrder order) {
    {
      const StageClock::Scope stage(clock_, "simplify: collect");
      s_.waiting.collect(some, threshold, due_, filter_);
    }
    return level(threshold, number, order);
  }

  /// The vertices that were held since the last call, in no order, some more than once. They are due never.
  std::vector<std::uint32_t>& held() { return held_; }

 private:
  using Note = VertexNote::State;

  std::size_t level(double threshold, std::uint32_t number, MtRecorder::BatchOrder order) {
    if (due_.empty()) return 0;
    evaluate(threshold, number);
    choose(number);
    if (chosen_.empty()) return 0;
    const std::uint32_t first = remove(order);
    sewSeams(first);
    finish(first);
    return chosen_.size();
  }

  /// Leaves in `due_` the candidates: vertices whose removal costs no more than the threshold.
  void evaluate(double threshold, std::uint32_t number) {
    const StageClock::Scope stage(clock_, "simplify: evaluate");
    const auto vertex = [&](std::size_t k) { return due_[k]; };
    filter_(threads_, due_.size(), 128, due_, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
      Star star;
      for (std::size_t i = begin; i != end; ++i) {
        prefetchStars(s_.mesh, i, due_.size(), vertex);
        if (i + kHeightsAhead < due_.size()) {
          s_.errors.prefetch(due_[i + kHeightsAhead]);
          __builtin_prefetch(&s_.notes[due_[i + kHeightsAhead]], 1);
          s_.waiting.prefetch(due_[i + kHeightsAhead]);
        }
        const std::uint32_t v = due_[i];
        VertexNote& note = s_.notes[v];
        note.settle();
        if (note.state != Note::exact) {
          if (star.gather(s_.mesh, v, static_cast<int>(s_.options.maxDegree) + 1))
            cost_.look(v, star, threshold, note);
          else
            note.state = Note::stuck;
          s_.waiting.set(v, note.state == Note::stuck ? WaitingList::kNever : note.cost);
        }
        if (note.state != Note::exact || note.cost > threshold) continue;
        if (isInside(v)) {
          set_.enter(v, number);
          *to++ = v;
        } else {
          held_.push_back(v);
          s_.waiting.set(v, WaitingList::kNever);
        }
      }
      return to;
    });
  }

  /// Whether all of the link lies in the piece.
  bool isInside(std::uint32_t v) const {
    if (threads_ == LoopThreads::all) return true;
    bool isInside = true;
    forLink(s_.mesh, v, [&](std::uint32_t u) { return isInside = s_.waiting.isWithin(piece_, u); });
    return isInside;
  }

  void choose(std::uint32_t number) {
    const StageClock::Scope stage(clock_, "simplify: choose");
    if (s_.rim == nullptr) {
      set_.choose(due_, number, chosen_, threads_);
    } else {
      Star star;
      set_.chooseInTurn(due_, number, chosen_, [&](std::uint32_t v) {
        star.gather(s_.mesh, v, kMaxHoleCorners);
        const std::uint32_t before = star.link[star.linkSize - 1], after = star.link[0];
        const bool isFill = star.isOpen && s_.plan.orientation(before, v, after) != 0;
        return !isFill || s_.rim->claim(before, after, number);
      });
    }
    linkSizes_.resize(chosen_.size());
    forRanges(threads_, chosen_.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) linkSizes_[i] = s_.notes[chosen_[i]].linkSize;
    });
  }

  /// Returns the first removal.
  std::uint32_t remove(MtRecorder::BatchOrder order) {
    const StageClock::Scope stage(clock_, "simplify: remove");
    const std::uint32_t first = s_.recorder.beginBatch(order, linkSizes_);
    seams_.resize(firstSlotAfter(first, chosen_.size()));
    isOpen_.resize(chosen_.size());
    forRanges(threads_, chosen_.size(), 64, [&](std::size_t begin, std::size_t end) {
      // The stars of a batch share no triangle, so the next ones can be gathered while others are rewritten,
      // and what the recorder will ask of their children can be on its way.
      std::array<Star, kStarsAhead> ahead;
      VertexRemover<Plan, Errors> remover(s_);
      const auto gather = [&](std::size_t i) {
        if (i < end) gatherAhead(chosen_[i], ahead[i % kStarsAhead]);
      };
      for (std::size_t i = begin; i < begin + kStarsAhead - 1; ++i) gather(i);
      for (std::size_t i = begin; i != end; ++i) {
        // Not beyond the range: the stars there are being rewritten.
        prefetchStars(s_.mesh, i, end, [&](std::size_t k) { return chosen_[k]; });
        if (i + kHeightsAhead < end) s_.errors.prefetch(chosen_[i + kHeightsAhead]);
        gather(i + kStarsAhead - 1);
        const Star& star = ahead[i % kStarsAhead];
        const std::uint32_t removal = first + static_cast<std::uint32_t>(i);
        isOpen_[i] = star.isOpen;
        remover.remove(chosen_[i], star, removal, seamsOf(first, removal));
      }
    });
    return first;
  }

  /// Asks for what the removal will read, as well.
  void gatherAhead(std::uint32_t v, Star& star) const {
    star.gather(s_.mesh, v, kMaxHoleCorners);
    for (int k = 0; k < star.triangleCount; ++k) {
      const LiveMesh::Triangle& triangle = s_.mesh.triangles[star.triangle(k)];
      s_.recorder.prefetch(triangle.bearer, triangle.birth);
    }
    for (const std::uint32_t u : star.linkView()) {
      __builtin_prefetch(&s_.notes[u], 1);
      s_.waiting.prefetch(u);
      __builtin_prefetch(&s_.mesh.vertexHalfedge[u], 1);
    }
    s_.errors.prefetch(star);
  }

  void sewSeams(std::uint32_t first) {
    const StageClock::Scope stage(clock_, "simplify: sew");
    forRanges(threads_, seams_.size(), 2048, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) {
        if (i + kSeamsAhead < end && seams_[i + kSeamsAhead].beyond != LiveMesh::kNone)
          __builtin_prefetch(&s_.mesh.triangles[LiveMesh::triangleOf(seams_[i + kSeamsAhead].beyond)], 1);
        sew(s_.mesh, seams_[i], first, [&](std::uint32_t removal) { return seamsOf(first, removal); });
      }
    });
  }

  void finish(std::uint32_t first) {
    if (s_.rim != nullptr)
      for (std::size_t i = 0; i < chosen_.size(); ++i)
        if (isOpen_[i])
          Rim::closeVoid(s_.mesh, seamsOf(first, first + static_cast<std::uint32_t>(i)).back().movedTo);
    s_.waiting.remove(chosen_, threads_);
    // A removal leaves two slots dead, one on a border.
    std::size_t dead = 0;
    for (const std::uint8_t isOpen : isOpen_) dead += isOpen ? 1 : 2;
    s_.liveTriangles -= dead;
  }

  std::size_t firstSlotAfter(std::uint32_t first, std::size_t removals) const {
    return s_.recorder.firstSlot(first + static_cast<std::uint32_t>(removals)) - s_.recorder.firstSlot(first);
  }
  std::span<Seam> seamsOf(std::uint32_t first, std::uint32_t removal) {
    const std::size_t from = firstSlotAfter(first, removal - first);
    return std::span(seams_).subspan(from, firstSlotAfter(removal, 1));
  }

  static constexpr std::size_t kStarsAhead = 4, kHeightsAhead = 12, kSeamsAhead = 16;

  State& s_;
  RemovalCost<Plan, Errors> cost_;
  IndependentSet set_;
  LoopThreads threads_;
  StageClock* clock_;
  Piece piece_;  // where this worker may touch anything; everything when all work together

  ParallelFilter<std::uint32_t> filter_;
  std::vector<std::uint32_t> due_;  // vertices to look at, then the candidates
  std::vector<std::uint32_t> held_;
  std::vector<std::uint32_t> chosen_;
  std::vector<std::uint8_t> linkSizes_;
  std::vector<std::uint8_t> isOpen_;  // per chosen: whether its star is
  std::vector<Seam> seams_;           // per slot of the batch
};

}  // namespace arete
