// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <cstddef>
#include <utility>

namespace arete {

// Loops whose iterations run on the threads of the arena (with_threads.h). Threads are named in this room
// alone.

/// Indices from begin() up to end(), which a loop divides into tasks.
template <class Index>
using IndexRange = tbb::blocked_range<Index>;

/// Calls visit(index) for begin .. end - 1.
template <class Index, class Visit>
void parallelFor(Index begin, Index end, const Visit& visit) {
  tbb::parallel_for(begin, end, visit);
}

/// Calls visit(range) for ranges that cover `all`, of at least half of its grain.
template <class Index, class Visit>
void parallelFor(const IndexRange<Index>& all, const Visit& visit) {
  tbb::parallel_for(all, visit);
}

/// As parallelFor(), each index a task of its own: for few tasks that take long.
template <class Index, class Visit>
void parallelForTasks(Index begin, Index end, const Visit& visit) {
  tbb::parallel_for(begin, end, visit, tbb::simple_partitioner());
}

/// Calls fold(range, value), which returns the value with those of the range, and join(value, value). The
/// ranges are in order, and where they end depends on the threads: join() is associative to the bit.
template <class Index, class Value, class Fold, class Join>
Value parallelReduce(const IndexRange<Index>& all, const Value& identity, const Fold& fold,
                     const Join& join) {
  return tbb::parallel_reduce(all, identity, fold, join);
}

/// As parallelReduce(), with ranges that are the same for any number of threads: sums have the same bits.
template <class Index, class Value, class Fold, class Join>
Value parallelSum(const IndexRange<Index>& all, const Value& identity, const Fold& fold, const Join& join) {
  return tbb::parallel_deterministic_reduce(all, identity, fold, join);
}

/// Calls each of the functions.
template <class... Functions>
void parallelInvoke(Functions&&... functions) {
  tbb::parallel_invoke(std::forward<Functions>(functions)...);
}

}  // namespace arete
