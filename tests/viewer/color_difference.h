// SPDX-License-Identifier: GPL-3.0-or-later
//
// How different colours look: CIEDE2000 [Sharma2005], to eyes that lack one kind of cones as well
// (Machado, Oliveira and Fernandes 2009).
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "viewer/color/rgb.h"

namespace arete::test {

enum class Vision { normal, protan, deutan, tritan };

struct Lab {
  double l = 0, a = 0, b = 0;
};

inline Lab labOf(Rgb color, Vision vision = Vision::normal) {
  using Row = std::array<double, 3>;
  static constexpr std::array<std::array<Row, 3>, 4> kEyes = {
      {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
       {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
       {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
       {{{1.255528, -0.076749, -0.178779},
         {-0.078411, 0.930809, 0.147602},
         {0.004733, 0.691367, 0.303900}}}}};
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const Row seen = {linear(color.r / 255.0), linear(color.g / 255.0), linear(color.b / 255.0)};
  const auto times = [](const std::array<Row, 3>& m, const Row& v) {
    Row result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return result;
  };
  static constexpr std::array<Row, 3> kToXyz = {{{0.4124564, 0.3575761, 0.1804375},
                                                 {0.2126729, 0.7151522, 0.0721750},
                                                 {0.0193339, 0.1191920, 0.9503041}}};
  const Row xyz = times(kToXyz, times(kEyes[std::size_t(vision)], seen));
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f(xyz[0] / 0.95047), y = f(xyz[1]), z = f(xyz[2] / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

inline double ciede2000(const Lab& p, const Lab& q) {
  constexpr double kDegree = std::numbers::pi / 180;
  const auto seventh = [](double c) {
    return std::sqrt(std::pow(c, 7) / (std::pow(c, 7) + std::pow(25.0, 7)));
  };
  const double g = 0.5 * (1 - seventh((std::hypot(p.a, p.b) + std::hypot(q.a, q.b)) / 2));
  const double a1 = (1 + g) * p.a, a2 = (1 + g) * q.a;
  const double c1 = std::hypot(a1, p.b), c2 = std::hypot(a2, q.b);
  const auto hue = [&](double b, double a) {
    const double h = std::atan2(b, a) / kDegree;
    return h < 0 ? h + 360 : h;
  };
  const double h1 = hue(p.b, a1), h2 = hue(q.b, a2), product = c1 * c2;
  double dh = product == 0 ? 0 : h2 - h1;
  if (dh > 180) dh -= 360;
  if (dh < -180) dh += 360;
  double mean = h1 + h2;
  if (product != 0) {
    mean /= 2;
    if (std::abs(h1 - h2) > 180) mean += h1 + h2 < 360 ? 180 : -180;
  }
  const double dl = q.l - p.l, dc = c2 - c1, dH = 2 * std::sqrt(product) * std::sin(dh / 2 * kDegree);
  const double l = (p.l + q.l) / 2, c = (c1 + c2) / 2;
  const double t = 1 - 0.17 * std::cos((mean - 30) * kDegree) + 0.24 * std::cos(2 * mean * kDegree) +
                   0.32 * std::cos((3 * mean + 6) * kDegree) - 0.20 * std::cos((4 * mean - 63) * kDegree);
  const double sl = 1 + 0.015 * (l - 50) * (l - 50) / std::sqrt(20 + (l - 50) * (l - 50));
  const double sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
  const double turn = 30 * std::exp(-std::pow((mean - 275) / 25, 2));
  const double rt = -std::sin(2 * turn * kDegree) * 2 * seventh(c);
  return std::sqrt(std::pow(dl / sl, 2) + std::pow(dc / sc, 2) + std::pow(dH / sh, 2) +
                   rt * (dc / sc) * (dH / sh));
}

}  // namespace arete::test
