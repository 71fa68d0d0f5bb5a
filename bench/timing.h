// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "engine/base/stopwatch.h"

namespace arete::bench {

/// Precondition: not empty.
inline double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// The value that `part` (0..1) of them do not exceed. Precondition: not empty.
inline double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[std::size_t(part * double(values.size() - 1))];
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
