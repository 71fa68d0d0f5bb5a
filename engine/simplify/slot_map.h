// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/ids.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {

/// The place of a triangle in a LiveMesh, and of what is kept by triangle. A removal fills it anew.
using SlotId = Id<struct SlotTag>;

/// Where the slots of an array went when the dead ones were dropped; the others kept their order.
class SlotMap {
 public:
  /// isLive(slot), for slots below size. O(size), parallel.
  template <class IsLive>
  SlotMap(std::size_t size, const IsLive& isLive) : words_(size / kBits + 1) {
    parallelFor(IndexRange<std::size_t>(0, words_.size(), 512), [&](const auto& range) {
      for (std::size_t w = range.begin(); w != range.end(); ++w) {
        std::uint32_t live = 0;
        for (std::size_t slot = kBits * w; slot < std::min(kBits * w + kBits, size); ++slot)
          live |= std::uint32_t(isLive(SlotId(static_cast<std::uint32_t>(slot)))) << slot % kBits;
        words_[w].live = live;
      }
    });
    for (Word& word : words_) {
      word.before = liveCount_;
      liveCount_ += count(word.live);
    }
  }

  /// The new slot of a live one.
  SlotId ofLive(SlotId slot) const {
    const Word& word = words_[slot.index() / kBits];
    return SlotId(word.before + count(word.live & ((std::uint32_t{1} << slot.index() % kBits) - 1)));
  }
  std::uint32_t liveCount() const { return liveCount_; }

  /// Calls visit(slot, new slot) for every live slot, so that elements can be moved in place: when a slot is
  /// visited, the element in its new slot has been visited already. Parallel, in waves: a wave ends where the
  /// new slots would reach its own first slot. If every other slot is dead, each wave reaches twice as far as
  /// the one before.
  template <class Visit>
  void forLiveInPlace(const Visit& visit) const {
    for (std::size_t begin = 0, end = 0; begin != words_.size(); begin = end) {
      const auto movesBefore = [&](const Word& word) {
        return word.before + count(word.live) <= kBits * begin;
      };
      const auto first = words_.begin() + static_cast<std::ptrdiff_t>(begin);
      end = begin + static_cast<std::size_t>(std::partition_point(first, words_.end(), movesBefore) - first);
      if (end >= begin + kFewWords) {
        forLive(begin, end, visit);
      } else {
        end = std::min(begin + kFewWords, words_.size());
        for (std::size_t w = begin; w != end; ++w) forLiveOf(w, visit);
      }
    }
  }

 private:
  template <class Visit>
  void forLive(std::size_t begin, std::size_t end, const Visit& visit) const {
    parallelFor(IndexRange<std::size_t>(begin, end, kFewWords), [&](const auto& range) {
      for (std::size_t w = range.begin(); w != range.end(); ++w) forLiveOf(w, visit);
    });
  }
  template <class Visit>
  void forLiveOf(std::size_t w, const Visit& visit) const {
    std::uint32_t to = words_[w].before;
    for (std::uint32_t live = words_[w].live; live != 0; live &= live - 1)
      visit(
          SlotId(static_cast<std::uint32_t>(kBits * w) + static_cast<std::uint32_t>(std::countr_zero(live))),
          SlotId(to++));
  }

  static constexpr std::size_t kBits = 32, kFewWords = 128;
  struct Word {
    std::uint32_t live;
    std::uint32_t before;  ///< live slots in the words before
  };

  /// The number of bits that are set; std::popcount() is a function call without the processor's instruction.
  static std::uint32_t count(std::uint32_t bits) {
    bits -= bits >> 1 & 0x55555555;
    bits = (bits & 0x33333333) + (bits >> 2 & 0x33333333);
    return ((bits + (bits >> 4)) & 0x0F0F0F0F) * 0x01010101 >> 24;
  }

  std::vector<Word> words_;
  std::uint32_t liveCount_ = 0;
};

}  // namespace arete
