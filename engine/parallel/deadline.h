// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <functional>
#include <utility>

namespace arete {

/// When to stop refining. It is checked before every modification, so it is exceeded by one at most.
class Deadline {
 public:
  /// A deadline that lies this far ahead.
  static Deadline in(std::chrono::duration<double, std::milli> time) {
    const auto end = std::chrono::steady_clock::now() + time;
    return Deadline([end] {
      return std::chrono::duration<double, std::milli>(end - std::chrono::steady_clock::now()).count();
    });
  }
  /// A deadline by the caller's clock. @param millisecondsLeft  returns the time left; must not increase
  explicit Deadline(std::function<double()> millisecondsLeft) : left_(std::move(millisecondsLeft)) {}

  double millisecondsLeft() const { return left_(); }
  bool isOver() const { return left_() <= 0; }

 private:
  std::function<double()> left_;
};

}  // namespace arete
