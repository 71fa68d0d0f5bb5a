// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kind that costs less is asked for (page_prices.h). One piece of fresh memory in eight is touched before
// its taker does (one in 65 of an array that is taken at once: its taker's threads share the rest), and the
// time that this takes is the price of the kind that it is made of.
#include "engine/memory/page_choice.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <mutex>

#include "engine/base/stopwatch.h"
#include "engine/memory/page_prices.h"
#include "engine/memory/pages.h"

namespace arete {
namespace {

using Kind = PagePrices::Kind;

/// Of smaller arrays in a process that has less, the unused ends of large pages would count.
constexpr std::size_t kLargeArray = std::size_t{16} << 20, kLargeProcess = std::size_t{48} << 20;
/// Of what is larger the heap asks the system (M_MMAP_THRESHOLD grows no further).
constexpr std::size_t kLargestOfHeap = std::size_t{32} << 20;
constexpr std::size_t kUntried = 7;         // pieces between two that are tried
constexpr std::size_t kTrustedPieces = 64;  // that a choice is made for

struct Choice {
  std::mutex choosing;
  PagePrices prices;
  std::size_t untried = 0;  // pieces that are still to come before one is tried
};

Choice& choice() {
  static Choice one;
  return one;
}

/// A system that does not know of kinds has one.
void advise([[maybe_unused]] char* pages, [[maybe_unused]] std::size_t bytes, [[maybe_unused]] Kind kind) {
#ifdef MADV_HUGEPAGE
  madvise(pages, bytes, kind == Kind::large ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
#endif
}

double secondsToTouch(char* pages, std::size_t bytes) {
  static const auto step = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const Stopwatch watch;
  for (std::size_t at = 0; at < bytes; at += step) static_cast<volatile char*>(pages)[at] = 0;
  return watch.seconds();
}

}  // namespace

bool canHaveUnusedEnds(std::size_t arrayBytes, std::size_t processBytes) {
  return arrayBytes >= kLargeArray || processBytes >= kLargeProcess;
}

void choosePages(char* pages, std::size_t bytes) {
  Choice& c = choice();
  const std::lock_guard lock(c.choosing);
  while (bytes != 0) {
    std::size_t some = kPieceOfPages;
    if (c.untried == 0) {
      const Kind kind = c.prices.toTry();
      advise(pages, some, kind);
      c.prices.note(kind, secondsToTouch(pages, some));
      c.untried = c.prices.areKnown() ? kUntried : 0;
    } else {
      some = std::min(bytes, kTrustedPieces * kPieceOfPages);
      advise(pages, some, c.prices.cheaper());
      c.untried -= std::min(c.untried, some / kPieceOfPages);
    }
    pages += some;
    bytes -= some;
  }
}

void choosePagesOfHeap(void* memory, std::size_t bytes) {
  if (bytes < kLargeArray) return;
  const std::size_t before = bytesToPiece(memory);
  char* const pages = static_cast<char*>(memory) + before;
  const std::size_t whole = (bytes - before) / kPieceOfPages * kPieceOfPages;
  if (bytes > kLargestOfHeap) return choosePages(pages, whole);
  // Perhaps it is not fresh, so its price would tell nothing.
  Choice& c = choice();
  const std::lock_guard lock(c.choosing);
  if (c.prices.areKnown()) advise(pages, whole, c.prices.cheaper());
}

}  // namespace arete
