// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "terrain/sight/grid.h"
#include "terrain/sight/judge.h"

namespace arete {

/// A straight leg of a track: at the parameter t in [0, 1] it is at (x + t dx, y + t dy) in plan and at the
/// distance s + t ds.
struct SightLeg {
  double x = 0, y = 0, dx = 0, dy = 0;
  double s = 0, ds = 0;

  SightLeg(const SightPoint& from, const SightPoint& to)
      : x(from.plan.x),
        y(from.plan.y),
        dx(to.plan.x - from.plan.x),
        dy(to.plan.y - from.plan.y),
        s(from.distance),
        ds(to.distance - from.distance) {
    putOnLine(x, dx);
    putOnLine(y, dy);
  }
  double distance(double t) const { return s + t * ds; }
  /// Whether it leads from one side of the plan to the other where the ground goes on, as at the seam of
  /// longitudes: nothing lies below it.
  bool isJump() const { return ds == 0 && (dx != 0 || dy != 0); }

 private:
  /// Puts a leg onto a lattice line if it is nowhere off it by more than rounding.
  static void putOnLine(double& at, double& step) {
    const double line = std::round(at);
    if (std::fabs(at - line) > kShortestInPlan || std::fabs(at + step - line) > kShortestInPlan) return;
    at = line;
    step = 0;
  }
};

/// Parameters [first, last] of a leg; empty if first > last.
struct SightRange {
  double first = 0, last = 1;
};
/// @return the part of the leg over the box from (0, 0) to (xMax, yMax), its border included.
SightRange rangeOver(const SightLeg& leg, double xMax, double yMax);

/// @param p coordinate in plan units.
/// @param direction sign of the way from there.
/// @param size plan units along a square's side.
/// @param count number of squares; the result is clamped to them.
/// @return the number of the square that a line is in from p on.
inline int squareAt(double p, double direction, double size, int count) {
  const double place = p / size, below = std::floor(place);
  const int square = static_cast<int>(below) - (direction < 0 && below == place ? 1 : 0);
  return std::clamp(square, 0, count - 1);
}

/// Calls visit(column, row, t0, t1) for the squares below the part `range` of a leg, in order, until it
/// returns false [AmanatidesWoo1987]. Precondition: the leg has a length in plan. O(squares).
template <class Visit>
void forSquares(const SightLeg& leg, SightRange range, double size, int columns, int rows,
                const Visit& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const int columnStep = leg.dx < 0 ? -1 : 1, rowStep = leg.dy < 0 ? -1 : 1;
  int column = squareAt(leg.x + range.first * leg.dx, leg.dx, size, columns);
  int row = squareAt(leg.y + range.first * leg.dy, leg.dy, size, rows);
  const double perX = 1 / leg.dx, perY = 1 / leg.dy;
  double t = range.first;
  while (t <= range.last) {
    const double tx = leg.dx == 0 ? kNever : ((column + (columnStep > 0 ? 1 : 0)) * size - leg.x) * perX;
    const double ty = leg.dy == 0 ? kNever : ((row + (rowStep > 0 ? 1 : 0)) * size - leg.y) * perY;
    const double end = std::max(t, std::min(std::min(tx, ty), range.last));
    if (!visit(column, row, t, end) || !(end < range.last)) return;
    if (tx <= end) column += columnStep;
    if (ty <= end) row += rowStep;
    if (column < 0 || row < 0 || column >= columns || row >= rows) return;
    t = end;
  }
}

/// Reports to the judge all terrain and all gaps below the part `range` of a leg, cell by cell, in order, by
/// walkCells() of terrain/sight/cells.h. Precondition: the range is over the grid.
/// @return the number of cells visited.
std::uint64_t judgeCells(const SightGrid& grid, const SightLeg& leg, SightRange range, SightJudge& judge);

/// Calls inside(leg, range) for each leg of the judge's line that has a part over the grid, and reports the
/// rest to the judge: parts outside of the grid, and both ends, which may stand on single points of terrain.
template <class Inside>
void forLegs(const SightGrid& grid, SightJudge& judge, const Inside& inside) {
  const auto points = judge.line().points();
  if (grid.columns() < 2 || grid.rows() < 2) return judge.gap(0, points.back().distance);
  const auto addEnd = [&](const SightPoint& end) {
    const double z = grid.at(end.plan);
    if (!std::isnan(z) && !judge.isDone()) judge.terrain(end.distance, z, end.distance, z);
  };
  addEnd(points.front());
  for (std::size_t i = 1; i < points.size() && !judge.isDone(); ++i) {
    const SightLeg leg(points[i - 1], points[i]);
    if (leg.isJump()) continue;
    const double plan = std::hypot(leg.dx, leg.dy);
    if (!(plan > 0)) {
      const double z = grid.at(points[i].plan);
      if (std::isnan(z)) {
        judge.gap(leg.s, leg.distance(1));
      } else {
        judge.terrain(leg.s, z, leg.distance(1), z);
      }
      continue;
    }
    const SightRange range = rangeOver(leg, grid.columns() - 1, grid.rows() - 1);
    const double shortest = kShortestInPlan / plan;
    if (!(range.first <= range.last)) {
      judge.gap(leg.s, leg.distance(1));
      continue;
    }
    if (range.first > shortest) judge.gap(leg.s, leg.distance(range.first));
    inside(leg, range);
    if (1 - range.last > shortest) judge.gap(leg.distance(range.last), leg.distance(1));
  }
  addEnd(points.back());
}

}  // namespace arete
