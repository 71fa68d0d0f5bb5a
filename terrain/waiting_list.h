// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/parallel_filter.h"

namespace arete {

/// The vertices that may still go, each with the threshold from which on a level concerns it.
///
/// A level looks through all of them for the few that are due, so the thresholds lie side by side in the
/// order of the look; a vertex finds its own by its place. One that has gone keeps its place, and is never
/// due, until half of them have.
class WaitingList {
 public:
  static constexpr float kNow = 0, kNever = std::numeric_limits<float>::infinity();

  /// `vertices`: in the order in which they shall be visited; all due now. vertexCount: they are below it.
  void assign(std::vector<std::uint32_t> vertices, std::uint32_t vertexCount);

  /// How many have not gone.
  std::size_t size() const { return living_; }
  bool empty() const { return living_ == 0; }

  /// `due` receives, in order, those whose threshold has come. Forgets those that went, now and then.
  /// O(size), parallel.
  void collect(double threshold, std::vector<std::uint32_t>& due);

  /// When v is due: a threshold, kNow or kNever. Safe for different vertices at once. Of one that is not in
  /// the list, or has gone, nothing is noted, here and in wakeIf().
  void set(std::uint32_t v, float threshold) { dueAt_[place_[v]] = threshold; }
  /// Makes v due now, if so told: callers cannot foresee it, and no branch is needed. Safe for the same
  /// vertex at once, not beside set() of the same.
  void wakeIf(bool isDue, std::uint32_t v) {
    float& dueAt = dueAt_[place_[v]];
    float nowhere = kNow;  // of this call: a place that all threads wrote to would hold them up
    std::atomic_ref(isDue ? dueAt : nowhere).store(kNow, std::memory_order_relaxed);
  }
  /// These have gone. O(gone).
  void remove(std::span<const std::uint32_t> gone);

  /// The least threshold of all, kNever where none will come. O(size).
  float least() const;

  /// Asks for what set() and wakeIf() read.
  [[gnu::always_inline]] void prefetch(std::uint32_t v) const { __builtin_prefetch(&place_[v]); }

 private:
  void forgetGone();

  static constexpr std::uint32_t kGone = 0xFFFFFFFF;
  static constexpr std::uint32_t kNobody = 0;  // the place of all who are not in the list; never looked at
  std::vector<std::uint32_t> vertices_;        // by place; kGone
  std::vector<float> dueAt_;                   // by place
  std::vector<std::uint32_t> place_;           // by vertex
  ParallelFilter<std::uint32_t> filter_;
  std::size_t living_ = 0;
};

}  // namespace arete
