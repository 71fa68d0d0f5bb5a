// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "engine/memory/uninitialized_vector.h"

namespace arete {

/// Keeps of a sequence what shall be kept, in its order, on several threads: each writes down what stays of a
/// chunk, and the chunks are moved together. Keeps its memory for the next time.
template <class T>
class ParallelFilter {
 public:
  /// fill(begin, end, to) writes what stays of the elements begin .. end - 1 from `to` on, no more than there
  /// were, and returns the end of what it wrote; called for each chunk once, on any thread. `kept` receives
  /// all of it: the sequence itself, or another vector. O(size).
  template <class Allocator, class Fill>
  void operator()(std::size_t size, std::size_t chunk, std::vector<T, Allocator>& kept, const Fill& fill) {
    const std::size_t chunks = (size + chunk - 1) / chunk;
    found_.resize(size);
    first_.assign(chunks + 1, 0);
    tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t c) {
      const std::size_t begin = c * chunk;
      T* const to = found_.data() + begin;
      first_[c + 1] = static_cast<std::size_t>(fill(begin, std::min(begin + chunk, size), to) - to);
    });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    kept.resize(first_[chunks]);
    tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t c) {
      std::copy_n(found_.data() + c * chunk, first_[c + 1] - first_[c], kept.data() + first_[c]);
    });
  }

 private:
  UninitializedVector<T> found_;    // each chunk's from where the chunk begins
  std::vector<std::size_t> first_;  // per chunk: where it goes
};

}  // namespace arete
