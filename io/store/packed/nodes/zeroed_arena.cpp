// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/nodes/zeroed_arena.h"

#include "engine/memory/pages.h"

#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define ARETE_HAS_FENCES
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#define ARETE_HAS_FENCES
#endif
#ifdef ARETE_HAS_FENCES
#include <sanitizer/asan_interface.h>
#endif

namespace arete::packed {

bool ZeroedArena::take(std::size_t bytes) {
  memory_ = {};
  memory_ = {static_cast<std::byte*>(takePages(bytes)), Free{bytes}};
  return memory_ != nullptr;
}

void ZeroedArena::fence([[maybe_unused]] std::byte* from) {
#ifdef ARETE_HAS_FENCES
  ASAN_POISON_MEMORY_REGION(from, kFence);
#endif
}

void ZeroedArena::Free::operator()(std::byte* memory) const {
#ifdef ARETE_HAS_FENCES
  ASAN_UNPOISON_MEMORY_REGION(memory, bytes);
#endif
  givePagesBack(memory, bytes);
}

}  // namespace arete::packed
