// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/removal_batch.h"

#include "engine/parallel/loop_threads.h"

namespace arete {

void RemovalBatch::begin(MtRecorder::BatchOrder order, std::span<const std::uint8_t> linkSizes) {
  first_ = recorder_.beginBatch(order, linkSizes);
  seams_.resize(firstSlotAfter(linkSizes.size()));
  isOpen_.resize(linkSizes.size());
}

void RemovalBatch::end(std::span<const VertexId> removed) {
  sewSeams();
  thresholds_.remove(removed, LoopThreads::all);
  std::size_t dead = 0;
  for (const std::uint8_t isOpen : isOpen_) dead += Star::slotsLeftDead(isOpen != 0);
  liveTriangles_ -= dead;
}

void RemovalBatch::sewSeams() {
  const StageClock::Scope stage(clock_, "simplify: sew");
  constexpr std::size_t kAhead = 16;
  forRanges(LoopThreads::all, seams_.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      if (i + kAhead < end && seams_[i + kAhead].beyond.isValid())
        __builtin_prefetch(&mesh_.triangles[LiveMesh::slotOf(seams_[i + kAhead].beyond)], 1);
      sew(mesh_, seams_[i], first_, [&](RemovalId other) { return seams(other.index() - first_.index()); });
    }
  });
}

}  // namespace arete
