// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "terrain/hole.h"

namespace arete {

/// The triangulation of a star polygon with the least largest vertical error, then the least sum of errors:
/// dynamic programming over the polygon's diagonals (Klincsek 1980, with the largest error in place of the
/// length).
///
/// A triangle is admitted when it turns counter-clockwise, is not thinner than the aspect bound and keeps the
/// limit. Triangles that all turn the same way and share the polygon's rim tile it, so nothing else needs
/// checking. Errors are found on demand and kept; a triangle beyond the best known filling is given up early.
///
/// Hole: maximum(i, j, m, limit). Empty when no triangulation keeps the limit; `leastError` is then a bound
/// from below of what any triangulation costs (infinite when the aspect bound alone leaves none), and the
/// error itself otherwise. O(corners^3), one error each at most.
template <class Polygon, class Hole>
HoleTriangulation triangulateHoleFidelity(const Polygon& polygon, int corners, const Hole& hole, double limit,
                                          double minimumAspect, double& leastError) {
  // Beyond the limit `worst` is a bound from below: errors given up early, sides not pursued.
  struct Best {
    double worst, sum;
    std::uint8_t apex;
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // best[i][j]: the polygon i, i + 1, ..., j with the diagonal (or rim edge) j -> i.
  std::array<std::array<Best, kMaxHoleCorners>, kMaxHoleCorners> best;
  for (int i = 0; i + 1 < corners; ++i) best[i][i + 1] = {0, 0, 0};
  for (int span = 2; span < corners; ++span) {
    for (int i = 0; i + span < corners; ++i) {
      const int j = i + span;
      Best& b = best[i][j];
      b = {kInfinity, kInfinity, 0};
      for (int m = i + 1; m < j; ++m) {
        const Best &left = best[i][m], &right = best[m][j];
        const double sides = left.worst > right.worst ? left.worst : right.worst;
        if (sides > b.worst) continue;
        const double sumOfSides = left.sum + right.sum;
        if (sides == b.worst && sumOfSides >= b.sum) continue;
        if (polygon.orientation(i, m, j) <= 0 || polygon.aspect(i, m, j) < minimumAspect) continue;
        double worst = sides, sum = sumOfSides;
        if (sides <= limit) {
          const double error = hole.maximum(i, m, j, b.worst < limit ? b.worst : limit);
          worst = error > sides ? error : sides;
          sum += error;
        }
        if (worst < b.worst || (worst == b.worst && sum < b.sum))
          b = {worst, sum, static_cast<std::uint8_t>(m)};
      }
    }
  }
  HoleTriangulation result;
  leastError = best[0][corners - 1].worst;
  if (!(leastError <= limit)) return result;
  std::array<std::array<std::uint8_t, 2>, kMaxHoleCorners> stack;
  int top = 0;
  stack[top++] = {0, static_cast<std::uint8_t>(corners - 1)};
  while (top > 0) {
    const auto [i, j] = stack[--top];
    if (j - i < 2) continue;
    const std::uint8_t m = best[i][j].apex;
    result.triangles[result.size++] = {i, m, j};
    stack[top++] = {i, m};
    stack[top++] = {m, j};
  }
  return result;
}

}  // namespace arete
