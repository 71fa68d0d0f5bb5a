// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

namespace arete {

/// Where the time of a long operation went.
struct StageTime {
  std::string stage;
  double seconds = 0;     ///< on the wall; what stages opened inside it took is theirs alone
  double cpuSeconds = 0;  ///< of all threads of the process: over `seconds` it says how many were busy
  std::size_t times = 0;  ///< how often the stage was entered
};

/// Adds up the time spent in named stages. An operation that is given one (RunContext::clock) opens a Scope
/// for each of its stages; without one a Scope does nothing and asks no clock.
///
/// Scopes are opened and closed on the thread that runs the operation, around its parallel parts and not
/// within them: a stage is entered once per level of a build, not once per vertex (a scope costs about a
/// microsecond). They nest; the inner one's time counts for the inner one only, so the stages add up.
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
  /// Since some moment; cpu of the whole process, which is the same for any thread that asks.
  struct Moment {
    std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
    std::clock_t cpu = std::clock();
  };

  StageTime& timeOf(std::string_view stage);
  void enter(std::string_view stage);
  void leave();
  /// Credits what passed to the innermost open stage.
  void settle();

  std::vector<StageTime> times_;
  std::vector<std::size_t> open_;  // indices into times_, the innermost last
  Moment last_;
};

}  // namespace arete
