// SPDX-License-Identifier: GPL-3.0-or-later
//
// What eyes make of colours, apart from the code that is tested: lightness by CIE's definition, and the
// linear model of missing cones by Machado, Oliveira and Fernandes, "A Physiologically-based Model for
// Simulation of Color Vision Deficiency", IEEE TVCG 15(6), 2009, severity 1.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ostream>

#include "viewer/color/difference.h"
#include "viewer/color/rgb.h"

namespace arete::test {

enum class Eyes { all, noRed, noGreen, noBlue };
inline constexpr std::array kAllEyes = {Eyes::all, Eyes::noRed, Eyes::noGreen, Eyes::noBlue};

inline double intensity(int value) {
  const double c = value / 255.0;
  return c > 0.04045 ? std::pow((c + 0.055) / 1.055, 2.4) : c / 12.92;
}

/// CIELAB's L* of an sRGB colour.
inline double lightness(Rgb c) {
  const double y = 0.2126729 * intensity(c.r) + 0.7151522 * intensity(c.g) + 0.0721749 * intensity(c.b);
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

inline Rgb seenBy(Eyes eyes, Rgb c) {
  using Matrix = std::array<std::array<double, 3>, 3>;
  constexpr std::array<Matrix, 4> kMachado = {
      {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
       {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
       {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
       {{{1.255528, -0.076749, -0.178779},
         {-0.078411, 0.930809, 0.147602},
         {0.004733, 0.691367, 0.303900}}}}};
  const std::array<double, 3> linear = {intensity(c.r), intensity(c.g), intensity(c.b)};
  std::array<std::uint8_t, 3> seen{};
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += kMachado[std::size_t(eyes)][i][k] * linear[k];
    sum = std::clamp(sum, 0.0, 1.0);
    const double curved = sum > 0.0031308 ? 1.055 * std::pow(sum, 1 / 2.4) - 0.055 : 12.92 * sum;
    seen[i] = std::uint8_t(std::lround(255 * curved));
  }
  return {seen[0], seen[1], seen[2]};
}

}  // namespace arete::test

namespace arete {
inline void PrintTo(const Rgba& c, std::ostream* out) {
  *out << "(" << int(c.r) << ", " << int(c.g) << ", " << int(c.b) << ", " << int(c.a) << ")";
}
}  // namespace arete
