// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

#include "engine/memory/pages.h"

namespace arete {

/// An array that grows by chunks, without moving its elements and without a doubled peak. Elements are
/// uninitialised until written. Different threads may write different elements, also while another thread
/// grows the array within the reserved size; a reader must be synchronised with the growth.
///
/// Chunks are whole huge pages (engine/memory/pages.h), which go back to the system when the array is
/// cleared.
///
/// Not tbb::concurrent_vector: its elements are initialised, and its segments grow with the array, so that
/// the last one may take half of the memory without need.
template <class T>
class ChunkedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  std::size_t size() const { return size_; }
  /// Sets how far the array may grow while other threads use it. Takes no memory for elements.
  void reserve(std::size_t size) { chunks_.reserve((size + kChunkSize - 1) / kChunkSize); }
  void resize(std::size_t size) {
    while (chunks_.size() * kChunkSize < size) chunks_.push_back(takeChunk());
    size_ = size;
  }
  T& operator[](std::size_t i) { return chunks_[i >> kShift][i & (kChunkSize - 1)]; }
  const T& operator[](std::size_t i) const { return chunks_[i >> kShift][i & (kChunkSize - 1)]; }
  void clear() {
    chunks_.clear();
    chunks_.shrink_to_fit();
    size_ = 0;
  }

 private:
  /// log2 of the least power of two of elements that fill whole huge pages.
  static constexpr std::size_t kShift = [] {
    std::size_t shift = 0;
    while ((sizeof(T) << shift) % kHugePage != 0) ++shift;
    return shift;
  }();
  static constexpr std::size_t kChunkSize = std::size_t(1) << kShift;

  struct Unmap {
    void operator()(T* chunk) const { givePagesBack(chunk, kChunkSize * sizeof(T)); }
  };
  using Chunk = std::unique_ptr<T[], Unmap>;

  static Chunk takeChunk() {
    void* const pages = takePages(kChunkSize * sizeof(T));
    if (pages == nullptr) throw std::bad_alloc();
    return Chunk(static_cast<T*>(pages));
  }

  std::vector<Chunk> chunks_;
  std::size_t size_ = 0;
};

}  // namespace arete
