// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace arete::bench {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Precondition: not empty.
inline double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// How often a thing is timed: so many times, but no more once it has taken so long altogether.
struct Repetition {
  int most = 3;
  double enoughSeconds = 60;
};

/// Median seconds of work(), which is run at least once; what it returns is dropped outside the time.
template <class Work>
double medianSeconds(const Repetition& repetition, const Work& work) {
  std::vector<double> times;
  const Stopwatch all;
  do {
    const Stopwatch one;
    const auto result = work();
    times.push_back(one.seconds());
    static_cast<void>(result);
  } while (int(times.size()) < repetition.most && all.seconds() < repetition.enoughSeconds);
  return medianOf(times);
}

}  // namespace arete::bench
