// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/parallel/loop_threads.h"
#include "engine/parallel/stage_clock.h"
#include "terrain/simplify/state.h"
#include "terrain/triangulation/rim.h"

namespace arete {

/// The removals of a level that all threads work on; no two of their stars share a triangle. begin()
/// announces them to the recorder, then each removal rewrites its star, in any order and on any thread, and
/// end() joins the new triangles to their neighbours.
template <class Plan, class Errors>
class RemovalBatch {
 public:
  using State = SimplifyState<Plan, Errors>;

  /// `clock` may be null.
  RemovalBatch(State& state, StageClock* clock) : s_(state), clock_(clock) {}

  /// Announces removals by the sizes of their links.
  void begin(MtRecorder::BatchOrder order, std::span<const std::uint8_t> linkSizes) {
    first_ = s_.recorder.beginBatch(order, linkSizes);
    seams_.resize(firstSlotAfter(linkSizes.size()));
    isOpen_.resize(linkSizes.size());
  }

  /// The i-th removal.
  RemovalId removal(std::size_t i) const { return RemovalId(first_.index() + static_cast<std::uint32_t>(i)); }
  /// The seams that the i-th removal fills in. It also calls setOpen().
  std::span<Seam> seams(std::size_t i) {
    const std::size_t from = firstSlotAfter(i);
    return std::span(seams_).subspan(from, firstSlotAfter(i + 1) - from);
  }
  void setOpen(std::size_t i, bool isOpen) { isOpen_[i] = isOpen; }

  /// Joins the new triangles to their neighbours. Precondition: all removals have rewritten their stars.
  /// @param removed the vertices, in the order of the removals.
  void end(std::span<const VertexId> removed) {
    sewSeams();
    if (s_.rim != nullptr)
      for (std::size_t i = 0; i < removed.size(); ++i)
        if (isOpen_[i]) Rim::closeVoid(s_.mesh, seams(i).back().movedTo);
    s_.thresholds.remove(removed, LoopThreads::all);
    std::size_t dead = 0;
    for (const std::uint8_t isOpen : isOpen_) dead += Star::slotsLeftDead(isOpen != 0);
    s_.liveTriangles -= dead;
  }

 private:
  void sewSeams() {
    const StageClock::Scope stage(clock_, "simplify: sew");
    forRanges(LoopThreads::all, seams_.size(), 2048, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) {
        if (i + kSeamsAhead < end && seams_[i + kSeamsAhead].beyond.isValid())
          __builtin_prefetch(&s_.mesh.triangles[LiveMesh::slotOf(seams_[i + kSeamsAhead].beyond)], 1);
        sew(s_.mesh, seams_[i], first_,
            [&](RemovalId removal) { return seams(removal.index() - first_.index()); });
      }
    });
  }

  std::size_t firstSlotAfter(std::size_t removals) const {
    return s_.recorder.firstSlot(removal(removals)) - s_.recorder.firstSlot(first_);
  }

  static constexpr std::size_t kSeamsAhead = 16;

  State& s_;
  StageClock* clock_;
  RemovalId first_;
  std::vector<std::uint8_t> isOpen_;  // per removal
  std::vector<Seam> seams_;           // per slot of the batch
};

}  // namespace arete
