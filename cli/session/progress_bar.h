// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "cli/session/time_left.h"

namespace arete {

/// Progress as GDAL writes it, one line per stage: "build 0...10...20 ... 100 - done." Where the work takes
/// longer than some seconds, the time left is said behind a number, and every minute at most
/// in between: "30 (2 min left)...40".
class ProgressBar {
 public:
  /// @param clock seconds since any moment; the system's where it is empty
  explicit ProgressBar(std::FILE* out, std::function<double()> clock = {});
  ~ProgressBar() { endLine(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// The stages that follow each other from now on, for the time left. The span outlives this.
  void setPlan(std::span<const PlannedStage> plan) { timeLeft_.setPlan(plan); }

  /// Advances the line of a stage. A stage that begins, or begins again, finishes the line before.
  ///
  /// @param fraction done so far, 0 to 1.
  void report(std::string_view stage, double fraction);
  /// Completes the line: "100 - done."
  void finishLine();
  /// Breaks the line where it is, so that other text can follow.
  void endLine();

 private:
  void advance(int ticks);
  /// Says the time left, if it is known, long, and was not said just before.
  void sayTimeLeft();

  std::FILE* out_;
  std::string stage_;
  int ticks_ = -1;  // of 40 written so far; -1 = no line is open
  std::function<double()> clock_;
  TimeLeft timeLeft_;
  double now_ = 0,
         saidAt_ = 0;  // seconds: of the last report; of the last time left that was said, or of the stage
};

}  // namespace arete
