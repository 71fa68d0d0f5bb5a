// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace arete {

/// An array that grows without moving what it holds and without a doubled peak: blocks of 2^18 elements.
/// Elements are uninitialised until written. Different elements may be written by different threads.
template <class T>
class ChunkedArray {
 public:
  std::size_t size() const { return size_; }
  void resize(std::size_t size) {
    while (blocks_.size() * kBlock < size) blocks_.emplace_back(std::make_unique_for_overwrite<T[]>(kBlock));
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
  static constexpr std::size_t kShift = 18, kBlock = std::size_t(1) << kShift;
  std::vector<std::unique_ptr<T[]>> blocks_;
  std::size_t size_ = 0;
};

}  // namespace arete
