// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps and names of [Sharma2005], which settles what the standard leaves open: hues of greys, and means
// of hues on both sides of 0 degrees.
#include "viewer/color/difference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arete {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;

double labShare(double t) {
  constexpr double kKnee = 6.0 / 29;
  return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3 * kKnee * kKnee) + 4.0 / 29;
}

double seventhPowerShare(double chroma) {
  const double seventh = std::pow(chroma, 7);
  return std::sqrt(seventh / (seventh + std::pow(25.0, 7)));
}

double hueDegrees(double a, double b) {
  if (a == 0 && b == 0) return 0;
  const double hue = std::atan2(b, a) / kDegrees;
  return hue < 0 ? hue + 360 : hue;
}

}  // namespace

std::array<double, 3> linearOf(Rgb color) {
  const auto channel = [](std::uint8_t value) {
    const double c = value / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return {channel(color.r), channel(color.g), channel(color.b)};
}

Rgb rgbOfLinear(const std::array<double, 3>& linear) {
  const auto channel = [](double value) {
    const double c = std::clamp(value, 0.0, 1.0);
    return std::uint8_t(
        std::lround(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055)));
  };
  return {channel(linear[0]), channel(linear[1]), channel(linear[2])};
}

Lab labOf(Rgb color) {
  const auto [r, g, b] = linearOf(color);
  // sRGB's primaries; each row is divided by its sum, so that white is exactly white.
  const double x = labShare((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.9504700);
  const double y = labShare(0.2126729 * r + 0.7151522 * g + 0.0721749 * b);
  const double z = labShare((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.0888300);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double colorDifference(const Lab& one, const Lab& other) {
  const double meanC = (std::hypot(one.a, one.b) + std::hypot(other.a, other.b)) / 2;
  const double stretch = 1.5 - 0.5 * seventhPowerShare(meanC);
  const double a1 = one.a * stretch, a2 = other.a * stretch;
  const double c1 = std::hypot(a1, one.b), c2 = std::hypot(a2, other.b);
  const double h1 = hueDegrees(a1, one.b), h2 = hueDegrees(a2, other.b);

  const bool isGrey = c1 * c2 == 0;
  double apart = isGrey ? 0 : h2 - h1;
  if (apart > 180) apart -= 360;
  if (apart < -180) apart += 360;
  double hue = h1 + h2;
  if (!isGrey) {
    if (std::abs(h1 - h2) > 180) hue += hue < 360 ? 360 : -360;
    hue /= 2;
  }
  const double dL = other.lightness - one.lightness, dC = c2 - c1,
               dH = 2 * std::sqrt(c1 * c2) * std::sin(apart / 2 * kDegrees);
  const double lightness = (one.lightness + other.lightness) / 2 - 50, chroma = (c1 + c2) / 2;
  const double t = 1 - 0.17 * std::cos((hue - 30) * kDegrees) + 0.24 * std::cos(2 * hue * kDegrees) +
                   0.32 * std::cos((3 * hue + 6) * kDegrees) - 0.20 * std::cos((4 * hue - 63) * kDegrees);
  const double turn = 30 * std::exp(-std::pow((hue - 275) / 25, 2));
  const double weightL = 1 + 0.015 * lightness * lightness / std::sqrt(20 + lightness * lightness);
  const double weightC = 1 + 0.045 * chroma, weightH = 1 + 0.015 * chroma * t;
  const double mixed = -std::sin(2 * turn * kDegrees) * 2 * seventhPowerShare(chroma);
  const double l = dL / weightL, c = dC / weightC, h = dH / weightH;
  return std::sqrt(std::max(0.0, l * l + c * c + h * h + mixed * c * h));
}

double colorDifference(Rgb a, Rgb b) {
  return colorDifference(labOf(a), labOf(b));
}

}  // namespace arete
