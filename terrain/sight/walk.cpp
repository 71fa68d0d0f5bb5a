// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/sight/walk.h"

#include <algorithm>

#include "terrain/sight/cells.h"

namespace arete {
namespace {

/// Puts the walk's parameters into the judge's distances.
struct JudgeSink {
  const SightPiece& piece;
  SightJudge& judge;

  void terrain(double t0, double z0, double t1, double z1) {
    judge.terrain(piece.distance(t0), z0, piece.distance(t1), z1);
  }
  void gap(double t0, double t1) { judge.gap(piece.distance(t0), piece.distance(t1)); }
  bool isDone() const { return judge.isDone(); }
};

}  // namespace

SightRange rangeOver(const SightPiece& piece, double xMax, double yMax) {
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
  clip(piece.x, piece.dx, xMax);
  clip(piece.y, piece.dy, yMax);
  return range;
}

std::uint64_t judgeCells(const SightGrid& grid, const SightPiece& piece, SightRange range,
                         SightJudge& judge) {
  JudgeSink sink{piece, judge};
  return walkCells(grid, piece, range, sink);
}

}  // namespace arete
