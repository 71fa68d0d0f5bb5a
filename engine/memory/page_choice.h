// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace arete {

/// Chooses small or large pages for fresh memory: whole pieces (engine/memory/pages.h) that nobody has
/// touched. To learn what either kind costs it touches a piece now and then, which stays zero. Thread-safe.
void choosePages(char* pages, std::size_t bytes);

/// The same for memory that the heap has just given, and that nobody has touched since.
void choosePagesOfHeap(void* memory, std::size_t bytes);

/// Whether what an array may leave unused of large pages is little, in a process that has taken so many
/// bytes.
bool canHaveUnusedEnds(std::size_t arrayBytes, std::size_t processBytes);

/// Room in a vector that is empty, of the pages that cost less.
template <class T>
void reserveInPages(std::vector<T>& empty, std::size_t size) {
  empty.reserve(size);
  choosePagesOfHeap(empty.data(), empty.capacity() * sizeof(T));
}

}  // namespace arete
