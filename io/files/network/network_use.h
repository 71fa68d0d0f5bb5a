// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace arete {

/// What this process has read over the network so far, by checked requests.
struct NetworkUse {
  std::uint64_t requests = 0;     ///< repeated ones included
  std::uint64_t bytes = 0;        ///< of files, that came
  std::uint64_t cachedBytes = 0;  ///< that a cache on disk had instead (io/files/ranges/span_cache.h)
};

/// Thread-safe.
NetworkUse networkUse();
void noteRequest(std::uint64_t bytes);
void noteCached(std::uint64_t bytes);

}  // namespace arete
