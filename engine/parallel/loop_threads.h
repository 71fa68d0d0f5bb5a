// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "engine/parallel/parallel_loops.h"

namespace arete {

/// The threads that run a loop: all threads of the arena, or only the calling one, where the others have
/// tasks of their own.
enum class LoopThreads { all, caller };

/// Calls body(begin, end) for disjoint ranges that cover 0 .. size - 1, of at least `grain` elements where
/// several threads run them.
template <class Body>
void forRanges(LoopThreads threads, std::size_t size, std::size_t grain, const Body& body) {
  if (threads == LoopThreads::caller) {
    if (size > 0) body(std::size_t(0), size);
    return;
  }
  parallelFor(IndexRange<std::size_t>(0, size, grain),
              [&](const auto& range) { body(range.begin(), range.end()); });
}

}  // namespace arete
