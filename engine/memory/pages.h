// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace arete {

/// Size and alignment of a huge page. Large arrays are mapped in multiples of it; smaller ones stay on the
/// heap.
inline constexpr std::size_t kHugePage = std::size_t{1} << 21;

/// The number of bytes from an address to the next one where a huge page can start: 0 .. kHugePage - 1.
inline std::size_t bytesToHugePage(const void* memory) {
  return (kHugePage - reinterpret_cast<std::uintptr_t>(memory) % kHugePage) % kHugePage;
}

/// Maps zeroed memory from the system, in huge pages where the array covers them whole and the system has
/// them. Pages are taken at their first touch. The address range is rounded up to a multiple of kHugePage if
/// `bytes` is at least that.
/// @return nullptr where the system has no more. Thread-safe.
void* takePages(std::size_t bytes) noexcept;

/// Unmaps what takePages(bytes) returned.
void givePagesBack(void* pages, std::size_t bytes) noexcept;

/// Unmaps the tail of an array whose first `needed` bytes stay in use, in multiples of kHugePage.
/// @return the number of bytes that remain mapped, to be given to givePagesBack() or giveTailBack() later.
std::size_t giveTailBack(void* pages, std::size_t bytes, std::size_t needed) noexcept;

/// Advises huge pages for the part of a heap block that covers them whole; does nothing for blocks below 16
/// MiB. Call it before the block is touched.
void adviseHugePages(void* memory, std::size_t bytes) noexcept;

/// Reserves room in an empty vector, in huge pages where that pays (adviseHugePages()).
template <class T>
void reserveInPages(std::vector<T>& empty, std::size_t size) {
  empty.reserve(size);
  adviseHugePages(empty.data(), empty.capacity() * sizeof(T));
}

/// Switches the advice to use huge pages on (the default) or off for memory that is taken from now on. They
/// save a third to a half of a build's time on most machines and cost time on hosts that must first free them
/// (docs/decisions: large pages). No result depends on it. Thread-safe.
void setHugePages(bool isOn) noexcept;
bool hugePagesAreOn() noexcept;

/// Returns the heap's free memory to the system, where the C library can. Call it after work in many small
/// blocks, most of which are freed: large arrays are mapped apart from the heap and cannot reuse them.
void giveFreeHeapBack() noexcept;

}  // namespace arete
