// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <string_view>

#include "engine/parallel/run_context.h"

namespace arete {

/// The progress of a stage that many threads work on: one thread at a time reports it, the others do not
/// wait.
class SharedProgress {
 public:
  /// `total` steps lead from the fraction `first` of the stage to the fraction `last`. Precondition: the
  /// context and the name outlive this object.
  SharedProgress(const RunContext& context, std::string_view stage, std::size_t total, double first = 0,
                 double last = 1)
      : context_(context), stage_(stage), total_(total), first_(first), last_(last) {}

  /// Counts finished steps and reports them. Thread-safe. Reported fractions never decrease.
  void add(std::size_t steps = 1) {
    done_ += steps;
    if (isReporting_.exchange(true)) return;
    context_.report(stage_, first_ + (last_ - first_) * (double(done_.load()) / double(total_)));
    isReporting_ = false;
  }

 private:
  const RunContext& context_;
  std::string_view stage_;
  std::size_t total_;
  double first_, last_;
  std::atomic<std::size_t> done_ = 0;
  std::atomic<bool> isReporting_ = false;
};

}  // namespace arete
