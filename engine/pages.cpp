// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/pages.h"

#include <sys/mman.h>

namespace arete {

void* takePages(std::size_t bytes) {
  void* const pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return pages == MAP_FAILED ? nullptr : pages;
}

void givePagesBack(void* pages, std::size_t bytes) {
  munmap(pages, bytes);
}

}  // namespace arete
