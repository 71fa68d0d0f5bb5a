// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/memory/pages.h"

namespace arete {

/// An allocator that leaves new elements uninitialised. Arrays of at least a huge page are mapped from the
/// system (engine/memory/pages.h), smaller ones come from the heap.
template <class T>
struct UninitializedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };
  T* allocate(std::size_t count) {
    if (!isLarge(count)) return std::allocator<T>::allocate(count);
    void* const pages = takePages(count * sizeof(T));
    if (pages == nullptr) throw std::bad_alloc();
    return static_cast<T*>(pages);
  }
  void deallocate(T* at, std::size_t count) {
    if (isLarge(count))
      givePagesBack(at, count * sizeof(T));
    else
      std::allocator<T>::deallocate(at, count);
  }
  template <class U>
  void construct([[maybe_unused]] U* at) {
    // An id is set by its constructor, but not here: one thread would write the whole array.
    if constexpr (!std::is_trivially_copyable_v<U>) ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }

 private:
  static bool isLarge(std::size_t count) { return count >= kHugePage / sizeof(T); }
};

/// A vector whose elements are uninitialised until they are written, ids too. So the threads that fill a
/// large one also touch its memory first, each its part; otherwise one thread would wait for all of its page
/// faults.
template <class T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace arete
