// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time runs for the innermost open stage: every entering and leaving credits what has passed since the last
// one. A dozen names are found faster by comparing them than by hashing.
#include "engine/parallel/stage_clock.h"

#include <algorithm>

namespace arete {

StageClock::Passed StageClock::passed() {
  const Moment now;
  const Passed passed = {std::chrono::duration<double>(now.wall - last_.wall).count(),
                         double(now.cpu - last_.cpu) / CLOCKS_PER_SEC};
  last_ = now;
  return passed;
}

void StageClock::settle() {
  const Passed passed = this->passed();
  if (open_.empty()) return;
  StageTime& time = times_[open_.back()];
  time.seconds += passed.seconds;
  time.cpuSeconds += passed.cpuSeconds;
}

StageTime& StageClock::timeOf(std::string_view stage) {
  const auto known =
      std::find_if(times_.begin(), times_.end(), [&](const StageTime& time) { return time.stage == stage; });
  return known != times_.end() ? *known : times_.emplace_back(StageTime{std::string(stage)});
}

void StageClock::enter(std::string_view stage) {
  settle();
  StageTime& time = timeOf(stage);
  ++time.times;
  open_.push_back(static_cast<std::size_t>(&time - times_.data()));
}

void StageClock::leave() {
  settle();
  open_.pop_back();
}

void StageClock::moveShare(std::string_view from, std::string_view to, double share) {
  const StageTime moved = timeOf(from);
  StageTime& other = timeOf(to);
  other.seconds += share * moved.seconds;
  other.cpuSeconds += share * moved.cpuSeconds;
  other.times = moved.times;
  StageTime& left = timeOf(from);
  left.seconds -= share * moved.seconds;
  left.cpuSeconds -= share * moved.cpuSeconds;
}

void StageClock::shareOut(std::span<StageClock* const> workers) {
  double total = 0;
  for (const StageClock* worker : workers)
    for (const StageTime& time : worker->times_) total += time.seconds;
  if (!(total > 0)) return;
  const Passed passed = this->passed();
  for (StageClock* worker : workers) {
    for (const StageTime& time : worker->times_) {
      StageTime& own = timeOf(time.stage);
      own.seconds += passed.seconds * time.seconds / total;
      own.cpuSeconds += passed.cpuSeconds * time.seconds / total;
      own.times += time.times;
    }
    worker->times_.clear();
  }
}

}  // namespace arete
