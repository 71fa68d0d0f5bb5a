// SPDX-License-Identifier: GPL-3.0-or-later
//
// The judge keeps two results: the first place where the terrain is above the line by more than the
// tolerance, and the place of the least clearance. Until the first is found, terrain matters if it could be
// either; afterwards only if it could be the second. limit_ expresses that: terrain matters if its clearance
// is less.
#include "terrain/sight/judge.h"

#include <cmath>

namespace arete {
namespace {

/// The first distance in [s0, s1] where the line is no longer above the terrain, by bisection. Precondition:
/// the line is below the terrain at `inside`. The difference is convex, so if it is positive at s0 it falls
/// from there to its first zero.
double firstUnder(const SightLine& line, double s0, double z0, double s1, double z1, double inside) {
  const double rise = s1 > s0 ? (z1 - z0) / (s1 - s0) : 0;
  double low = s0, high = inside;
  if (line.height(s0) - z0 <= 0) return s0;
  for (int i = 0; i < 60; ++i) {
    const double s = low + (high - low) / 2;
    if (!(s > low && s < high)) break;
    (line.height(s) - (z0 + rise * (s - s0)) > 0 ? low : high) = s;
  }
  return high;
}

}  // namespace

SightJudge::SightJudge(const SightLine& line, const SightOptions& options)
    : line_(line), options_(options), countsGaps_(options.nodata != NodataSight::clear) {
  setLimit();
}

void SightJudge::setLimit() {
  // If the clearance is not wanted, only an obstruction can still change the answer.
  if (!options_.wantsClearance) {
    limit_ = -line_.tolerance();
    return;
  }
  limit_ = std::min(most_, hint_ + line_.tolerance());
  if (!obstruction_) limit_ = std::max(limit_, -line_.tolerance());
}

void SightJudge::hint(double s, double z) {
  if (!options_.wantsClearance) return;
  hint_ = std::min(hint_, line_.height(s) - z);
  setLimit();
}

void SightJudge::take(double s0, double z0, double s1, double z1, double lower, double higher) {
  const SightLine::Least found = line_.least(s0, z0, s1, z1);
  const double terrain = s1 > s0 ? z0 + (z1 - z0) * ((found.distance - s0) / (s1 - s0)) : z0;
  // Terrain within a tolerance gives the clearance two bounds: least_ if it is higher, most_ if it is lower.
  least_ = std::min(least_, found.clearance - higher);
  if (found.clearance + lower < most_) {
    most_ = found.clearance + lower;
    leastAt_ = found.distance;
    leastTerrain_ = terrain;
  }
  if (!obstruction_ && found.clearance - higher < -line_.tolerance()) {
    // An obstruction is certain only if even the lowest possible terrain reaches over the line.
    if (found.clearance + lower < -line_.tolerance()) {
      const double s = firstUnder(line_, s0, z0 - lower, s1, z1 - lower, found.distance);
      const double t = s1 > s0 ? (s - s0) / (s1 - s0) : 0;
      obstruction_ = SightPlace{s, line_.planAt(s), z0 + t * (z1 - z0), line_.height(s)};
      isObstructionLatest_ = mayBeBlocked_ || lower > 0 || higher > 0;
      if (!options_.wantsClearance) isDone_ = true;
    } else {
      mayBeBlocked_ = true;
    }
  }
  setLimit();
}

void SightJudge::gap(double s0, double s1) {
  if (!countsGaps_) return;
  hasGap_ = true;
  gap_ += s1 - s0;
  if (options_.nodata != NodataSight::blocked || obstruction_) return;
  obstruction_ = SightPlace{s0, line_.planAt(s0), std::nan(""), line_.height(s0)};
  isObstructionLatest_ = mayBeBlocked_;
  if (!options_.wantsClearance) isDone_ = true;
  setLimit();
}

SightAnswer SightJudge::answer(std::uint64_t visited) const {
  SightAnswer answer;
  answer.visited = visited;
  answer.gapMetres = gap_;
  answer.obstruction = obstruction_;
  answer.isObstructionLatest = isObstructionLatest_;
  if (options_.wantsClearance && most_ < kNone) {
    // The stated clearance is the middle of its bounds.
    answer.clearance = least_ / 2 + most_ / 2;
    answer.clearanceWithin = (most_ - least_) / 2;
    answer.least = {leastAt_, line_.planAt(leastAt_), leastTerrain_, line_.height(leastAt_)};
  }
  if (obstruction_) {
    answer.verdict = SightVerdict::blocked;
  } else if (mayBeBlocked_) {
    answer.verdict = SightVerdict::undecided;
  } else if (hasGap_ && options_.nodata == NodataSight::unknown) {
    answer.verdict = SightVerdict::unknown;
  } else {
    answer.isTouching = answer.clearance && *answer.clearance <= line_.tolerance();
  }
  return answer;
}

}  // namespace arete
