// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <cstddef>

namespace arete {

/// How many threads the machine runs at once.
inline int hardwareThreads() {
  return tbb::info::default_concurrency();
}

/// While it lives, no more threads than these work in the process.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : control_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}

 private:
  tbb::global_control control_;
};

}  // namespace arete
