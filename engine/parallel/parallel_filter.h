// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {

/// Filters a sequence in parallel and keeps its order: each thread writes the elements that remain of a chunk
/// to a buffer, then the chunks are copied side by side. The buffer is reused by the next call.
template <class T>
class ParallelFilter {
 public:
  /// @param fill  fill(begin, end, to) writes the elements of begin .. end - 1 that remain, at most end -
  /// begin, from
  ///              `to` on and returns the end of its output; called once per chunk, on any thread
  /// @param kept  receives the result; may be the filtered sequence itself. O(size).
  template <class Allocator, class Fill>
  void operator()(std::size_t size, std::size_t chunk, std::vector<T, Allocator>& kept, const Fill& fill) {
    const std::size_t chunks = (size + chunk - 1) / chunk;
    found_.resize(size);
    first_.assign(chunks + 1, 0);
    parallelFor(std::size_t(0), chunks, [&](std::size_t c) {
      const std::size_t begin = c * chunk;
      T* const to = found_.data() + begin;
      first_[c + 1] = static_cast<std::size_t>(fill(begin, std::min(begin + chunk, size), to) - to);
    });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    kept.resize(first_[chunks]);
    parallelFor(std::size_t(0), chunks, [&](std::size_t c) {
      std::copy_n(found_.data() + c * chunk, first_[c + 1] - first_[c], kept.data() + first_[c]);
    });
  }

 private:
  UninitializedVector<T> found_;    // by chunk, at the chunk's own position
  std::vector<std::size_t> first_;  // per chunk: its position in the result
};

}  // namespace arete
