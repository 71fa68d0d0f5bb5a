// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace arete {

/// The times of the last frames, for a graph.
class FrameHistory {
 public:
  static constexpr std::size_t kFrames = 180;

  /// `work`: time of cutting and drawing; `whole`: time from frame to frame, with waiting for the screen.
  void add(double workMilliseconds, double wholeMilliseconds) {
    work_[next_] = float(workMilliseconds);
    whole_[next_] = float(wholeMilliseconds);
    next_ = (next_ + 1) % kFrames;
    count_ = std::min(count_ + 1, kFrames);
  }
  /// Mean over the last half second; 0 before the first frame.
  double framesPerSecond() const {
    double sum = 0;
    std::size_t frames = 0;
    while (frames < count_ && sum < 500) sum += whole_[(next_ + kFrames - ++frames) % kFrames];
    return sum > 0 ? 1000 * double(frames) / sum : 0;
  }
  double lastWork() const { return count_ > 0 ? work_[(next_ + kFrames - 1) % kFrames] : 0; }
  double mostWork() const { return *std::max_element(work_.begin(), work_.end()); }

  /// Rings; the oldest is at first().
  const std::array<float, kFrames>& work() const { return work_; }
  std::size_t first() const { return next_; }

 private:
  std::array<float, kFrames> work_{}, whole_{};
  std::size_t next_ = 0, count_ = 0;
};

}  // namespace arete
