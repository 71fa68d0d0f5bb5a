// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "engine/memory/pages.h"

namespace arete {

/// An allocator whose new elements are left as the memory was. Large arrays are pages of the system's
/// (engine/memory/pages.h), which another one may have given back.
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
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }

 private:
  static bool isLarge(std::size_t count) { return count >= kPieceOfPages / sizeof(T); }
};

/// A vector that does not write its elements before somebody does: of large ones the threads that fill them
/// touch the memory first, each its part, where one thread would wait for all of the system's fresh pages.
template <class T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace arete
