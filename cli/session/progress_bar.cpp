// SPDX-License-Identifier: GPL-3.0-or-later
//
// A line has 40 ticks: a dot each, and a number at every fourth. Only the ticks since the last report are
// written. The time left is part of the line and is never taken back, so that it reads the same in a terminal
// and in a file.
#include "cli/session/progress_bar.h"

#include <algorithm>
#include <chrono>

namespace arete {
namespace {

constexpr int kTicks = 40;  // a number every four: 0...10...20

constexpr double kLeastSeconds = 5, kSecondsBetween = 2, kSecondsWithoutANumber = 60;

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

ProgressBar::ProgressBar(std::FILE* out, std::function<double()> clock)
    : out_(out), clock_(clock ? std::move(clock) : steadySeconds) {}

void ProgressBar::report(std::string_view stage, double fraction) {
  const int now = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kTicks);
  if (stage == stage_ && ticks_ == kTicks && now > 0) return;
  if (stage != stage_ || (now == 0 && ticks_ > 0)) {
    finishLine();
    stage_ = stage;
    ticks_ = -1;
    saidAt_ = clock_();
  }
  // Within a tick nothing is written: the clock is asked for ticks alone.
  if (now == ticks_) return;
  now_ = clock_();
  timeLeft_.report(stage, fraction, now_);
  advance(now);
}

void ProgressBar::sayTimeLeft() {
  const std::optional<double> left = timeLeft_.seconds();
  const double pause = ticks_ % 4 == 0 ? kSecondsBetween : kSecondsWithoutANumber;
  if (!left || *left < kLeastSeconds || now_ - saidAt_ < pause) return;
  saidAt_ = now_;
  const std::string text =
      " (" + TimeLeft::textOf(*left) + (timeLeft_.isOfCommand() ? " left)" : " left of this stage)");
  std::fputs(text.c_str(), out_);
}

void ProgressBar::advance(int ticks) {
  if (ticks <= ticks_) return;
  // Not fmt::print(), which throws where stderr is closed.
  if (ticks_ < 0) std::fputs((stage_ + " ").c_str(), out_);
  while (ticks_ < ticks) {
    ++ticks_;
    if (ticks_ % 4 == 0)
      std::fputs(std::to_string(ticks_ * 100 / kTicks).c_str(), out_);
    else
      std::fputc('.', out_);
  }
  if (ticks_ == kTicks)
    std::fputs(" - done.\n", out_);
  else
    sayTimeLeft();
  std::fflush(out_);
}

void ProgressBar::finishLine() {
  if (ticks_ >= 0) advance(kTicks);
}

void ProgressBar::endLine() {
  if (ticks_ < 0 || ticks_ == kTicks) return;
  std::fputc('\n', out_);
  ticks_ = -1;
  stage_.clear();
}

}  // namespace arete
