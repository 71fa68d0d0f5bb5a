// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/global_control.h>

#include <cstddef>
#include <memory>
#include <string>

#include "engine/parallel/run_context.h"

namespace arete::bench {

/// As long as it lives, no more threads than these; 0 = no limit.
inline std::unique_ptr<tbb::global_control> limitTo(int threads) {
  if (threads == 0) return nullptr;
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                               static_cast<std::size_t>(threads));
}

inline RunContext onThreads(int threads) {
  RunContext context;
  context.threads = threads;
  return context;
}

inline std::string threadsText(int threads) {
  return threads == 1 ? "1 thread" : "all threads";
}

}  // namespace arete::bench
