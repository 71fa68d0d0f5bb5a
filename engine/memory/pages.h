// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace arete {

/// Memory from the system, zeros, that comes page by page as it is touched and is the system's again the
/// moment it is given back; the heap would keep it. nullptr when there is none.
void* takeZeroPages(std::size_t bytes);
/// `bytes` as they were taken.
void giveZeroPagesBack(void* pages, std::size_t bytes);

/// Pages come, and are kept, in pieces of so many bytes: a large page, or a whole table of small ones. Arrays
/// that are smaller do better on the heap.
inline constexpr std::size_t kPieceOfPages = std::size_t{1} << 21;
/// How far it is to where the next piece can begin.
inline std::size_t bytesToPiece(const void* memory) {
  return (kPieceOfPages - reinterpret_cast<std::uintptr_t>(memory) % kPieceOfPages) % kPieceOfPages;
}

/// The same, but what is in them may be anything, as kept pages are taken first (PageKeeper). Up to the next
/// whole piece there is room, and memory where it is touched.
void* takePages(std::size_t bytes);
/// To the system, or to be kept. `bytes` as they were taken.
void givePagesBack(void* pages, std::size_t bytes) noexcept;
/// Gives back the whole pieces behind the first `needed` bytes. Returns how many are taken still.
std::size_t giveTailBack(void* pages, std::size_t bytes, std::size_t needed) noexcept;

/// Gives the system what the heap holds and nobody uses. Worth it after work in many small blocks, most of
/// which are freed: large arrays take pages of their own, which the heap's free ones would stand beside.
/// Does nothing where the C library has no way to.
void giveFreeHeapBack();

/// While there is one, pages given back are kept for those who take some next: a page from the system has to
/// be found and cleared at its first touch, which takes about as long as filling it ten times over. When the
/// last one goes, the system gets what is left, and so it does when it has no more to give. Pages are kept by
/// the process, for all of its threads; of those that takePages() gave, it never holds more than were in use
/// at once. The heap gets none of them.
class PageKeeper {
 public:
  PageKeeper();
  ~PageKeeper();
  PageKeeper(const PageKeeper&) = delete;
  PageKeeper& operator=(const PageKeeper&) = delete;
};

}  // namespace arete
