// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace arete {

/// Who runs a loop: all threads of the arena, or the calling one alone, because each of the others is at work
/// on something of its own.
enum class LoopThreads { all, caller };

/// Calls body(begin, end) for ranges that make up 0 .. size - 1, of no less than `grain` where threads share
/// them.
template <class Body>
void forRanges(LoopThreads threads, std::size_t size, std::size_t grain, const Body& body) {
  if (threads == LoopThreads::caller) {
    if (size > 0) body(std::size_t(0), size);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size, grain),
                    [&](const auto& range) { body(range.begin(), range.end()); });
}

}  // namespace arete
