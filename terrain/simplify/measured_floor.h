// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <limits>

#include "terrain/error/signed_bound.h"
#include "terrain/triangulation/data_dependent_hole.h"
#include "terrain/triangulation/delaunay_hole.h"

namespace arete {

/// The limit of an error that is needed exactly, however large it is.
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// A triangulation of a hole with the error of each triangle, a bound of the error's rounding error, and the
/// signed bound at its samples.
struct MeasuredFloor {
  HoleTriangulation triangulation;
  std::array<double, kMaxHoleCorners> errors, roundings;
  std::array<SignedBound, kMaxHoleCorners> bounds;

  bool isEmpty() const { return triangulation.size == 0; }
  void clear() { triangulation.size = 0; }
};

/// Measures a triangulation. Hole: maximum(i, j, m, limit, bound, rounding), the error of a triangle, its
/// bound included.
template <class Hole>
void measure(const Hole& hole, MeasuredFloor& floor) {
  for (int f = 0; f < floor.triangulation.size; ++f) {
    const auto [i, m, j] = floor.triangulation.triangles[f];
    floor.bounds[f] = {};
    floor.errors[f] = hole.maximum(i, m, j, kNoLimit, floor.bounds[f], floor.roundings[f]);
  }
}

/// DataDependentSearch::shortest(), each triangle measured once. Empty when no triangulation keeps the limit.
template <class Hole>
void fillShortest(int corners, const Hole& hole, double minimumAspect, double limit, MeasuredFloor& floor) {
  struct Measured {  // uninitialised until written
    double error, rounding, below, above;
  };
  std::array<std::array<Measured, kMaxHoleCorners>, kMaxHoleCorners> measured;  // of corners i < m < j
  DataDependentSearch search(corners, hole, minimumAspect);
  floor.triangulation = search.shortest(limit, [&](int i, int m, int j) {
    SignedBound bound;
    double rounding;
    const double error = hole.maximum(i, m, j, kNoLimit, bound, rounding);
    measured[i][j] = {error, rounding, bound.below, bound.above};
    return error;
  });
  for (int f = 0; f < floor.triangulation.size; ++f) {
    const auto& t = floor.triangulation.triangles[f];
    const auto& [error, rounding, below, above] = measured[t[0]][t[2]];
    floor.errors[f] = error;
    floor.roundings[f] = rounding;
    floor.bounds[f] = {below, above};
  }
}

}  // namespace arete
