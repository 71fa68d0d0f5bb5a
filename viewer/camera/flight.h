// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "viewer/camera/camera_space.h"
#include "viewer/camera/monotone_curve.h"
#include "viewer/camera/path_curve.h"

namespace arete {

/// A flight as a person states it (docs/topics/flights.md).
struct FlightPlan {
  std::vector<Camera> keys = {};        ///< the key frames; the first one's picture size is that of all
  std::optional<double> speed = {};     ///< metres per second; this
  std::optional<double> duration = {};  ///< or this, seconds
  double easeSeconds = 1;               ///< from standing still to full speed, and back
  double turnRate = 20;                 ///< degrees per second, where the camera turns on the spot
  bool isClosed = false;                ///< from the last key back to the first, at full speed, for ever
  double framesPerSecond = 60;          ///< of a film
};

/// A camera's way through key frames at a steady speed.
///
/// Positions lie on a PathCurve, in metric space; azimuth (the shorter way round), pitch and field of view on
/// monotone curves of the distance gone, so that they never leave what two neighbouring keys say, and a
/// camera never rolls. The time of each key comes from its distance along the path. Between keys at one place
/// the camera stands and turns, and time comes from the angle. Position and direction are continuous; so is
/// their speed where easeSeconds > 0, or the flight has no such turn.
class Flight {
 public:
  /// Errors: usage, a number that makes no sense, fewer than two key frames, two equal ones one after the
  /// other; a closed flight with fewer than three places or with a turn on the spot; a duration that its
  /// turns use up. The culprit is "key frame N", from 1. O(keys).
  static Result<Flight> create(FlightPlan plan, const CameraSpace& space);

  const FlightPlan& plan() const { return plan_; }
  double duration() const { return duration_; }      ///< seconds
  double length() const { return length_; }          ///< metres
  double metresPerSecond() const { return speed_; }  ///< between the easings; 0 where it only turns
  std::span<const double> keyTimes() const { return keyTimes_; }  ///< seconds, of each key of the plan
  /// Of a film: frame i stands at i / framesPerSecond, the plan's where it is 0.
  std::uint64_t frameCount(double framesPerSecond = 0) const;

  /// Before the start the first key, behind the end the last; a closed flight goes round. O(log keys).
  Camera at(double seconds) const;

 private:
  /// Keys without a stop between them: flown through, or turned through on the spot.
  struct Run {
    bool isTurn = false;
    PathCurve path;                       // empty for a turn
    Vec3 place;                           // of a turn
    MonotoneCurve azimuth, pitch, field;  // of metres, or of degrees turned
    MonotoneCurve parallelHeight;
    std::vector<double> atKeys;  // metres or degrees
    double length = 0;           // the last of them
    double speed = 0, ease = 0;  // per second; seconds
    double start = 0, seconds = 0;

    double progressAt(double time) const;
    double timeOf(double progress) const;
  };

  explicit Flight(const CameraSpace& space) : space_(space) {}
  void addRun(std::size_t first, std::size_t last, std::span<const Camera> keys,
              std::span<const Vec3> places);
  Status shareTime();

  CameraSpace space_;
  FlightPlan plan_;
  std::vector<Run> runs_;
  std::vector<double> keyTimes_;
  double duration_ = 0, length_ = 0, speed_ = 0;
};

}  // namespace arete
