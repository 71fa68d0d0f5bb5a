// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time counts for the innermost open stage: entering and leaving a scope adds the time since the last such
// event to it. A dozen names are found faster by comparing them than by hashing.
#include "engine/parallel/stage_clock.h"

#include <algorithm>
#include <utility>

namespace arete {

void StageClock::settle() {
  const Moment now;
  const Moment last = std::exchange(last_, now);
  if (open_.empty()) return;
  StageTime& time = times_[open_.back()];
  time.seconds += std::chrono::duration<double>(now.wall - last.wall).count();
  time.cpuSeconds += double(now.cpu - last.cpu) / CLOCKS_PER_SEC;
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

}  // namespace arete
