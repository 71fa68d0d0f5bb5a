// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/symmetric3.h"
#include "engine/base/vec.h"

namespace arete {

/// Solves A x = right for unknowns of three numbers by conjugate gradients with diagonal blocks as
/// preconditioner. Deterministic. O(steps * (unknowns + multiply)).
/// @param multiply   multiply(x, y) stores A x in y; A is symmetric and positive semidefinite
/// @param inverses   by unknown: the inverse of A's diagonal block
/// @param accuracy   ends where the preconditioned residual is this part of its first value
template <class Multiply>
std::vector<Vec3> conjugateGradients(const Multiply& multiply, std::span<const Symmetric3> inverses,
                                     std::vector<Vec3> right, double accuracy, int mostSteps) {
  const std::size_t count = right.size();
  const auto dotOf = [&](const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += dot(a[i], b[i]);
    return sum;
  };
  std::vector<Vec3> x(count, Vec3{0, 0, 0}), left = std::move(right), smooth(count), product(count);
  const auto precondition = [&] {
    for (std::size_t v = 0; v < count; ++v) smooth[v] = times(inverses[v], left[v]);
    return dotOf(left, smooth);
  };
  double size = precondition();
  std::vector<Vec3> way = smooth;
  const double enough = size * accuracy * accuracy;
  for (int step = 0; step < mostSteps && size > enough; ++step) {
    multiply(std::span<const Vec3>(way), std::span<Vec3>(product));
    const double curvature = dotOf(way, product);
    if (!(curvature > 0)) break;
    const double length = size / curvature;
    for (std::size_t v = 0; v < count; ++v) {
      x[v] = x[v] + length * way[v];
      left[v] = left[v] - length * product[v];
    }
    const double next = precondition();
    for (std::size_t v = 0; v < count; ++v) way[v] = smooth[v] + next / size * way[v];
    size = next;
  }
  return x;
}

}  // namespace arete
