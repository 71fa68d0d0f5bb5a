// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/parallel_sort.h>

#include <functional>

namespace arete {

/// Sorts on the threads of the arena. Elements that compare equal are in no certain order. O(n log n).
template <class Iterator, class Less = std::less<>>
void parallelSort(Iterator begin, Iterator end, const Less& less = {}) {
  tbb::parallel_sort(begin, end, less);
}

}  // namespace arete
