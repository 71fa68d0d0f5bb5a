// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/sight/walk.h"

#include <algorithm>

#include "terrain/sight/cells.h"

namespace arete {
namespace {

/// Converts parameters of the leg to the judge's distances.
struct JudgeSink {
  const SightLeg& leg;
  SightJudge& judge;

  void terrain(double t0, double z0, double t1, double z1) {
    judge.terrain(leg.distance(t0), z0, leg.distance(t1), z1);
  }
  void gap(double t0, double t1) { judge.gap(leg.distance(t0), leg.distance(t1)); }
  bool isDone() const { return judge.isDone(); }
};

}  // namespace

SightRange rangeOver(const SightLeg& leg, double xMax, double yMax) {
  SightRange range;
  const auto clip = [&](double p, double d, double high) {
    if (d == 0) {
      if (!(p >= 0 && p <= high)) range = {1, 0};
      return;
    }
    const double a = (0 - p) / d, b = (high - p) / d;
    range.first = std::max(range.first, std::min(a, b));
    range.last = std::min(range.last, std::max(a, b));
  };
  clip(leg.x, leg.dx, xMax);
  clip(leg.y, leg.dy, yMax);
  return range;
}

std::uint64_t judgeCells(const SightGrid& grid, const SightLeg& leg, SightRange range, SightJudge& judge) {
  JudgeSink sink{leg, judge};
  return walkCells(grid, leg, range, sink);
}

}  // namespace arete
