// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/memory/required_memory.h"

#include <unistd.h>

#include <new>

namespace arete {

void requireMemory(std::uint64_t bytes) {
  const long pages = sysconf(_SC_PHYS_PAGES), pageBytes = sysconf(_SC_PAGESIZE);
  if (pages > 0 && pageBytes > 0 && bytes / static_cast<std::uint64_t>(pageBytes) > std::uint64_t(pages))
    throw std::bad_alloc();
}

}  // namespace arete
