// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

namespace arete::packed {

/// Zeros of a ZeroedArena, which must stay as long as they are used. There are some more behind the end, so
/// that looking ahead needs no test.
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

/// The memory of several arrays, side by side: zeros that come page by page as they are touched. Many arrays
/// of a few hundred kilobytes are worth large pages together (engine/memory/page_choice.h), none is by
/// itself; and there is one end of a page that nobody uses, not one for each.
class ZeroedArena {
 public:
  /// Takes memory for the arrays and puts them there: `forEach(visit)` calls visit(array, size) for each
  /// ZeroedArray, always the same. False when there is not enough memory.
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
  /// The address sanitizer is to report whoever touches these kFence bytes, behind an array.
  static void fence(std::byte* from);

  struct Free {
    std::size_t bytes;
    void operator()(std::byte* memory) const;
  };
  std::unique_ptr<std::byte, Free> memory_;
};

}  // namespace arete::packed
