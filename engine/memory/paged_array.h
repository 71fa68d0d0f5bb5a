// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

#include "engine/memory/pages.h"

namespace arete {

/// An array of fixed size that can shrink in place: memory that is no longer used goes back to the system in
/// whole huge pages (engine/memory/pages.h). Elements are zero bytes until written, and take no memory until
/// touched.
template <class T>
class PagedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  PagedArray() = default;
  explicit PagedArray(std::size_t size) : size_(size), bytes_(size * sizeof(T)) {
    if (size == 0) return;
    data_ = static_cast<T*>(takePages(bytes_));
    if (data_ == nullptr) throw std::bad_alloc();
  }
  PagedArray(PagedArray&& other) noexcept { swap(other); }
  PagedArray& operator=(PagedArray&& other) noexcept {
    PagedArray(std::move(other)).swap(*this);
    return *this;
  }
  ~PagedArray() {
    if (data_ != nullptr) givePagesBack(data_, bytes_);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

  /// Keeps the first `size` elements. Precondition: size <= size().
  void shrink(std::size_t size) {
    assert(size <= size_);
    size_ = size;
    if (data_ != nullptr) bytes_ = giveTailBack(data_, bytes_, size * sizeof(T));
  }

 private:
  void swap(PagedArray& other) {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(bytes_, other.bytes_);
  }

  T* data_ = nullptr;
  std::size_t size_ = 0, bytes_ = 0;  // bytes_: that are mapped
};

}  // namespace arete
