// SPDX-License-Identifier: GPL-3.0-or-later
//
// The weights are shares of the time of a build of the public DEMs of datasets/, on two threads. They matter
// for what follows a stage only, so that a weight that is twice too large is twice a small number.
#include "cli/session/time_left.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

constexpr double kShortest = 3;  // seconds before the first estimate
constexpr std::size_t kMostReports = 256;

/// Of terrain and of surfaces; a stage that a build does not have is passed over.
constexpr PlannedStage kBuild[] = {PlannedStage{"reading", 2},
                                   {"reading the mesh", 2},
                                   {"ranking features", 2},
                                   {"triangulate", 5},
                                   {"diagnose", 1},
                                   {"repair", 1},
                                   {"simplify", 80},
                                   {"finish", 8},
                                   {"pack", 3},
                                   {"checksum", 1},
                                   {"write", 4}};

}  // namespace

std::span<const PlannedStage> plannedStages(std::string_view command) {
  if (command == "build") return kBuild;
  return {};
}

void TimeLeft::report(std::string_view stage, double fraction, double seconds) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  if (stage != stage_ || reports_.empty() || fraction < reports_.back().second) {
    if (stage != stage_) {
      planned_ = next_;
      while (planned_ < plan_.size() && plan_[planned_].stage != stage) ++planned_;
      if (planned_ < plan_.size()) next_ = planned_ + 1;
    }
    stage_ = stage;
    reports_.clear();
    left_.reset();
    isSteady_ = false;
  }
  // Reports that add nothing are not kept; when there are many, every other one goes.
  if (reports_.empty() || fraction > reports_.back().second) reports_.emplace_back(seconds, fraction);
  if (reports_.size() > kMostReports) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < reports_.size(); i += 2) reports_[kept++] = reports_[i];
    reports_.resize(kept);
  }
  const std::optional<double> before = left_;
  left_ = estimate();
  isSteady_ = before && left_ && std::abs(*before - *left_) <= std::max(*before, *left_) / 3;
}

std::optional<double> TimeLeft::estimate() const {
  const auto [begin, first] = reports_.front();
  const auto [now, done] = reports_.back();
  const double middle = begin + (now - begin) / 2;
  if (now - begin < kShortest || done - first < 0.02) return std::nullopt;
  // The last report before the middle of the time, so that the speed is of half the time at least.
  const auto behind = std::ranges::upper_bound(reports_, middle, {}, &std::pair<double, double>::first);
  const auto& from = *(behind - 1);
  const double speed = (done - from.second) / (now - from.first);
  const double left = (1 - done) / speed;
  if (planned_ >= plan_.size()) return left;
  double later = 0;
  for (std::size_t i = planned_ + 1; i < plan_.size(); ++i) later += plan_[i].weight;
  return left + (now - begin + left) * later / plan_[planned_].weight;
}

std::string TimeLeft::textOf(double seconds) {
  constexpr double kMinute = 60;
  if (seconds < 57.5) return fmt::format("{} s", std::max(5.0, 5 * std::round(seconds / 5)));
  if (seconds < 59.5 * kMinute) return fmt::format("{} min", std::max(1.0, std::round(seconds / kMinute)));
  const double minutes = 10 * std::round(seconds / kMinute / 10);
  return fmt::format("{} h {} min", std::floor(minutes / 60), std::fmod(minutes, 60));
}

}  // namespace arete
