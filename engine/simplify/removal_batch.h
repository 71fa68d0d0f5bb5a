// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mt/recorder.h"
#include "engine/parallel/stage_clock.h"
#include "engine/simplify/live_mesh.h"
#include "engine/simplify/threshold_list.h"

namespace arete {

/// The removals of a level that all threads work on; no two of their stars share a triangle. begin()
/// announces them to the recorder, then each removal rewrites its star (refill()), in any order and on any
/// thread, and end() joins the new triangles to their neighbours and drops the vertices.
class RemovalBatch {
 public:
  /// @param liveTriangles of the mesh; end() reduces it.
  /// @param clock may be null. All must outlive the batch.
  RemovalBatch(LiveMesh& mesh, MtRecorder& recorder, ThresholdList& thresholds,
               std::atomic<std::size_t>& liveTriangles, StageClock* clock)
      : mesh_(mesh),
        recorder_(recorder),
        thresholds_(thresholds),
        liveTriangles_(liveTriangles),
        clock_(clock) {}

  /// Announces removals by the sizes of their links.
  void begin(MtRecorder::BatchOrder order, std::span<const std::uint8_t> linkSizes);

  /// The i-th removal.
  RemovalId removal(std::size_t i) const { return RemovalId(first_.index() + static_cast<std::uint32_t>(i)); }
  /// The seams that the i-th removal fills in, one for each vertex of its link. It also calls setOpen().
  std::span<Seam> seams(std::size_t i) {
    const std::size_t from = firstSlotAfter(i);
    return std::span(seams_).subspan(from, firstSlotAfter(i + 1) - from);
  }
  /// Says whether the i-th star is open. Thread-safe for different removals.
  void setOpen(std::size_t i, bool isOpen) { isOpen_[i] = isOpen; }
  /// As setOpen() was called, until begin().
  bool isOpen(std::size_t i) const { return isOpen_[i] != 0; }

  /// Joins the new triangles to their neighbours, removes the vertices from the thresholds, and counts the
  /// slots that are left dead. O(slots of the batch), parallel. Precondition: all removals have rewritten
  /// their stars.
  /// @param removed the vertices, in the order of the removals.
  void end(std::span<const VertexId> removed);

 private:
  void sewSeams();
  std::size_t firstSlotAfter(std::size_t removals) const {
    return recorder_.firstSlot(removal(removals)) - recorder_.firstSlot(first_);
  }

  LiveMesh& mesh_;
  MtRecorder& recorder_;
  ThresholdList& thresholds_;
  std::atomic<std::size_t>& liveTriangles_;
  StageClock* clock_;
  RemovalId first_;
  std::vector<std::uint8_t> isOpen_;  // per removal
  std::vector<Seam> seams_;           // per slot of the batch
};

}  // namespace arete
