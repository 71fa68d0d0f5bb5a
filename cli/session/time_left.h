// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace arete {

/// A stage of a command and the share of the time that it takes, as it was measured.
struct PlannedStage {
  std::string_view stage;
  double weight;
};

/// The stages of a command in their order; empty where they are not known.
std::span<const PlannedStage> plannedStages(std::string_view command);

/// Estimates how long a command still takes. Within a stage the speed of its second half so far counts, so
/// that a stage may become slower; the stages behind it take as much longer than it as their weights say.
class TimeLeft {
 public:
  void setPlan(std::span<const PlannedStage> plan) { plan_ = plan; }

  /// @param fraction of the stage that is done; one below the last begins a stage of the same name anew
  /// @param seconds since any moment
  void report(std::string_view stage, double fraction, double seconds);

  /// Seconds left after the last report. Nothing before the stage has run for three seconds and two
  /// estimates in a row agree within a third.
  std::optional<double> seconds() const { return isSteady_ ? left_ : std::nullopt; }

  /// Whether seconds() includes what follows the stage; else it is of the stage alone.
  bool isOfCommand() const { return planned_ < plan_.size(); }

  /// "40 s", "3 min", "1 h 20 min": no more digits than an estimate has.
  static std::string textOf(double seconds);

 private:
  std::optional<double> estimate() const;

  std::span<const PlannedStage> plan_;
  std::size_t planned_ = 0,
              next_ = 0;  // index of the stage in the plan, size() = not in it; where to look on
  std::string stage_;
  std::deque<std::pair<double, double>> reports_;  // seconds and fraction, of this stage
  std::optional<double> left_;
  bool isSteady_ = false;
};

}  // namespace arete
