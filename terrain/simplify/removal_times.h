// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

namespace arete {

/// Where the time of removals goes. A removal is over before a clock has been asked often, so one in
/// kRemovalsATime is timed, by the thread that owns this.
class RemovalTimes {
 public:
  enum Part : unsigned { rewriting, bounds, saturation, kParts };
  static constexpr std::uint32_t kRemovalsATime = 64;

  /// What each part took of the removals that were timed.
  const std::array<double, kParts>& seconds() const { return seconds_; }

  /// One removal, from its beginning on.
  class Lap {
   public:
    /// `times` may be null. Precondition: they outlive the lap.
    explicit Lap(RemovalTimes* times) : times_(times != nullptr && times->isTimed() ? times : nullptr) {
      if (times_ != nullptr) last_ = Clock::now();
    }
    /// What has passed since the last call, or the beginning, was this part's.
    void was(Part part) {
      if (times_ == nullptr) return;
      const Clock::time_point now = Clock::now();
      times_->seconds_[part] += std::chrono::duration<double>(now - last_).count();
      last_ = now;
    }

   private:
    using Clock = std::chrono::steady_clock;
    RemovalTimes* times_;
    Clock::time_point last_;
  };

 private:
  bool isTimed() { return removals_++ % kRemovalsATime == 0; }

  std::array<double, kParts> seconds_{};
  std::uint32_t removals_ = 0;
};

}  // namespace arete
