// SPDX-License-Identifier: GPL-3.0-or-later
//
// Kept pages are laid into the range of addresses that the taker gets, a piece at a time: the system moves
// them from one address to another (mremap) in a fraction of the time that it takes to clear them. A piece
// lies within one mapping, as ranges are put together from whole ones; what is left of a range behind its
// last piece is not kept. A piece that was moved may stay a mapping of its own, and a process can have some
// 65 000, so only so many are moved; after them, or once the system refuses to move one, nothing is kept any
// more.
#include "engine/pages.h"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace arete {
namespace {

constexpr std::size_t kPiece = kPieceOfPages, kMostMoved = std::size_t{1} << 15;

struct Stock {
  std::mutex using_;
  std::vector<char*> pieces;  // the next to be taken last
  std::size_t moved = 0;      // since there is a keeper
  int keepers = 0;
};

Stock& stock() {
  static Stock one;
  return one;
}

char* mapFresh(std::size_t bytes) {
  void* const pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return pages == MAP_FAILED ? nullptr : static_cast<char*>(pages);
}

void unmap(char* pages, std::size_t bytes) {
  if (bytes == 0 || munmap(pages, bytes) == 0) return;
  madvise(pages, bytes, MADV_DONTNEED);  // there are too many mappings to split one: the addresses stay
}

void unmapPieces(std::span<char* const> pieces) {
  for (char* const piece : pieces) unmap(piece, kPiece);
}

/// Takes up to so many pieces from the stock, the first to be used last.
std::vector<char*> takePieces(std::size_t most) {
  Stock& s = stock();
  const std::lock_guard lock(s.using_);
  const std::size_t count = std::min({most, s.pieces.size(), kMostMoved - s.moved});
  std::vector<char*> pieces(s.pieces.end() - static_cast<std::ptrdiff_t>(count), s.pieces.end());
  s.pieces.resize(s.pieces.size() - count);
  s.moved += count;
  return pieces;
}

/// All that is kept.
std::vector<char*> emptyStock() {
  Stock& s = stock();
  const std::lock_guard lock(s.using_);
  return std::exchange(s.pieces, {});
}

/// Fresh pages; what is kept may be what is missing.
char* mapOrMakeRoom(std::size_t bytes) {
  if (char* const pages = mapFresh(bytes); pages != nullptr) return pages;
  unmapPieces(emptyStock());
  return mapFresh(bytes);
}

/// From now on nothing is kept, until the next keeper.
void stopKeeping() {
  Stock& s = stock();
  {
    const std::lock_guard lock(s.using_);
    s.moved = kMostMoved;
  }
  unmapPieces(emptyStock());
}

/// Keeps pieces if there is a keeper, and somebody may still take them. Whether it does.
bool keepPieces(std::span<char* const> pieces) noexcept {
  Stock& s = stock();
  const std::lock_guard lock(s.using_);
  if (s.keepers == 0 || s.moved == kMostMoved) return false;
  try {
    s.pieces.insert(s.pieces.end(), pieces.begin(), pieces.end());
  } catch (const std::bad_alloc&) {
    return false;
  }
  return true;
}

#ifdef MREMAP_FIXED
/// Lays a piece over fresh pages. Where the system does not, the piece stays where it is.
bool layOver(char* fresh, char* piece) {
  return mremap(piece, kPiece, kPiece, MREMAP_MAYMOVE | MREMAP_FIXED, fresh) != MAP_FAILED;
}
#endif

}  // namespace

void* takeZeroPages(std::size_t bytes) {
  return mapOrMakeRoom(bytes);
}

void giveZeroPagesBack(void* pages, std::size_t bytes) {
  unmap(static_cast<char*>(pages), bytes);
}

void* takePages(std::size_t bytes) {
#ifdef MREMAP_FIXED
  if (bytes < kPiece) return mapOrMakeRoom(bytes);
  std::vector<char*> pieces = takePieces(bytes / kPiece);
  // No more are to be had, or to be moved: these would be kept for nobody.
  if (pieces.size() < bytes / kPiece) unmapPieces(emptyStock());
  char* const pages = mapFresh(bytes);
  if (pages == nullptr) {
    unmapPieces(pieces);
    return mapOrMakeRoom(bytes);
  }
  for (char* at = pages; !pieces.empty(); at += kPiece, pieces.pop_back()) {
    if (layOver(at, pieces.back())) continue;
    // The fresh pages may be gone, as they make room first, and their addresses another thread's by now: so
    // they are left alone, whosever they are.
    unmapPieces(pieces);
    stopKeeping();
    unmap(pages, static_cast<std::size_t>(at - pages));
    unmap(at + kPiece, static_cast<std::size_t>(pages + bytes - (at + kPiece)));
    return mapOrMakeRoom(bytes);
  }
  return pages;
#else
  return mapOrMakeRoom(bytes);
#endif
}

void givePagesBack(void* pages, std::size_t bytes) noexcept {
  char* const begin = static_cast<char*>(pages);
#ifdef MREMAP_FIXED
  // The first piece shall be the next to be taken: what was side by side stays so, in one mapping.
  std::array<char*, 64> pieces;
  std::size_t end = bytes / kPiece * kPiece;
  unmap(begin + end, bytes - end);
  while (end != 0) {
    const std::size_t count = std::min(pieces.size(), end / kPiece);
    for (std::size_t i = 0; i < count; ++i) pieces[i] = begin + end - (i + 1) * kPiece;
    if (!keepPieces(std::span(pieces).first(count))) break;
    end -= count * kPiece;
  }
  unmap(begin, end);
#else
  unmap(begin, bytes);
#endif
}

PageKeeper::PageKeeper() {
  Stock& s = stock();
  const std::lock_guard lock(s.using_);
  ++s.keepers;
}

PageKeeper::~PageKeeper() {
  std::vector<char*> pieces;
  {
    Stock& s = stock();
    const std::lock_guard lock(s.using_);
    if (--s.keepers > 0) return;
    pieces = std::exchange(s.pieces, {});
    s.moved = 0;
  }
  unmapPieces(pieces);
}

}  // namespace arete
