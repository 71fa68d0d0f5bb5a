// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

#include "engine/parallel/stage_clock.h"

namespace arete {

/// How a long operation is run: what it may use, whom it tells, when it stops. Cheap to copy.
struct RunContext {
  /// Called from one thread at a time with the name of the stage and the fraction of it done, 0..1.
  std::function<void(std::string_view stage, double fraction)> progress;
  /// Set by the caller, from any thread or a signal handler, to stop soon. May be null.
  const std::atomic<bool>* cancel = nullptr;
  /// Threads to use; 0 means all of them. No result depends on it.
  int threads = 0;
  /// Told how long each stage takes. May be null; where it is not, one operation at a time uses it.
  StageClock* clock = nullptr;

  bool cancelled() const { return cancel != nullptr && cancel->load(std::memory_order_relaxed); }
  void report(std::string_view stage, double fraction) const {
    if (progress) progress(stage, fraction);
  }
};

}  // namespace arete
