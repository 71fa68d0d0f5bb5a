// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/level_schedule.h"

#include <algorithm>

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = std::numeric_limits<float>::max();
/// The growth of the threshold does not fall below it, unless the stated one is smaller.
constexpr double kLeastGrowth = 0.015;
/// The part of the vertices that a useful level makes due: where costs are spread over many orders of
/// magnitude, hundreds of smaller steps would remove almost no vertex.
constexpr double kLeastDue = 0.02;
constexpr std::size_t kMostLevelsOfPass = 16;

}  // namespace

LevelSchedule::LevelSchedule(const ThresholdList& vertices, const Options& options)
    : vertices_(vertices),
      options_(options),
      sizeAtStart_(std::max<std::size_t>(vertices.size(), 1)),
      sizeBefore_(vertices.size()),
      threshold_(options.first) {}

double LevelSchedule::ratio() const {
  const double growth = options_.ratio - 1, left = double(vertices_.size()) / double(sizeAtStart_);
  return 1 + std::max(std::min(growth, kLeastGrowth), growth * left);
}

std::vector<double> LevelSchedule::pass(double span) const {
  std::vector<double> thresholds = {threshold_};
  const double step = ratio(), end = threshold_ * span;
  do  // once at least: on flat ground all thresholds are 0
    thresholds.push_back(std::min(thresholds.back() * step, kLargest));
  while (thresholds.size() <= kMostLevelsOfPass && thresholds.back() < end);
  return thresholds;
}

LevelSchedule::Step LevelSchedule::advanceTo(double next) {
  const double last = threshold_;
  const bool hasRemoved = vertices_.size() < sizeBefore_;
  sizeBefore_ = vertices_.size();
  hasChanged_ = hasChanged_ || hasRemoved;
  const bool mayRefresh = hasChanged_ && options_.gap < kInfinity;
  next = std::max(next, double{vertices_.quantile(kLeastDue)});
  if (!hasRemoved) {
    const double pending = vertices_.least();
    if (!(pending < kInfinity) && !mayRefresh) return Step::end;
    next = std::max(next, pending);
  }
  if (mayRefresh && next > options_.gap * last) {
    hasChanged_ = false;
    return Step::refresh;
  }
  threshold_ = std::min(next, kLargest);
  return Step::level;
}

}  // namespace arete
