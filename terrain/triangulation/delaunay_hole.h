// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <span>

#include "engine/simplify/hole_triangles.h"

namespace arete {

/// Whether, of the two diagonals of four cocircular corners i < j < m < n, the one from i has the smaller
/// error at the apex. Either is Delaunay; a grid has many such corners, and the choice by height removes some
/// 1 % of the triangles of every cut. False if the apex lies outside the four.
template <class Hole>
bool isOtherDiagonalCloser(const Hole& hole, int i, int j, int m, int n) {
  if (hole.orientationToApex(i, j) < 0 || hole.orientationToApex(j, m) < 0 ||
      hole.orientationToApex(m, n) < 0 || hole.orientationToApex(n, i) < 0)
    return false;
  // The apex is equally likely on either side: corners are selected without a branch.
  const bool isFirst = hole.orientationToApex(j, n) >= 0, isLast = hole.orientationToApex(i, m) >= 0;
  const double asItIs = hole.apexError(isFirst ? i : j, isFirst ? j : m, n);
  const double other = hole.apexError(i, isLast ? m : j, isLast ? n : m);
  return other < asItIs * (1 - 1e-9);
}

/// The Delaunay triangulation of the hole that a vertex leaves in a Delaunay triangulation, if no border of
/// the domain lies between the corners: then the triangle on an edge is the one with the largest angle
/// opposite, whatever lies elsewhere, so each edge finds its third corner and splits the polygon in two.
/// Empty if some edge finds none. If a border lies between, the result may not be Delaunay: see
/// triangulateHoleDelaunay(). O(corners^2).
///
/// Hole: third(i, j, prefersLater), the corner between i and j with the largest angle among those that turn
/// left, -1 if there is none.
template <class Hole>
HoleTriangulation wrapHole(int corners, const Hole& hole) {
  HoleTriangulation result;
  std::array<std::array<std::uint8_t, 2>, kMaxHoleCorners> stack;
  int top = 0;
  stack[top++] = {0, static_cast<std::uint8_t>(corners - 1)};
  while (top > 0) {
    const auto [i, j] = stack[--top];
    const int m = hole.third(i, j, [&, i = i, j = j](int first, int later) {
      return isOtherDiagonalCloser(hole, i, first, later, j);
    });
    if (m < 0) return {};
    const auto middle = static_cast<std::uint8_t>(m);
    result.add(i, m, j);
    if (middle - i > 1) stack[top++] = {i, middle};
    if (j - middle > 1) stack[top++] = {middle, j};
  }
  return result;
}

/// Whether a triangulation by wrapHole() is locally Delaunay at every diagonal. Then it is the constrained
/// Delaunay triangulation of the polygon, which its triangles tile, as they all turn left. Exact.
template <class Polygon>
bool isLocallyDelaunay(const HoleTriangulation& wrapped, const Polygon& polygon) {
  // The corner between i and j, of the triangles on edges from a lower to a higher corner.
  std::array<std::array<std::uint8_t, kMaxHoleCorners>, kMaxHoleCorners> between;
  for (const auto& [i, m, j] : wrapped.view()) between[i][j] = m;
  const auto holds = [&](int a, int b, const std::array<std::uint8_t, 3>& t) {
    return b - a == 1 || polygon.inCircle(t[0], t[1], t[2], between[a][b]) <= 0;
  };
  for (const auto& t : wrapped.view())
    if (!holds(t[0], t[1], t) || !holds(t[1], t[2], t)) return false;
  return true;
}

/// Visits the triangles of wrapHole() one by one, that over the apex first: there the error is most often
/// largest, so that one or two triangles show whether a hole costs too much.
/// @param visit visit(i, m, j, isOverApex): returns whether to continue.
/// @return false if some edge finds no third corner; the visited triangles are then no triangulation.
template <class Hole, class Visit>
bool wrapHoleFromApex(int corners, const Hole& hole, const Visit& visit) {
  using Edge = std::array<std::uint8_t, 2>;
  std::array<Edge, kMaxHoleCorners> stack;
  std::array<std::array<std::uint8_t, 3>, kMaxHoleCorners> passed;  // on the way to the apex
  int top = 0, passedCount = 0;
  const auto third = [&](std::uint8_t i, std::uint8_t j) {
    return hole.third(i, j,
                      [&](int first, int later) { return isOtherDiagonalCloser(hole, i, first, later, j); });
  };
  const auto push = [&](std::uint8_t i, std::uint8_t j) {
    if (j - i > 1) stack[top++] = {i, j};
  };
  for (std::uint8_t i = 0, j = static_cast<std::uint8_t>(corners - 1);;) {
    const int found = third(i, j);
    if (found < 0) return false;
    const auto m = static_cast<std::uint8_t>(found);
    const bool isBeyondFirst = m - i > 1 && hole.orientationToApex(i, m) < 0;
    const bool isBeyondSecond = !isBeyondFirst && j - m > 1 && hole.orientationToApex(m, j) < 0;
    if (!isBeyondSecond) push(m, j);
    if (!isBeyondFirst) push(i, m);
    if (!isBeyondFirst && !isBeyondSecond) {
      if (!visit(i, m, j, true)) return true;
      break;
    }
    passed[passedCount++] = {i, m, j};
    (isBeyondFirst ? j : i) = m;
  }
  for (int k = 0; k < passedCount; ++k)
    if (!visit(passed[k][0], passed[k][1], passed[k][2], false)) return true;
  while (top > 0) {
    const auto [i, j] = stack[--top];
    const int found = third(i, j);
    if (found < 0) return false;
    const auto m = static_cast<std::uint8_t>(found);
    if (!visit(i, m, j, false)) return true;
    push(m, j);
    push(i, m);
  }
  return true;
}

/// Ear clipping of a polygon that is star-shaped about its apex (in its closure).
///
/// Corner i is an ear when it turns left and the apex is not to the right of the edge that would cut it off:
/// the ear then lies in the wedge seen from the apex between its neighbours, which has no other corner, and
/// the remaining polygon is star-shaped about the apex still ([Devillers2002], section 3). An ear exists: of
/// the two ears that every triangulated polygon has, at least one does not contain the apex.
///
/// Then flips inside the polygon [Lawson1977] make it constrained Delaunay: the hole's rim is kept, as a
/// domain with borders requires. If no vertex beyond the rim interferes, it is the Delaunay triangulation
/// itself.
///
/// Hole: polygon() with orientation(i, j, m), orientationToApex(i, j), inCircle(i, j, m, n), all exact;
/// orientationToApex(i, j); apexError(i, j, m), the error at the apex of a triangle over it. O(corners^2).
///
/// wrapHole() takes a quarter of the time. Its result is right if `isUnconstrained`: no border lies between
/// the corners of a hole in a Delaunay triangulation. Otherwise it is right if it is locally Delaunay, which
/// is checked; few holes fail.
template <class Hole>
HoleTriangulation triangulateHoleDelaunay(int corners, const Hole& hole, bool isUnconstrained) {
  assert(corners >= 3 && corners <= kMaxHoleCorners);
  const HoleTriangulation wrapped = wrapHole(corners, hole);
  if (wrapped.size > 0 && isUnconstrained) return wrapped;
  const auto polygon = hole.polygon();
  if (wrapped.size > 0 && isLocallyDelaunay(wrapped, polygon)) return wrapped;
  // third[i][j]: the corner across the directed edge i -> j. Only entries of present edges are read.
  std::array<std::array<std::uint8_t, kMaxHoleCorners>, kMaxHoleCorners> third;
  std::array<std::array<std::uint8_t, 2>, kMaxHoleCorners> diagonals;
  int diagonalCount = 0;

  std::array<std::uint8_t, kMaxHoleCorners> next{}, previous{};
  for (int i = 0; i < corners; ++i) {
    next[i] = static_cast<std::uint8_t>(i + 1 < corners ? i + 1 : 0);
    previous[i] = static_cast<std::uint8_t>(i > 0 ? i - 1 : corners - 1);
  }
  const auto put = [&](std::uint8_t i, std::uint8_t j, std::uint8_t m) {
    third[i][j] = m;
    third[j][m] = i;
    third[m][i] = j;
  };
  int remaining = corners, misses = 0;
  std::uint8_t i = 0;
  while (remaining > 3) {
    const std::uint8_t h = previous[i], j = next[i];
    if (polygon.orientation(h, i, j) > 0 && polygon.orientationToApex(h, j) >= 0) {
      put(h, i, j);
      diagonals[diagonalCount++] = {h, j};
      next[h] = j;
      previous[j] = h;
      --remaining;
      misses = 0;
      i = j;  // alternate sides rather than fan out from one corner
    } else {
      i = j;
      ++misses;
      assert(misses <= remaining && "a star-shaped polygon has an ear");
      if (misses > remaining) return {};
    }
  }
  if (polygon.orientation(previous[i], i, next[i]) <= 0) return {};
  put(previous[i], i, next[i]);

  // Repeated passes over the diagonals until each was tested since the last flip.
  for (int d = 0, unchanged = 0; unchanged < diagonalCount; d = d + 1 < diagonalCount ? d + 1 : 0) {
    const auto [a, b] = diagonals[d];
    const std::uint8_t m = third[a][b], n = third[b][a];
    const int inside = polygon.inCircle(a, b, m, n);
    bool flip = inside > 0;
    if (inside == 0) {
      std::array<int, 4> sorted{a, b, m, n};
      std::sort(sorted.begin(), sorted.end());
      const auto [s0, s1, s2, s3] = sorted;
      const bool isFromLeast = a == s0 || b == s0;  // the diagonal stands between the first and the third
      flip = isFromLeast ? isOtherDiagonalCloser(hole, s1, s2, s3, s0)
                         : isOtherDiagonalCloser(hole, s0, s1, s2, s3);
    }
    if (flip) {
      put(n, b, m);
      put(m, a, n);
      diagonals[d] = {n, m};
      unchanged = 1;
    } else {
      ++unchanged;
    }
  }

  HoleTriangulation result;
  const auto emit = [&](std::uint8_t a, std::uint8_t b) {
    const std::uint8_t c = third[a][b];
    if (a < b && a < c) result.add(a, b, c);
  };
  for (int a = 0; a < corners; ++a)
    emit(static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(a + 1 < corners ? a + 1 : 0));
  for (int d = 0; d < diagonalCount; ++d) {
    emit(diagonals[d][0], diagonals[d][1]);
    emit(diagonals[d][1], diagonals[d][0]);
  }
  assert(result.size == corners - 2);
  return result;
}

}  // namespace arete
