// SPDX-License-Identifier: GPL-3.0-or-later
//
// All heights are converted to floats in parallel; the first valid height that changes by it ends the
// attempt, and the doubles are used.
#include "terrain/error/sample_heights.h"

#include <atomic>

#include "engine/parallel/parallel_loops.h"

namespace arete {

SampleHeights::SampleHeights(std::span<const double> heights) : doubles_(heights), floats_(heights.size()) {
  constexpr std::size_t kSamplesAtOnce = 1 << 14;
  std::atomic<bool> areSame = true;
  parallelFor(IndexRange<std::size_t>(0, heights.size(), kSamplesAtOnce), [&](const auto& range) {
    if (!areSame.load(std::memory_order_relaxed)) return;
    bool isOther = false;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      floats_[i] = static_cast<float>(heights[i]);
      isOther |= static_cast<double>(floats_[i]) != heights[i] && heights[i] == heights[i];
    }
    if (isOther) areSame.store(false, std::memory_order_relaxed);
  });
  areFloats_ = areSame;
  if (!areFloats_) floats_ = {};
}

}  // namespace arete
