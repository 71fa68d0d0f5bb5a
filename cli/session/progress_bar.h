// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace arete {

/// Progress as GDAL writes it, one line per stage: "build 0...10...20 ... 100 - done."
class ProgressBar {
 public:
  explicit ProgressBar(std::FILE* out) : out_(out) {}
  ~ProgressBar() { endLine(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

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

  std::FILE* out_;
  std::string stage_;
  int ticks_ = -1;  // of 40 written so far; -1 = no line is open
};

}  // namespace arete
