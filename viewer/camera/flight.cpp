// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys are divided into runs: through keys that are apart the camera flies, at keys in one place it turns.
// Within a run everything is a function of one progress, metres flown or degrees turned; where the progress
// is smooth in time, so is everything else.
//
// Progress over time: from rest to full speed v the speed is v (3 u^2 - 2 u^3), u the part of the ease e
// gone, hence the way v e (u^3 - u^4 / 2), half of v e in all; then v; the end mirrors the beginning. A run
// of length L takes L / v + e. One too short for both ramps, L < v e, has ramps of L / v each.
//
// A duration is met by the one v for which the runs add up to it: their sum falls with v and is piecewise
// linear in 1 / v, so halving intervals finds it.
#include "viewer/camera/flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace arete {
namespace {

/// Of the size of the whole path: keys nearer to each other are at one place.
constexpr double kSamePlace = 1e-7;
/// Degrees: keys nearer to each other look the same way.
constexpr double kSameLook = 1e-6;

std::string keyName(std::size_t index) {
  return fmt::format("key frame {}", index + 1);
}

double distance(const Vec3& a, const Vec3& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// How far two keys at one place are apart, in degrees; twice the scale counts as about 20.
double turnBetween(const Camera& a, const Camera& b) {
  return std::hypot(std::remainder(b.azimuthDegrees - a.azimuthDegrees, 360), b.pitchDegrees - a.pitchDegrees,
                    b.verticalFieldOfViewDegrees - a.verticalFieldOfViewDegrees) +
         (a.parallelHeight > 0 && b.parallelHeight > 0
              ? 30 * std::abs(std::log(b.parallelHeight / a.parallelHeight))
              : 0);
}

Status checkKey(const Camera& key, const Vec3& place, std::size_t index) {
  const auto refuse = [&](const char* message) { return failure(ErrorCode::usage, message, keyName(index)); };
  // Beyond that squares overflow; no planet is as large.
  const auto isSane = [](double value) { return std::abs(value) < 1e100; };
  if (!(isSane(key.xy.x) && isSane(key.xy.y) && isSane(key.height) && isSane(place.x) && isSane(place.y) &&
        isSane(place.z)))
    return refuse("its position must be finite numbers");
  if (!isSane(key.azimuthDegrees)) return refuse("its azimuth must be a finite number of degrees");
  if (!(key.pitchDegrees >= -90 && key.pitchDegrees <= 90))
    return refuse("its pitch must lie between -90 and 90 degrees");
  if (!(key.verticalFieldOfViewDegrees > 0 && key.verticalFieldOfViewDegrees < 180))
    return refuse("its field of view must be above 0 and below 180 degrees");
  if (!(key.parallelHeight >= 0 && isSane(key.parallelHeight)))
    return refuse("the height of its parallel picture must be above 0 and finite");
  return {};
}

Status checkNumbers(const FlightPlan& plan) {
  const auto refuse = [](const char* message) { return failure(ErrorCode::usage, message, "flight"); };
  const auto isPositive = [](double value) { return value > 0 && std::isfinite(value); };
  if (plan.speed.has_value() == plan.duration.has_value())
    return refuse(plan.speed ? "both its speed and its duration are stated; leave one out"
                             : "either its speed or its duration must be stated");
  if (plan.speed && !isPositive(*plan.speed))
    return refuse("its speed must be a number of metres per second above 0");
  if (plan.duration && !isPositive(*plan.duration))
    return refuse("its duration must be a number of seconds above 0");
  if (!(plan.easeSeconds >= 0 && std::isfinite(plan.easeSeconds)))
    return refuse("its easing must be a number of seconds, 0 or more");
  if (!isPositive(plan.turnRate))
    return refuse("its turn rate must be a number of degrees per second above 0");
  if (!(plan.framesPerSecond > 0 && plan.framesPerSecond <= 1000))
    return refuse("its frames per second must be above 0 and at most 1000");
  if (plan.keys.size() < 2)
    return refuse(plan.keys.empty() ? "it has no key frame; it needs two at least"
                                    : "it has one key frame; it needs two at least");
  return {};
}

/// Part of a ramp's way after `u` of its time, in halves: 0 to 1.
double rampWay(double u) {
  return u * u * u * (2 - u);
}

}  // namespace

// Both ramps have the same form; without room for full speed they meet in the middle of the run.
double Flight::Run::progressAt(double time) const {
  const double t = std::clamp(time - start, 0.0, seconds), ramp = speed * ease / 2;
  if (t < ease) return ramp * rampWay(t / ease);
  if (t > seconds - ease) return length - ramp * rampWay((seconds - t) / ease);
  return std::clamp(ramp + speed * (t - ease), 0.0, length);
}

/// The progress rises with time, so halving finds the time: 60 halvings exhaust a double.
double Flight::Run::timeOf(double progress) const {
  if (progress <= 0) return start;
  if (progress >= length) return start + seconds;
  double low = start, high = start + seconds;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (progressAt(middle) < progress ? low : high) = middle;
  }
  return high;
}

// Places are compared in metric space, and what counts as one place depends on the extent of the whole path.
Result<Flight> Flight::create(FlightPlan plan, const CameraSpace& space) {
  ARETE_CHECK(checkNumbers(plan));
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < plan.keys.size(); ++i) {
    places.push_back(space.position(plan.keys[i]));
    ARETE_CHECK(checkKey(plan.keys[i], places[i], i));
    if ((plan.keys[i].parallelHeight > 0) != (plan.keys[0].parallelHeight > 0))
      return failure(ErrorCode::usage, "the first key frame has another projection", keyName(i));
  }
  Vec3 low = places[0], high = places[0];
  for (const Vec3& p : places) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double nearby = kSamePlace * distance(low, high);
  const auto isSamePlace = [&](std::size_t a, std::size_t b) {
    return distance(places[a], places[b]) <= nearby;
  };

  // Keys in one place get the same position to the bit, so that later comparisons of places can be exact.
  bool turnsOnTheSpot = false;
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (!isSamePlace(i - 1, i)) continue;
    if (turnBetween(plan.keys[i - 1], plan.keys[i]) <= kSameLook)
      return failure(ErrorCode::usage, fmt::format("it equals key frame {}; a flight needs a difference", i),
                     keyName(i));
    turnsOnTheSpot = true;
    places[i] = places[i - 1];
  }
  if (plan.isClosed) {
    if (turnsOnTheSpot || places.size() < 3)
      return failure(ErrorCode::usage, "a closed one needs three places at least and no turn on the spot",
                     "flight");
    if (isSamePlace(0, places.size() - 1))
      return failure(ErrorCode::usage,
                     "it is where the first one is; a closed flight returns there by itself",
                     keyName(places.size() - 1));
    plan.easeSeconds = 0;
  }

  // A closed flight returns to its first key, which is appended once more. Runs end where the flight changes
  // between flying and turning; neighbouring runs share a key.
  Flight flight(space);
  flight.plan_ = std::move(plan);
  std::vector<Camera> keys = flight.plan_.keys;
  if (flight.plan_.isClosed) {
    keys.push_back(keys.front());
    places.push_back(places.front());
  }
  for (std::size_t first = 0; first + 1 < keys.size();) {
    const auto isTurn = [&](std::size_t i) { return places[i] == places[i + 1]; };
    std::size_t last = first + 1;
    while (last + 1 < keys.size() && isTurn(last) == isTurn(first)) ++last;
    flight.addRun(first, last, keys, places);
    first = last;
  }
  ARETE_CHECK(flight.shareTime());
  return flight;
}

/// Azimuths are unwound, so that the camera turns the shorter way between two keys and passes north without a
/// jump.
void Flight::addRun(std::size_t first, std::size_t last, std::span<const Camera> keys,
                    std::span<const Vec3> places) {
  Run run;
  run.isTurn = places[first] == places[first + 1];
  run.place = places[first];
  std::vector<double> azimuths, pitches, fields, heights;
  for (std::size_t i = first; i <= last; ++i) {
    const double azimuth = keys[i].azimuthDegrees;
    azimuths.push_back(azimuths.empty() ? azimuth
                                        : azimuths.back() + std::remainder(azimuth - azimuths.back(), 360));
    pitches.push_back(keys[i].pitchDegrees);
    fields.push_back(keys[i].verticalFieldOfViewDegrees);
    heights.push_back(keys[i].parallelHeight);
    if (run.isTurn)
      run.atKeys.push_back(i == first ? 0 : run.atKeys.back() + turnBetween(keys[i - 1], keys[i]));
  }
  if (!run.isTurn) {
    run.path = PathCurve(places.subspan(first, last - first + 1), plan_.isClosed);
    const auto at = run.path.lengthsAtPoints();
    run.atKeys.assign(at.begin(), at.end());
    length_ += run.path.length();
  }
  run.length = run.atKeys.back();
  run.azimuth = MonotoneCurve(run.atKeys, azimuths, plan_.isClosed);
  run.pitch = MonotoneCurve(run.atKeys, pitches, plan_.isClosed);
  run.field = MonotoneCurve(run.atKeys, fields, plan_.isClosed);
  run.parallelHeight = MonotoneCurve(run.atKeys, heights, plan_.isClosed);
  runs_.push_back(std::move(run));
}

Status Flight::shareTime() {
  const double ease = plan_.easeSeconds;
  const auto secondsOf = [&](const Run& run, double perSecond) {
    return run.length / perSecond + std::min(ease, run.length / perSecond);
  };
  const auto sum = [&](bool ofTurns, double perSecond) {
    double seconds = 0;
    for (const Run& run : runs_)
      if (run.isTurn == ofTurns) seconds += secondsOf(run, perSecond);
    return seconds;
  };
  /// The rate at which the runs of one kind take a time.
  const auto rateFor = [&](bool ofTurns, double seconds) {
    double total = 0;
    for (const Run& run : runs_)
      if (run.isTurn == ofTurns) total += run.length;
    double low = total / seconds, high = 2 * total / seconds;
    for (int i = 0; i < 100; ++i) {
      const double middle = (low + high) / 2;
      (sum(ofTurns, middle) > seconds ? low : high) = middle;
    }
    return (low + high) / 2;
  };

  double turnRate = plan_.turnRate;
  if (length_ > 0 && plan_.speed) {
    speed_ = *plan_.speed;
  } else if (length_ > 0) {
    const double turning = sum(true, turnRate);
    if (!(turning < *plan_.duration))
      return failure(ErrorCode::usage,
                     fmt::format("its turns on the spot alone take {:.4g} of its {:.4g} seconds", turning,
                                 *plan_.duration),
                     "flight");
    speed_ = rateFor(false, *plan_.duration - turning);
  } else if (plan_.duration) {
    turnRate = rateFor(true, *plan_.duration);
  }

  keyTimes_ = {0};
  for (Run& run : runs_) {
    run.speed = run.isTurn ? turnRate : speed_;
    run.ease = std::min(ease, run.length / run.speed);
    run.seconds = secondsOf(run, run.speed);
    run.start = duration_;
    duration_ += run.seconds;
    for (std::size_t i = 1; i < run.atKeys.size(); ++i) keyTimes_.push_back(run.timeOf(run.atKeys[i]));
  }
  if (plan_.isClosed) keyTimes_.pop_back();
  if (!std::isfinite(duration_)) return failure(ErrorCode::usage, "it takes for ever", "flight");
  return {};
}

std::uint64_t Flight::frameCount(double framesPerSecond) const {
  // The last frame of a flight that stops shows its end; a closed one is then at its first frame again.
  const double frames = duration_ * (framesPerSecond > 0 ? framesPerSecond : plan_.framesPerSecond);
  if (!(frames < 1e15)) return static_cast<std::uint64_t>(1e15);
  return plan_.isClosed ? static_cast<std::uint64_t>(std::max(1.0, std::round(frames)))
                        : static_cast<std::uint64_t>(std::floor(frames + 1e-6)) + 1;
}

Camera Flight::at(double seconds) const {
  if (plan_.isClosed) seconds -= duration_ * std::floor(seconds / duration_);
  const auto after = std::ranges::upper_bound(runs_, seconds, {}, &Run::start);
  const Run& run = after == runs_.begin() ? runs_.front() : *std::prev(after);
  const double progress = run.progressAt(seconds);
  Camera camera = space_.at(plan_.keys.front(), run.isTurn ? run.place : run.path.at(progress));
  camera.azimuthDegrees = wrappedAzimuth(run.azimuth.at(progress));
  camera.pitchDegrees = run.pitch.at(progress);
  camera.verticalFieldOfViewDegrees = run.field.at(progress);
  camera.parallelHeight = run.parallelHeight.at(progress);
  return camera;
}

}  // namespace arete
