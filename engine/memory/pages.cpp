// SPDX-License-Identifier: GPL-3.0-or-later
//
// A large array is a private anonymous mapping that starts at a multiple of kHugePage. madvise(MADV_HUGEPAGE)
// lets the kernel back it by huge pages at the first touch: one fault instead of 512, and far fewer misses of
// the translation buffer when the array is read at random. The last, partly used huge page stays small pages,
// so that an array takes no more memory than its size.
#include "engine/memory/pages.h"

#include <malloc.h>
#include <sys/mman.h>

#include <algorithm>
#include <atomic>

namespace arete {
namespace {

std::atomic<bool> hugePages = true;

std::size_t mappedBytes(std::size_t bytes) {
  return bytes < kHugePage ? bytes : (bytes + kHugePage - 1) / kHugePage * kHugePage;
}

void unmap(char* pages, std::size_t bytes) {
  if (bytes == 0 || munmap(pages, bytes) == 0) return;
  // A process has a limit of mappings, and unmapping the middle of one splits it: then only the memory goes.
  madvise(pages, bytes, MADV_DONTNEED);
}

void advise([[maybe_unused]] char* pages, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  if (bytes != 0 && hugePages) madvise(pages, bytes, MADV_HUGEPAGE);
#endif
}

}  // namespace

void* takePages(std::size_t bytes) noexcept {
  const std::size_t mapped = mappedBytes(bytes), spare = bytes < kHugePage ? 0 : kHugePage;
  void* const range =
      mmap(nullptr, mapped + spare, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (range == MAP_FAILED) return nullptr;
  char* pages = static_cast<char*>(range);
  if (spare != 0) {
    const std::size_t before = bytesToHugePage(pages);
    unmap(pages, before);
    pages += before;
    unmap(pages + mapped, spare - before);
  }
  advise(pages, bytes / kHugePage * kHugePage);
  return pages;
}

void givePagesBack(void* pages, std::size_t bytes) noexcept {
  unmap(static_cast<char*>(pages), mappedBytes(bytes));
}

std::size_t giveTailBack(void* pages, std::size_t bytes, std::size_t needed) noexcept {
  const std::size_t mapped = mappedBytes(bytes), kept = mappedBytes(std::max(needed, kHugePage));
  if (mapped <= kept) return bytes;
  unmap(static_cast<char*>(pages) + kept, mapped - kept);
  return kept;
}

void adviseHugePages(void* memory, std::size_t bytes) noexcept {
  // The advice splits the heap's mapping in two: only large blocks, which are mappings of their own, are
  // worth it.
  constexpr std::size_t kLargeBlock = 8 * kHugePage;
  const std::size_t before = bytesToHugePage(memory);
  if (bytes < kLargeBlock) return;
  advise(static_cast<char*>(memory) + before, (bytes - before) / kHugePage * kHugePage);
}

void setHugePages(bool isOn) noexcept {
  hugePages = isOn;
}

bool hugePagesAreOn() noexcept {
  return hugePages;
}

void giveFreeHeapBack() noexcept {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace arete
