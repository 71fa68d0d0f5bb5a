// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

namespace arete {

/// The time that a stage of a long operation took.
struct StageTime {
  std::string stage;
  double seconds = 0;     ///< wall time, without that of the stages opened inside it
  double cpuSeconds = 0;  ///< of all threads of the process; divided by `seconds`: how many were busy
  std::size_t times = 0;  ///< how often the stage was entered
};

/// Adds up the time spent in named stages. An operation with a clock (RunContext::clock) opens a Scope for
/// each of its stages; without a clock a Scope does nothing.
///
/// Scopes are opened and closed on the thread that runs the operation, around its parallel parts and not
/// within them: a stage is entered once per level of a build, not once per vertex (a scope costs about a
/// microsecond). They nest; the time of an inner scope counts for it alone, so that the stages add up.
class StageClock {
 public:
  class Scope {
   public:
    /// Precondition: the clock, if any, outlives the scope.
    Scope(StageClock* clock, std::string_view stage) : clock_(clock) {
      if (clock_ != nullptr) clock_->enter(stage);
    }
    ~Scope() {
      if (clock_ != nullptr) clock_->leave();
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    StageClock* clock_;
  };

  /// The stages in the order in which they were first entered. Precondition: no scope is open.
  const std::vector<StageTime>& times() const { return times_; }

 private:
  /// A point in time: wall time, and processor time of the whole process.
  struct Moment {
    std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
    std::clock_t cpu = std::clock();
  };

  StageTime& timeOf(std::string_view stage);
  void enter(std::string_view stage);
  void leave();
  /// Adds the time since the last call to the innermost open stage.
  void settle();

  std::vector<StageTime> times_;
  std::vector<std::size_t> open_;  // indices into times_, the innermost last
  Moment last_;
};

}  // namespace arete
