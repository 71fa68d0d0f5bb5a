// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {

/// Maps slots to the nodes that own them, for algorithms that look up nearly all slots of an MT.
/// MultiTriangulation::creator() searches from the hint of 64 slots, over a number of nodes that a processor
/// cannot predict. This map stores a byte per slot instead of searching, so that later look-ups can be
/// prefetched.
class SlotToNode {
 public:
  /// Precondition: slotBegin and creatorHint are as MtArrays states them, and each star has at least 3 slots.
  /// O(slots), parallel.
  explicit SlotToNode(const MtArrays& arrays)
      : slotBegin_(arrays.slotBegin), hints_(arrays.creatorHint), marks_(arrays.link.size()) {
    const auto nodes = static_cast<std::uint32_t>(slotBegin_.size() - 1);
    parallelFor(IndexRange<std::uint32_t>(0, nodes, 4096), [&](const auto& range) {
      for (std::uint32_t n = range.begin(); n != range.end(); ++n) {
        const std::uint32_t last = slotBegin_[n + 1] - 1;
        for (std::uint32_t slot = slotBegin_[n]; slot <= last; ++slot) {
          const std::uint32_t beyondHint = n - hints_[slot / kStep];
          marks_[slot] = static_cast<std::uint8_t>(2 * beyondHint + (slot == last ? 1 : 0));
        }
      }
    });
  }

  /// The node that owns a slot.
  std::uint32_t of(std::uint32_t slot) const { return hints_[slot / kStep] + marks_[slot] / 2; }
  /// The next slot of the same node, around its star. Precondition: owner is of(slot).
  std::uint32_t after(std::uint32_t slot, std::uint32_t owner) const {
    const std::array<std::uint32_t, 2> next = {slot + 1, slotBegin_[owner]};
    return next[marks_[slot] & 1];
  }
  /// Prefetches what of() reads.
  [[gnu::always_inline]] void prefetch(std::uint32_t slot) const {
    __builtin_prefetch(&hints_[slot / kStep]);
    __builtin_prefetch(&marks_[slot]);
  }

 private:
  static constexpr std::uint32_t kStep = MultiTriangulation::kSlotsPerHint;
  static_assert(2 * (kStep / 3 + 1) + 1 <= 0xFF);

  std::span<const std::uint32_t> slotBegin_, hints_;
  UninitializedVector<std::uint8_t>
      marks_;  // per slot: nodes beyond the hint's, times two; and, whether it is the last
};

}  // namespace arete
