// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an engine answers is held against a range of what may be true: one thing of one track, and, only where
// that fails, all between what is true of tracks that rounding does not tell apart.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "terrain/sight_pairs.h"

namespace arete::test {
namespace {

using Number = long double;

template <class... Values>
std::string textOf(const char* format, Values... values) {
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

/// What may be true: of one track one thing, of tracks that rounding does not tell apart all between theirs.
struct Range {
  static constexpr Number kNone = 1e300L;
  Number lowest = kNone, highest = -kNone;  ///< clearance
  Number leastGapInPlan = kNone, mostGapInPlan = 0, leastGapMetres = kNone, mostGapMetres = 0;
  std::optional<Number> firstGap, ceased, deep;
  Number lastFirstGap = 0;
  bool isAlwaysDeep = true;

  void add(const OracleAnswer& a) {
    const Number c = a.clearance.value_or(kNone);
    lowest = std::min(lowest, c);
    highest = std::max(highest, c);
    leastGapInPlan = std::min(leastGapInPlan, a.longestGapInPlan);
    mostGapInPlan = std::max(mostGapInPlan, a.longestGapInPlan);
    leastGapMetres = std::min(leastGapMetres, a.gapMetres);
    mostGapMetres = std::max(mostGapMetres, a.gapMetres);
    if (a.firstGap) {
      firstGap = std::min(firstGap.value_or(*a.firstGap), *a.firstGap);
      lastFirstGap = std::max(lastFirstGap, *a.firstGap);
    } else {
      lastFirstGap = kNone;
    }
    if (a.ceased) ceased = std::min(ceased.value_or(*a.ceased), *a.ceased);
    isAlwaysDeep &= a.deep.has_value();
    if (a.deep) deep = std::max(deep.value_or(*a.deep), *a.deep);
    if (!isAlwaysDeep) deep.reset();
  }
};

std::string wrongWithin(const SightOracle& oracle, const SightPair& pair, const SightOptions& options,
                        const SightAnswer& answer, const Range& truth) {
  const Number length = pair.track.points.back().distance;
  const Number metre = 1 / (Number)pair.unit, tolerance = (1e-6L + 1e-12L * length) * metre;
  // What the last bits of coordinates are worth on a line that is nearly a vertical one.
  const Vec2 p = pair.track.points.front().plan, q = pair.track.points.back().plan;
  const Number plan = std::hypot((Number)q.x - p.x, (Number)q.y - p.y);
  const Number bits = 2e-15L * (1 + std::fabs((Number)p.x) + std::fabs((Number)p.y));
  const Number slip = plan > 0 ? bits / plan * std::fabs((Number)pair.to - pair.from) : 0;
  const Number near = 2e-6L * metre + slip;
  const OracleLine line(length > 0 ? pair.track.curvature : 0, length, (Number)pair.from * pair.unit,
                        (Number)pair.to * pair.unit);
  constexpr Number kNone = Range::kNone;
  const Number c = truth.lowest;
  const bool isExactly = options.maxError == 0;

  // What may be said.
  bool mayBlock = truth.lowest < -tolerance / 2 + slip, mustBlock = truth.highest < -1.5L * tolerance - slip;
  const Number gap = truth.mostGapInPlan;
  const bool mayHaveGap = gap > 0.5e-9L,
             mustHaveGap = truth.leastGapInPlan > 1e-8L * std::max(1.0, pair.step);
  if (options.nodata == NodataSight::blocked) mayBlock |= mayHaveGap, mustBlock |= mustHaveGap;
  const bool countsGaps = options.nodata == NodataSight::unknown;
  const bool mayBeUnknown = countsGaps && mayHaveGap, mustBeUnknown = countsGaps && mustHaveGap;
  const std::string tells =
      textOf(" (the clearance is %.9Lg, the longest gap %.3Lg, tolerance %.3Lg)", c, gap, tolerance);
  switch (answer.verdict) {
    case SightVerdict::blocked:
      if (!mayBlock) return "blocked, and it is not" + tells;
      break;
    case SightVerdict::visible:
      if (mustBlock) return "visible, and it is blocked" + tells;
      if (mustBeUnknown) return "visible, and part of it is over no terrain" + tells;
      break;
    case SightVerdict::unknown:
      if (mustBlock) return "unknown, and it is blocked" + tells;
      if (!mayBeUnknown) return "unknown, and all of it is over terrain" + tells;
      break;
    case SightVerdict::undecided:
      if (isExactly) return "undecided, without a tolerance" + tells;
      break;
  }
  const bool isBlocked = answer.verdict == SightVerdict::blocked;
  if (answer.obstruction && !isBlocked) return "an obstruction, and it is not blocked";
  if (options.wantsObstruction && isBlocked && !answer.obstruction) return "blocked, and no obstruction";
  const Number slack = 1e-6L * length + 1e-7L;
  if (answer.obstruction && answer.isObstructionLatest) {
    if (isExactly) return "an obstruction of approximate terrain, without a tolerance" + tells;
    if (options.nodata != NodataSight::blocked && truth.ceased &&
        answer.obstruction->distance < *truth.ceased - slack)
      return textOf("approximate terrain is in the way at %.12g m, and none is before %.12Lg m",
                    answer.obstruction->distance, *truth.ceased);
  } else if (answer.obstruction) {
    const SightPlace& o = *answer.obstruction;
    const bool isOfGap = options.nodata == NodataSight::blocked && std::isnan(o.terrainHeight);
    if (isOfGap) {
      if (!truth.firstGap || o.distance < *truth.firstGap - slack || o.distance > truth.lastFirstGap + slack)
        return textOf("NODATA blocks at %.12g m, and the first gap is at %.12Lg m", o.distance,
                      truth.firstGap.value_or(-1));
      if (truth.deep && *truth.deep < o.distance - slack)
        return textOf("NODATA blocks, and terrain does so before, at %.12Lg m", *truth.deep);
    } else {
      if (!truth.ceased) return "blocked by terrain, and there is none in the way" + tells;
      const Number last = truth.deep.value_or(length);
      // The stretches of a tolerance are longer: where one begins on the line it may be told from there on.
      if ((isExactly && o.distance < *truth.ceased - slack) || o.distance > last + slack)
        return textOf("the first obstruction is at %.12g m, not between %.12Lg and %.12Lg m", o.distance,
                      *truth.ceased, last);
      if (options.nodata == NodataSight::blocked && mustHaveGap && truth.lastFirstGap < *truth.ceased - slack)
        return textOf("terrain blocks, and NODATA does so before, at %.12Lg m", truth.lastFirstGap);
      const auto z = oracle.heightAt(o.plan, 1e-8L * pair.step);
      if (!z) return textOf("the first obstruction is over no terrain, at %.12g, %.12g", o.plan.x, o.plan.y);
    }
    if (length > 0) {
      const Number h = line.height(o.distance) * metre;
      if (std::fabs(h - o.sightHeight) > near)
        return textOf("the line at the obstruction is at %.12Lg, not %.12g", h, o.sightHeight);
    }
  }
  if (!options.wantsClearance) {
    if (answer.clearance) return "a clearance that was not asked for";
    return {};
  }
  const bool mayHave = truth.lowest < kNone, mustHave = truth.highest < kNone;
  if (answer.clearance ? !mayHave : mustHave)
    return answer.clearance ? textOf("a clearance of %.9g where there is no terrain", *answer.clearance)
                            : textOf("no clearance where it is %.9Lg", c);
  if (!answer.clearance) return {};
  const Number within = near + answer.clearanceWithin;
  if (isExactly && answer.clearanceWithin != 0) return "a clearance within something, without a tolerance";
  if (*answer.clearance < truth.lowest - within || *answer.clearance > truth.highest + within)
    return textOf("a clearance of %.12g within %.3g, not %.12Lg", *answer.clearance, answer.clearanceWithin,
                  c);
  if (!isExactly) return {};
  const Number difference = (Number)answer.least.sightHeight - answer.least.terrainHeight;
  if (std::fabs(difference - *answer.clearance) > near)
    return textOf("heights %.12Lg apart at the least clearance, of %.12g", difference, *answer.clearance);
  if (length > 0 && std::fabs(line.height(answer.least.distance) * metre - answer.least.sightHeight) > near)
    return textOf("the line at the least clearance is not at %.12g", answer.least.sightHeight);
  if (const auto z = oracle.heightAt(answer.least.plan, 1e-8L * pair.step); !z)
    return "the least clearance is over no terrain";
  if (answer.verdict == SightVerdict::visible || answer.verdict == SightVerdict::unknown) {
    const bool isTouching = c <= tolerance;
    if (answer.verdict == SightVerdict::visible && answer.isTouching != isTouching &&
        std::fabs(c - tolerance) > tolerance / 2 + slip && truth.lowest == truth.highest)
      return textOf("touching is %d", int(answer.isTouching)) + tells;
  }
  const Number most = 1e-6L * length + 1e-6L;
  if (options.nodata != NodataSight::clear &&
      (answer.gapMetres < truth.leastGapMetres - most || answer.gapMetres > truth.mostGapMetres + most))
    return textOf("gaps of %.12g m, not %.12Lg m", answer.gapMetres, truth.mostGapMetres);
  return {};
}

}  // namespace

std::string wrong(const SightOracle& oracle, const SightPair& pair, const SightOptions& options,
                  const SightAnswer& answer, const OracleAnswer& truth) {
  Range range;
  range.add(truth);
  return wrongWithin(oracle, pair, options, answer, range);
}

std::string wrongBeyondRounding(const SightOracle& oracle, const SightPair& pair, const SightOptions& options,
                                const SightAnswer& answer, const OracleAnswer& truth, Rounding& rounding) {
  rounding = Rounding::none;
  std::string first = wrong(oracle, pair, options, answer, truth);
  if (first.empty()) return first;
  rounding = Rounding::another;
  Range all;
  all.add(truth);
  const auto isRight = [&](const SightPair& other, const SightOracle::Options& asked) {
    const OracleAnswer t = oracle.ask(other.track, other.from, other.to, other.unit, asked);
    all.add(t);
    return wrong(oracle, other, options, answer, t).empty();
  };
  if (isRight(pair, {.countsTouches = false})) return {};
  if (!pair.isExact) {
    const Vec2 at = pair.track.points[0].plan;
    const double e = 3e-9 * pair.step + 4e-16 * (std::fabs(at.x) + std::fabs(at.y));
    for (const double x : {0.0, e, -e})
      for (const double y : {0.0, e, -e}) {
        SightPair moved = pair;
        for (SightPoint& p : moved.track.points) p.plan = {p.plan.x + x, p.plan.y + y};
        for (const Number reach : {1e-18L, 1e-9L * pair.step})
          for (const bool counts : {true, false})
            for (const Number endReach : {0.0L, 1e-9L * pair.step})
              if (isRight(moved, {reach, counts, endReach})) return {};
      }
  }
  rounding = Rounding::between;
  if (wrongWithin(oracle, pair, options, answer, all).empty()) return {};
  return first;
}

}  // namespace arete::test
