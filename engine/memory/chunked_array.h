// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

#include "engine/memory/pages.h"

namespace arete {

/// An array that grows without moving what it holds and without a doubled peak, by blocks. Elements are
/// uninitialised until written. Different elements may be written by different threads, also while another
/// grows the array, within what was reserved; who reads must know of the growth.
///
/// Blocks are whole pieces of pages (engine/memory/pages.h): a build frees one such array to make room for
/// the next.
template <class T>
class ChunkedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  std::size_t size() const { return size_; }
  /// How far it may grow while others use it. Takes no memory for elements.
  void reserve(std::size_t size) { blocks_.reserve((size + kBlock - 1) / kBlock); }
  void resize(std::size_t size) {
    while (blocks_.size() * kBlock < size) blocks_.push_back(takeBlock());
    size_ = size;
  }
  T& operator[](std::size_t i) { return blocks_[i >> kShift][i & (kBlock - 1)]; }
  const T& operator[](std::size_t i) const { return blocks_[i >> kShift][i & (kBlock - 1)]; }
  void clear() {
    blocks_.clear();
    blocks_.shrink_to_fit();
    size_ = 0;
  }

 private:
  /// The least power of two whose elements fill whole pieces.
  static constexpr std::size_t kShift = [] {
    std::size_t shift = 0;
    while ((sizeof(T) << shift) % kPieceOfPages != 0) ++shift;
    return shift;
  }();
  static constexpr std::size_t kBlock = std::size_t(1) << kShift;

  struct GiveBack {
    void operator()(T* block) const { givePagesBack(block, kBlock * sizeof(T)); }
  };
  using Block = std::unique_ptr<T[], GiveBack>;

  static Block takeBlock() {
    void* const pages = takePages(kBlock * sizeof(T));
    if (pages == nullptr) throw std::bad_alloc();
    return Block(static_cast<T*>(pages));
  }

  std::vector<Block> blocks_;
  std::size_t size_ = 0;
};

}  // namespace arete
