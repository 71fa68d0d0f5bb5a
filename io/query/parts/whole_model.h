// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// The whole of a model of which questions read parts: it is read once, where one question needs it or the
/// parts together have come to its nodes, and stays.
///
/// Thread-safe.
template <class Model>
class WholeModel {
 public:
  using Shared = std::shared_ptr<const Model>;

  /// Null where it was not read.
  Shared ifThere() const {
    const std::lock_guard lock(mutex_);
    return whole_;
  }
  void set(Shared whole) {
    const std::lock_guard lock(mutex_);
    whole_ = std::move(whole);
  }
  /// Counts the nodes of a part that was read.
  void countPart(std::uint64_t nodes) {
    const std::lock_guard lock(mutex_);
    nodesRead_ += nodes;
  }

  /// @param read  returns the whole, a Result<Shared>. One thread calls it; others wait, and may be stopped
  /// meanwhile. Errors: those of read(); interrupted.
  template <class Read>
  Result<Shared> get(const Read& read, const RunContext& context) {
    if (Shared there = ifThere()) return there;
    std::unique_lock reading(reads_, std::defer_lock);
    while (!reading.try_lock_for(std::chrono::milliseconds(20)))
      if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
    if (Shared there = ifThere()) return there;
    ARETE_TRY(Shared all, read());
    set(all);
    return all;
  }
  /// The same where the parts have come to `nodes`; null where the next part is better read alone. Where the
  /// whole cannot be read, as with a damaged page, parts go on to answer. Errors: interrupted.
  template <class Read>
  Result<Shared> getIfReadOften(std::uint64_t nodes, const Read& read, const RunContext& context) {
    {
      const std::lock_guard lock(mutex_);
      if (whole_ || nodesRead_ < nodes) return whole_;
      nodesRead_ = 0;
    }
    Result<Shared> all = get(read, context);
    if (!all && context.cancelled()) return all;
    return all ? *all : Shared();
  }

 private:
  mutable std::mutex mutex_;  // of both below; not held while something is read
  Shared whole_;
  std::uint64_t nodesRead_ = 0;
  std::timed_mutex reads_;  // held while the whole is read
};

}  // namespace arete
