// SPDX-License-Identifier: GPL-3.0-or-later
//
// Kept pages are laid into the range of addresses that the taker gets, a piece at a time: the system moves
// them from one address to another (mremap) in a fortieth of the time that it takes to clear them. A piece
// lies within one mapping, as a range is put together from whole ones; what is left of it at its end is not
// kept.
#include "engine/pages.h"

#include <sys/mman.h>

#include <mutex>
#include <utility>
#include <vector>

namespace arete {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 19;

struct Stock {
  std::mutex using_;
  std::vector<char*> pieces;
  int keepers = 0;
};

Stock& stock() {
  static Stock one;
  return one;
}

char* mapFresh(void* at, std::size_t bytes, int flags = 0) {
  void* const pages = mmap(at, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | flags, -1, 0);
  return pages == MAP_FAILED ? nullptr : static_cast<char*>(pages);
}

/// Lays a kept piece over fresh pages. Where the system cannot, they stay fresh. Whether all is well.
bool layOver(char* fresh, char* piece) {
#ifdef MREMAP_FIXED
  if (mremap(piece, kPiece, kPiece, MREMAP_MAYMOVE | MREMAP_FIXED, fresh) != MAP_FAILED) return true;
#endif
  munmap(piece, kPiece);
  return mapFresh(fresh, kPiece, MAP_FIXED) != nullptr;
}

}  // namespace

void* takeZeroPages(std::size_t bytes) {
  return mapFresh(nullptr, bytes);
}

void* takePages(std::size_t bytes) {
  char* const pages = mapFresh(nullptr, bytes);
  if (pages == nullptr || bytes < kPiece) return pages;
  std::vector<char*> pieces;
  {
    Stock& s = stock();
    const std::lock_guard lock(s.using_);
    while (!s.pieces.empty() && (pieces.size() + 1) * kPiece <= bytes) {
      pieces.push_back(s.pieces.back());
      s.pieces.pop_back();
    }
  }
  bool isWhole = true;
  for (std::size_t i = 0; i < pieces.size(); ++i) isWhole = layOver(pages + i * kPiece, pieces[i]) && isWhole;
  if (isWhole) return pages;
  munmap(pages, bytes);
  return nullptr;
}

void givePagesBack(void* pages, std::size_t bytes) {
  char* const begin = static_cast<char*>(pages);
  std::size_t kept = 0;
#ifdef MREMAP_FIXED
  if (bytes >= kPiece) {
    Stock& s = stock();
    const std::lock_guard lock(s.using_);
    // The first shall be the next to be taken: what was side by side stays so, in one mapping.
    if (s.keepers > 0) {
      kept = bytes / kPiece * kPiece;
      for (std::size_t end = kept; end != 0; end -= kPiece) s.pieces.push_back(begin + end - kPiece);
    }
  }
#endif
  if (kept < bytes) munmap(begin + kept, bytes - kept);
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
    if (--s.keepers == 0) pieces = std::exchange(s.pieces, {});
  }
  for (char* const piece : pieces) munmap(piece, kPiece);
}

}  // namespace arete
