// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sum over normals of small mirrors, as many near each other as the surface has: then every mirror counts
// alike but for its shadows.
#include "viewer/surface/reflected_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arete {
namespace {

std::array<float, 2> reflectedAt(double toEye, double roughness) {
  constexpr int kSlopes = 32, kTurns = 16;
  const double a = std::max(roughness * roughness, 0.002), a2 = a * a;
  const double eyeX = std::sqrt(1 - toEye * toEye);
  double straight = 0, grazing = 0;
  for (int i = 0; i < kSlopes; ++i)
    for (int j = 0; j < kTurns; ++j) {
      const double u = (i + 0.5) / kSlopes, turn = (j + 0.5) / kTurns * std::numbers::pi;
      const double nh = std::sqrt((1 - u) / (1 + (a2 - 1) * u)),
                   x = std::sqrt(std::max(0.0, 1 - nh * nh)) * std::cos(turn);
      const double vh = eyeX * x + toEye * nh, nl = 2 * vh * nh - toEye;
      if (nl <= 0 || vh <= 0) continue;
      const double seen =
          0.5 / (nl * std::sqrt(toEye * toEye * (1 - a2) + a2) + toEye * std::sqrt(nl * nl * (1 - a2) + a2));
      const double part = 4 * seen * nl * vh / nh / (kSlopes * kTurns), mirrored = std::pow(1 - vh, 5);
      straight += part * (1 - mirrored);
      grazing += part * mirrored;
    }
  return {float(straight), float(grazing)};
}

}  // namespace

std::vector<std::array<float, 2>> reflectedLight(std::size_t side) {
  std::vector<std::array<float, 2>> table;
  table.reserve(side * side);
  for (std::size_t row = 0; row < side; ++row)
    for (std::size_t i = 0; i < side; ++i)
      table.push_back(reflectedAt((double(i) + 0.5) / double(side), (double(row) + 0.5) / double(side)));
  return table;
}

}  // namespace arete
