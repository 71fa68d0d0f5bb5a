// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

#include "engine/parallel/stage_clock.h"

namespace arete {

/// How a long operation runs: its threads, its reports of progress, and when it stops. Cheap to copy.
struct RunContext {
  /// Called from one thread at a time with the name of the stage and the fraction of it done, 0..1.
  std::function<void(std::string_view stage, double fraction)> progress;
  /// The operation stops soon after it becomes true, on any thread or in a signal handler. May be null.
  const std::atomic<bool>* cancel = nullptr;
  /// Threads to use; 0 means all of them. No result depends on it.
  int threads = 0;
  /// Records how long each stage takes. May be null. One operation at a time may use it.
  StageClock* clock = nullptr;

  bool cancelled() const { return cancel != nullptr && cancel->load(std::memory_order_relaxed); }
  void report(std::string_view stage, double fraction) const {
    if (progress) progress(stage, fraction);
  }
};

}  // namespace arete
