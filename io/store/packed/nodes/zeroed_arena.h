// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

namespace arete::packed {

/// An array of zeros in a ZeroedArena, which must outlive it. Some readable elements follow its end, so that
/// reading ahead needs no test.
template <class T>
class ZeroedArray {
 public:
  ZeroedArray() = default;
  ZeroedArray(T* data, std::size_t size) : data_(data), size_(size) {}
  T* get() const { return data_; }
  T& operator[](std::size_t i) const { return data_[i]; }
  std::size_t size() const { return size_; }
  std::span<const T> view() const { return {data_, size_}; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// The memory of several arrays, side by side: zeroed pages that the system provides when they are first
/// touched. Arrays of a few hundred kilobytes share large pages this way and waste one partial page, not one
/// each.
class ZeroedArena {
 public:
  /// Allocates memory for the arrays and sets them.
  /// @param forEach  forEach(visit) calls visit(array, size) for each ZeroedArray; called twice, with the
  ///                 same effect
  /// @return false if there is not enough memory
  template <class ForEach>
  bool lay(const ForEach& forEach) {
    std::size_t bytes = 0;
    forEach([&](const auto& array, std::size_t size) { bytes += bytesOf(array, size); });
    if (!take(bytes)) return false;
    std::byte* next = memory_.get();
    forEach([&]<class T>(ZeroedArray<T>& array, std::size_t size) {
      array = {reinterpret_cast<T*>(next), size};
      next += bytesOf(array, size);
      fence(next - kFence);
    });
    return true;
  }

 private:
  static constexpr std::size_t kSpare = 8, kLine = 64, kFence = kLine;

  template <class T>
  static std::size_t bytesOf(const ZeroedArray<T>&, std::size_t size) {
    static_assert(std::is_trivially_copyable_v<T> && kLine % alignof(T) == 0);
    return ((size + kSpare) * sizeof(T) + kLine - 1) / kLine * kLine + kFence;
  }

  bool take(std::size_t bytes);
  /// Makes the address sanitizer report accesses to these kFence bytes, behind an array.
  static void fence(std::byte* from);

  struct Free {
    std::size_t bytes;
    void operator()(std::byte* memory) const;
  };
  std::unique_ptr<std::byte, Free> memory_;
};

}  // namespace arete::packed
