// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace arete {

/// Progress in GDAL's manner, one line per stage: "build 0...10...20 ... 100 - done."
class ProgressBar {
 public:
  explicit ProgressBar(std::FILE* out) : out_(out) {}
  ~ProgressBar() { endLine(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// A stage that begins, the same one again too, says that the one before is done.
  void report(std::string_view stage, double fraction);
  /// Fills the line up to 100 - done.
  void finishLine();
  /// Leaves a line that is not done, for somebody else to write.
  void endLine();

 private:
  void advance(int ticks);

  std::FILE* out_;
  std::string stage_;
  int ticks_ = -1;  // of 40 written so far; -1 = no line is open
};

}  // namespace arete
