// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "terrain/sight/grid.h"
#include "terrain/sight/judge.h"

namespace arete {

/// A straight piece of a sight line over the plan: at parameter t in [0, 1] it is at (x + t dx, y + t dy) and
/// at the distance s + t ds.
struct SightPiece {
  double x = 0, y = 0, dx = 0, dy = 0;
  double s = 0, ds = 0;

  SightPiece(const SightPoint& from, const SightPoint& to)
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

 private:
  /// A piece that is nowhere off a lattice line by more than rounding runs along it.
  static void putOnLine(double& at, double& step) {
    const double line = std::round(at);
    if (std::fabs(at - line) > kShortestInPlan || std::fabs(at + step - line) > kShortestInPlan) return;
    at = line;
    step = 0;
  }
};

/// The part [first, last] of the piece's parameters over the box (0, 0)..(xMax, yMax), the border included;
/// first > last where there is none.
struct SightRange {
  double first = 0, last = 1;
};
SightRange rangeOver(const SightPiece& piece, double xMax, double yMax);

/// The squares of a lattice of `size` plan units that a line going that way is in from p on; of `count`.
inline int squareAt(double p, double direction, double size, int count) {
  const double place = p / size, below = std::floor(place);
  const int square = static_cast<int>(below) - (direction < 0 && below == place ? 1 : 0);
  return std::clamp(square, 0, count - 1);
}

/// Calls visit(column, row, t0, t1) for the squares under the part `range` of a piece, in order, until it
/// says false (Amanatides and Woo 1987). Precondition: the piece has a length in plan.
template <class Visit>
void forSquares(const SightPiece& piece, SightRange range, double size, int columns, int rows,
                const Visit& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const int columnStep = piece.dx < 0 ? -1 : 1, rowStep = piece.dy < 0 ? -1 : 1;
  int column = squareAt(piece.x + range.first * piece.dx, piece.dx, size, columns);
  int row = squareAt(piece.y + range.first * piece.dy, piece.dy, size, rows);
  const double perX = 1 / piece.dx, perY = 1 / piece.dy;
  double t = range.first;
  while (t <= range.last) {
    const double tx = piece.dx == 0 ? kNever : ((column + (columnStep > 0 ? 1 : 0)) * size - piece.x) * perX;
    const double ty = piece.dy == 0 ? kNever : ((row + (rowStep > 0 ? 1 : 0)) * size - piece.y) * perY;
    const double end = std::max(t, std::min(std::min(tx, ty), range.last));
    if (!visit(column, row, t, end) || !(end < range.last)) return;
    if (tx <= end) column += columnStep;
    if (ty <= end) row += rowStep;
    if (column < 0 || row < 0 || column >= columns || row >= rows) return;
    t = end;
  }
}

/// Tells the judge all terrain and all gaps below the part of a piece inside the grid, cell by cell, in
/// order: walkCells() of terrain/sight/cells.h. Returns how many cells it looked at.
std::uint64_t judgeCells(const SightGrid& grid, const SightPiece& piece, SightRange range, SightJudge& judge);

/// Calls inside(piece, range) for each piece of the line that has a part over the grid, and tells the judge
/// the rest: what has no terrain, and both ends, which may be all the terrain there is.
template <class Inside>
void forPieces(const SightGrid& grid, SightJudge& judge, const Inside& inside) {
  const auto points = judge.line().points();
  if (grid.columns() < 2 || grid.rows() < 2) return judge.gap(0, points.back().distance);  // no cell
  const auto tellEnd = [&](const SightPoint& end) {
    const double z = grid.at(end.plan);
    if (!std::isnan(z) && !judge.isDone()) judge.terrain(end.distance, z, end.distance, z);
  };
  tellEnd(points.front());
  for (std::size_t i = 1; i < points.size() && !judge.isDone(); ++i) {
    const SightPiece piece(points[i - 1], points[i]);
    const double plan = std::hypot(piece.dx, piece.dy);
    if (!(plan > 0)) {
      const double z = grid.at(points[i].plan);
      if (std::isnan(z)) {
        judge.gap(piece.s, piece.distance(1));
      } else {
        judge.terrain(piece.s, z, piece.distance(1), z);
      }
      continue;
    }
    const SightRange range = rangeOver(piece, grid.columns() - 1, grid.rows() - 1);
    const double shortest = kShortestInPlan / plan;
    if (!(range.first <= range.last)) {
      judge.gap(piece.s, piece.distance(1));
      continue;
    }
    if (range.first > shortest) judge.gap(piece.s, piece.distance(range.first));
    inside(piece, range);
    if (1 - range.last > shortest) judge.gap(piece.distance(range.last), piece.distance(1));
  }
  tellEnd(points.back());
}

}  // namespace arete
