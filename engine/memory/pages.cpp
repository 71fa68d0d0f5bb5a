// SPDX-License-Identifier: GPL-3.0-or-later
//
// Kept pages are laid into the range of addresses that the taker gets, a piece at a time: the system moves
// them from one address to another (mremap). A piece is what one table of pages tells of, and begins where it
// does, so it is one entry that moves. What is left of a range smaller than a piece is not kept. A piece
// that was moved may stay a mapping of its own, and a process can have some 65 000, so only so many are
// moved; after them, or once the system refuses to move one, nothing is kept any more.
#include "engine/memory/pages.h"

#include <malloc.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "engine/memory/page_choice.h"

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

/// What a range takes of the addresses.
std::size_t wholePieces(std::size_t bytes) {
  return bytes < kPiece ? bytes : (bytes + kPiece - 1) / kPiece * kPiece;
}

void unmap(char* pages, std::size_t bytes) {
  if (bytes == 0 || munmap(pages, bytes) == 0) return;
  madvise(pages, bytes, MADV_DONTNEED);  // there are too many mappings to split one: the addresses stay
}

/// Whole pieces begin where a large page can.
char* mapFresh(std::size_t bytes) {
  const std::size_t spare = bytes < kPiece ? 0 : kPiece;
  void* const mapped =
      mmap(nullptr, bytes + spare, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  char* const begin = static_cast<char*>(mapped);
  if (spare == 0) return begin;
  const std::size_t before = bytesToPiece(begin);
  unmap(begin, before);
  unmap(begin + before + bytes, spare - before);
  return begin + before;
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

std::atomic<std::size_t> takenBytes = 0;  // that somebody has

/// What is taken now, or nothing, and the kind of pages for what is fresh of it, behind the kept ones. The
/// end of the last piece that is not asked for is no reason for a large page, unless there are many others.
char* chosen(char* pages, std::size_t kept, std::size_t asked) {
  if (pages == nullptr) return nullptr;
  const std::size_t bytes = wholePieces(asked);
  takenBytes += bytes;
  const std::size_t end = (canHaveUnusedEnds(bytes, takenBytes) ? bytes : asked) / kPiece * kPiece;
  if (end > kept) choosePages(pages + kept, end - kept);
  return pages;
}

}  // namespace

void* takeZeroPages(std::size_t bytes) {
  return chosen(mapOrMakeRoom(wholePieces(bytes)), 0, bytes);
}

void giveZeroPagesBack(void* pages, std::size_t bytes) {
  const std::size_t whole = wholePieces(bytes);
  takenBytes -= whole;
  unmap(static_cast<char*>(pages), whole);
}

void* takePages(std::size_t bytes) {
  const std::size_t whole = wholePieces(bytes);
#ifdef MREMAP_FIXED
  if (whole < kPiece) return chosen(mapOrMakeRoom(whole), 0, bytes);
  std::vector<char*> pieces = takePieces(whole / kPiece);
  const std::size_t kept = pieces.size() * kPiece;
  // No more are to be had, or to be moved: these would be kept for nobody.
  if (pieces.size() < whole / kPiece) unmapPieces(emptyStock());
  char* const pages = mapFresh(whole);
  if (pages == nullptr) {
    unmapPieces(pieces);
    return chosen(mapOrMakeRoom(whole), 0, bytes);
  }
  for (char* at = pages; !pieces.empty(); at += kPiece, pieces.pop_back()) {
    if (layOver(at, pieces.back())) continue;
    // The fresh pages may be gone, as they make room first, and their addresses another thread's by now: so
    // they are left alone, whosever they are.
    unmapPieces(pieces);
    stopKeeping();
    unmap(pages, static_cast<std::size_t>(at - pages));
    unmap(at + kPiece, static_cast<std::size_t>(pages + whole - (at + kPiece)));
    return chosen(mapOrMakeRoom(whole), 0, bytes);
  }
  return chosen(pages, kept, bytes);
#else
  return chosen(mapOrMakeRoom(whole), 0, bytes);
#endif
}

void givePagesBack(void* pages, std::size_t bytes) noexcept {
  bytes = wholePieces(bytes);
  takenBytes -= bytes;
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

std::size_t giveTailBack(void* pages, std::size_t bytes, std::size_t needed) noexcept {
  const std::size_t taken = wholePieces(bytes), kept = wholePieces(std::max(needed, kPiece));
  if (taken <= kept) return bytes;
  givePagesBack(static_cast<char*>(pages) + kept, taken - kept);
  return kept;
}

void giveFreeHeapBack() {
#ifdef __GLIBC__
  malloc_trim(0);
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
