// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time runs for the innermost open stage: every entering and leaving credits what has passed since the last
// one. A dozen names are found faster by comparing them than by hashing.
#include "engine/stage_clock.h"

#include <algorithm>

namespace arete {

void StageClock::settle() {
  const Moment now;
  if (!open_.empty()) {
    StageTime& time = times_[open_.back()];
    time.seconds += std::chrono::duration<double>(now.wall - last_.wall).count();
    time.cpuSeconds += double(now.cpu - last_.cpu) / CLOCKS_PER_SEC;
  }
  last_ = now;
}

void StageClock::enter(std::string_view stage) {
  settle();
  auto known =
      std::find_if(times_.begin(), times_.end(), [&](const StageTime& time) { return time.stage == stage; });
  if (known == times_.end()) known = times_.insert(times_.end(), StageTime{std::string(stage)});
  ++known->times;
  open_.push_back(static_cast<std::size_t>(known - times_.begin()));
}

void StageClock::leave() {
  settle();
  open_.pop_back();
}

}  // namespace arete
