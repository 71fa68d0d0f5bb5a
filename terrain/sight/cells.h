// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walks over the cells of a raster below a leg, from one lattice line to the next [AmanatidesWoo1987], and
// within a cell from one of its two triangles to the other where the leg crosses the diagonal. The surface is
// straight between these crossings, so heights are computed at crossings alone.
//
// A cell with NODATA is treated apart: with three corners, the part of the leg over their triangle is
// terrain. A leg that runs exactly along a lattice line is in no cell more than in its neighbour; there the
// edges below it are terrain if a triangle on either side is.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "terrain/sight/grid.h"
#include "terrain/sight/walk.h"

namespace arete {

/// Reports what is below a part of a leg to a sink, in order of the leg's parameter t:
///
///     terrain(t0, z0, t1, z1)   straight from z0 to z1, within one triangle or along one edge
///     gap(t0, t1)               no terrain
///
/// until its isDone() returns true. Heights are in the DEM's vertical unit.
template <class Sink>
class CellWalk {
 public:
  CellWalk(const SightGrid& grid, const SightLeg& leg, Sink& sink)
      : grid_(grid), leg_(leg), sink_(sink), shortest_(kShortestInPlan / std::hypot(leg.dx, leg.dy)) {}

  /// For a leg that does not run along a lattice line.
  /// @return the number of cells visited.
  std::uint64_t over(SightRange range) {
    std::uint64_t cells = 0;
    forSquares(leg_, range, 1, static_cast<int>(grid_.columns()) - 1, static_cast<int>(grid_.rows()) - 1,
               [&](int column, int row, double t0, double t1) {
                 cell(column, row, t0, t1);
                 ++cells;
                 return !sink_.isDone();
               });
    return cells;
  }

  /// For a leg that runs along a lattice line: along x if `isRow`.
  /// @return the number of edges visited.
  std::uint64_t along(SightRange range, bool isRow) {
    const double from = isRow ? leg_.x : leg_.y, d = isRow ? leg_.dx : leg_.dy;
    const auto line = static_cast<std::uint32_t>(isRow ? leg_.y : leg_.x);
    const int step = d < 0 ? -1 : 1;
    const int count = static_cast<int>(isRow ? grid_.columns() : grid_.rows()) - 1;
    int edge = squareAt(from + range.first * d, d, 1, count);
    std::uint64_t edges = 0;
    double t = range.first;
    while (true) {
      const double end = std::max(t, std::min((edge + (step > 0 ? 1 : 0) - from) / d, range.last));
      const auto e = static_cast<std::uint32_t>(edge);
      const double z0 = isRow ? grid_.height(e, line) : grid_.height(line, e);
      const double z1 = isRow ? grid_.height(e + 1, line) : grid_.height(line, e + 1);
      if (isCovered(e, line, isRow)) {
        const double a = std::clamp(from + t * d - edge, 0.0, 1.0),
                     b = std::clamp(from + end * d - edge, 0.0, 1.0);
        terrain(t, z0 + a * (z1 - z0), end, z0 + b * (z1 - z0));
      } else {
        gap(t, end);
      }
      ++edges;
      if (!(end < range.last) || sink_.isDone()) return edges;
      edge += step;
      if (edge < 0 || edge >= count) return edges;
      t = end;
    }
  }

 private:
  void terrain(double t0, double z0, double t1, double z1) { sink_.terrain(t0, z0, t1, z1); }
  void gap(double t0, double t1) {
    if (t1 - t0 > shortest_) sink_.gap(t0, t1);
  }

  void cell(int column, int row, double t0, double t1) {
    const double* upper = grid_.row(static_cast<std::uint32_t>(row)) + column;
    const double* lower = upper + grid_.columns();
    const SightCell cell{upper[0], upper[1], lower[0], lower[1]};
    const double x0 = inCell(leg_.x + t0 * leg_.dx - column), y0 = inCell(leg_.y + t0 * leg_.dy - row);
    const double x1 = inCell(leg_.x + t1 * leg_.dx - column), y1 = inCell(leg_.y + t1 * leg_.dy - row);
    if (!cell.isWhole()) return partialCell(cell, t0, x0, y0, t1, x1, y1);
    const double side0 = x0 - y0, side1 = x1 - y1;
    const double z0 = cell.at(x0, y0), z1 = cell.at(x1, y1);
    if (side0 * side1 >= 0) return terrain(t0, z0, t1, z1);
    const double f = side0 / (side0 - side1), t = t0 + f * (t1 - t0), x = x0 + f * (x1 - x0);
    const double z = cell.ul + x * (cell.lr - cell.ul);
    terrain(t0, z0, t, z);
    terrain(t, z, t1, z1);
  }

  void partialCell(const SightCell& cell, double t0, double x0, double y0, double t1, double x1, double y1) {
    if (cell.corners() < 3) return gap(t0, t1);
    // Outside by no more than rounding counts as on the border.
    const auto rounded = [](double in) { return std::fabs(in) < kShortestInPlan ? 0 : in; };
    const double in0 = rounded(cell.inside(x0, y0)), in1 = rounded(cell.inside(x1, y1));
    if (in0 <= 0 && in1 <= 0 && (in0 < 0 || in1 < 0)) return gap(t0, t1);
    double first = 0, last = 1;
    if (in0 < 0 && in1 > 0) first = in0 / (in0 - in1);
    if (in1 < 0 && in0 > 0) last = in0 / (in0 - in1);
    const auto mix = [](double a, double b, double f) { return f == 0 ? a : f == 1 ? b : a + f * (b - a); };
    const double ta = mix(t0, t1, first), tb = mix(t0, t1, last);
    gap(t0, ta);
    terrain(ta, cell.at(mix(x0, x1, first), mix(y0, y1, first)), tb,
            cell.at(mix(x0, x1, last), mix(y0, y1, last)));
    gap(tb, t1);
  }

  /// Whether the edge from sample e to e + 1 of a lattice line belongs to a triangle.
  bool isCovered(std::uint32_t e, std::uint32_t line, bool isRow) const {
    const auto sample = [&](std::uint32_t along, std::uint32_t across) {
      return isRow ? grid_.height(along, across) : grid_.height(across, along);
    };
    if (std::isnan(sample(e, line) + sample(e + 1, line))) return false;
    const auto hasEither = [&](std::uint32_t across) {
      return !std::isnan(sample(e, across)) || !std::isnan(sample(e + 1, across));
    };
    const std::uint32_t lines = isRow ? grid_.rows() : grid_.columns();
    return (line > 0 && hasEither(line - 1)) || (line + 1 < lines && hasEither(line + 1));
  }

  static double inCell(double v) { return std::clamp(v, 0.0, 1.0); }

  const SightGrid& grid_;
  const SightLeg& leg_;
  Sink& sink_;
  double shortest_;
};

/// Reports all terrain and all gaps below the part `range` of a leg to a sink (see CellWalk). Preconditions:
/// the range is within rangeOver() of the grid; the leg has a length in plan. O(cells).
/// @return the number of cells visited.
template <class Sink>
std::uint64_t walkCells(const SightGrid& grid, const SightLeg& leg, SightRange range, Sink& sink) {
  const auto runsAlong = [](double p, double d) { return d == 0 && p == std::floor(p); };
  CellWalk<Sink> walk(grid, leg, sink);
  if (runsAlong(leg.y, leg.dy)) return walk.along(range, true);
  if (runsAlong(leg.x, leg.dx)) return walk.along(range, false);
  return walk.over(range);
}

}  // namespace arete
