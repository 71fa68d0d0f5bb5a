// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <limits>

namespace arete {

/// A sum of squares of what is linear over a triangle, without its constant: (u, v) are the shares of the
/// second and the third corner.
struct SquaresOverTriangle {
  double uu = 0, uv = 0, vv = 0, u = 0, v = 0;

  void add(double weight, double alongU, double alongV, double wanted) {
    uu += weight * alongU * alongU;
    uv += weight * alongU * alongV;
    vv += weight * alongV * alongV;
    u += weight * alongU * wanted;
    v += weight * alongV * wanted;
  }
  SquaresOverTriangle plus(double times, const SquaresOverTriangle& o) const {
    return {uu + times * o.uu, uv + times * o.uv, vv + times * o.vv, u + times * o.u, v + times * o.v};
  }
  double at(double x, double y) const { return x * (uu * x + 2 * uv * y - 2 * u) + y * (vv * y - 2 * v); }

  /// The shares where it is least: inside, or on a side.
  std::array<double, 3> least() const {
    const double determinant = uu * vv - uv * uv;
    if (determinant > 0) {
      const double x = (u * vv - v * uv) / determinant, y = (v * uu - u * uv) / determinant;
      if (x >= 0 && y >= 0 && x + y <= 1) return {1 - x - y, x, y};
    }
    std::array<double, 2> best{};
    double lowest = std::numeric_limits<double>::infinity();
    const auto trySide = [&](double fromX, double fromY, double dx, double dy) {
      const double square = uu * dx * dx + 2 * uv * dx * dy + vv * dy * dy;
      const double slope = (u - uu * fromX - uv * fromY) * dx + (v - uv * fromX - vv * fromY) * dy;
      const double t = square > 0 ? std::clamp(slope / square, 0.0, 1.0) : 0;
      const double x = fromX + t * dx, y = fromY + t * dy, value = at(x, y);
      if (!(value < lowest)) return;
      lowest = value;
      best = {x, y};
    };
    trySide(0, 0, 1, 0);
    trySide(0, 0, 0, 1);
    trySide(1, 0, -1, 1);
    return {std::max(0.0, 1 - best[0] - best[1]), best[0], best[1]};
  }
};

}  // namespace arete
