// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "engine/base/result.h"
#include "io/geo/crs/longitude_turns.h"
#include "terrain/model/georeference.h"
#include "viewer/camera/flight.h"

namespace arete {

/// The flight that the user edits: key frames that are added one after the other, played, and kept in a file.
class FlightDeck {
 public:
  /// `metresPerSecond`: of flights without a stated speed or duration.
  FlightDeck(const CameraSpace& space, double metresPerSecond)
      : space_(space), usualSpeed_(metresPerSecond) {}

  const FlightPlan& plan() const { return plan_; }
  void setPlan(const FlightPlan& plan);

  /// Appends a key frame.
  void addKey(const Camera& camera);
  /// Precondition: index < keys.
  void removeKey(std::size_t index);
  void clear();

  /// Starts at the beginning. Errors: those of Flight::create().
  Status play();
  void stop() { time_.reset(); }
  bool isPlaying() const { return time_.has_value(); }
  double seconds() const { return time_.value_or(0); }
  double duration() const { return flight_ ? flight_->duration() : 0; }

  /// Advances the time. Stops at the end of a flight that is not closed.
  ///
  /// @return the camera at the new time; nothing if no flight is playing.
  std::optional<Camera> advance(double seconds);

  /// The flight through the current keys. Errors: those of Flight::create().
  Result<const Flight*> flight();

  /// Errors: those of flight_json.h; load() replaces the plan if it succeeds.
  Status save(const std::filesystem::path& path, const Georeference& dem) const;
  Status load(const std::filesystem::path& path, const Georeference& dem, const LongitudeTurns& turns = {});

 private:
  CameraSpace space_;
  double usualSpeed_;
  FlightPlan plan_;
  std::optional<Flight> flight_;  // of the plan; nothing after it changed
  std::optional<double> time_;
};

}  // namespace arete
