// SPDX-License-Identifier: GPL-3.0-or-later
//
// The horizon over a cell is the root of the least clearance of the line to the cell, as a function of the
// line's tangent. Newton's method: aim at the ground, then over the obstacle that is highest above that line,
// and so on. The clearance is the minimum of functions that rise with the tangent, so no step passes the
// horizon and each step clears at least one obstacle. Three or four steps suffice.
#include "terrain/viewshed/exact.h"

#include <cmath>
#include <numbers>

#include "terrain/sight/walk.h"

namespace arete {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

ViewshedCell cellOf(SightVerdict verdict) {
  switch (verdict) {
    case SightVerdict::visible:
      return ViewshedCell::seen;
    case SightVerdict::blocked:
      return ViewshedCell::hidden;
    case SightVerdict::unknown:
      return ViewshedCell::unknown;
    default:
      return ViewshedCell::undecided;
  }
}

bool isInRange(const ViewshedField& field, double distance) {
  return distance >= field.leastMetres && distance <= field.greatestMetres;
}

}  // namespace

bool isInField(const ViewshedField& field, double distance, double azimuthDegrees) {
  if (!isInRange(field, distance)) return false;
  if (field.azimuthSpan >= 360 || distance == 0) return true;
  double turn = std::fmod(azimuthDegrees - field.fromAzimuth, 360);
  if (turn < 0) turn += 360;
  return turn <= field.azimuthSpan;
}

Result<ViewshedExact::Answer> ViewshedExact::at(Vec2 plan, double ground) const {
  if (std::isnan(ground)) return Answer{};
  // A cell that is surely out of range needs no track.
  constexpr double kRounding = 1e-9;
  if (std::isfinite(options_.field.greatestMetres))
    if (const auto distance = earth_.distance(observer_.plan, plan);
        distance && *distance * (1 - kRounding) > options_.field.greatestMetres)
      return Answer{};
  Result<SightTrack> track = earth_.track(observer_.plan, plan);
  if (!track) {
    const auto distance = earth_.distance(observer_.plan, plan);
    if (distance && !isInRange(options_.field, *distance)) return Answer{};
    if (track.error().code != ErrorCode::invalidData) return tl::unexpected(track.error());
    ++withoutLine_;
    return Answer{.cell = ViewshedCell::unknown};
  }
  const double distance = track->points.back().distance, target = ground + options_.targetHeight;
  ARETE_CHECK(checkSightHeights(*track, observer_.height, target, unit_));
  const ViewshedField& field = options_.field;
  if (!isInField(field, distance, track->azimuthDegrees)) return Answer{};
  if (distance > 0 && (field.lowest > -90 || field.highest < 90)) {
    const double elevation = kDegrees * std::atan(sightTangent(track->curvature, observer_.height * unit_,
                                                               distance, target * unit_));
    if (!(elevation >= field.lowest && elevation <= field.highest)) return Answer{};
  }
  Answer answer;
  if (options_.value != ViewshedValue::none) answer.value = value(*track, ground);
  const SightLine line(std::move(*track), observer_.height, target, unit_);
  answer.cell = cellOf(
      engine_
          .answer(line, {.nodata = options_.nodata, .maxError = options_.maxError, .wantsClearance = false})
          .verdict);
  return answer;
}

float ViewshedExact::value(const SightTrack& track, double ground) const {
  const bool isHorizon = options_.value == ViewshedValue::horizon;
  const double k = track.curvature, length = track.points.back().distance, from = observer_.height * unit_;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  // Obstacles nearer than this are at the observer itself, where rounded heights give no tangent.
  const Vec2 there = track.points.back().plan;
  const double shortest =
      kShortestInPlan * length / std::hypot(there.x - observer_.plan.x, there.y - observer_.plan.y);
  double height = ground;
  for (int step = 0; step < 64; ++step) {
    const SightLine line(track, observer_.height, height, unit_);
    const SightAnswer answer = engine_.answer(line, {.nodata = options_.nodata, .wantsClearance = true});
    if (options_.nodata == NodataSight::blocked &&
        (answer.gapMetres > 0 || (answer.obstruction && std::isnan(answer.obstruction->terrainHeight)))) {
      height = kInfinite;
      break;
    }
    // Lines to all heights pass over the same NODATA, so no height is known. It may be a single point, where
    // two voids touch.
    if (!isHorizon && options_.nodata == NodataSight::unknown &&
        (answer.gapMetres > 0 || answer.verdict == SightVerdict::unknown))
      return std::numeric_limits<float>::quiet_NaN();
    if (!answer.clearance || *answer.clearance >= (step == 0 ? -line.tolerance() : 0)) break;
    const SightPlace& least = answer.least;
    if (!(least.distance > shortest)) {
      if (*answer.clearance < -line.tolerance()) height = kInfinite;
      break;
    }
    const double next =
        sightHeight(k, from, length, sightTangent(k, from, least.distance, least.terrainHeight * unit_)) /
        unit_;
    if (!(next > height)) break;
    height = next;
    if (height == kInfinite) break;
  }
  if (!isHorizon) return static_cast<float>(height - ground);
  if (!(length > 0)) return std::numeric_limits<float>::quiet_NaN();
  if (height == kInfinite) return std::numeric_limits<float>::infinity();
  return static_cast<float>(sightTangent(k, from, length, height * unit_));
}

}  // namespace arete
