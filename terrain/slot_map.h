// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace arete {

/// Where the slots of an array went when the dead ones were dropped; the others kept their order.
class SlotMap {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// isLive(slot), for slots below size. O(size), parallel.
  template <class IsLive>
  SlotMap(std::size_t size, const IsLive& isLive) : words_(size / 64 + 1) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, words_.size(), 256), [&](const auto& range) {
      for (std::size_t w = range.begin(); w != range.end(); ++w) {
        std::uint64_t live = 0;
        for (std::size_t slot = 64 * w; slot < std::min(64 * w + 64, size); ++slot)
          live |= std::uint64_t(isLive(slot)) << slot % 64;
        words_[w].live = live;
      }
    });
    for (Word& word : words_) {
      word.before = liveCount_;
      liveCount_ += static_cast<std::uint32_t>(std::popcount(word.live));
    }
  }

  /// The new slot of an old one; kNone: dropped.
  std::uint32_t operator[](std::size_t slot) const {
    const Word& word = words_[slot / 64];
    const std::uint64_t bit = std::uint64_t{1} << slot % 64;
    if ((word.live & bit) == 0) return kNone;
    return word.before + static_cast<std::uint32_t>(std::popcount(word.live & (bit - 1)));
  }
  std::uint32_t liveCount() const { return liveCount_; }

 private:
  struct Word {
    std::uint64_t live;
    std::uint32_t before;  ///< live slots in the words before
  };
  std::vector<Word> words_;
  std::uint32_t liveCount_ = 0;
};

}  // namespace arete
