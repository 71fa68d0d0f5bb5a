// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace arete {

/// An opaque colour, sRGB.
struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  constexpr bool operator==(const Rgb&) const = default;
};

/// A colour, sRGB, with its opacity: 0 = nothing to see, 255 = opaque. Not premultiplied.
struct Rgba {
  std::uint8_t r = 0, g = 0, b = 0, a = 0;
  constexpr Rgba() = default;
  constexpr Rgba(std::uint8_t red, std::uint8_t green, std::uint8_t blue, std::uint8_t opacity = 255)
      : r(red), g(green), b(blue), a(opacity) {}
  constexpr Rgba(Rgb c) : r(c.r), g(c.g), b(c.b), a(255) {}  // NOLINT(google-explicit-constructor)
  constexpr Rgb opaque() const { return {r, g, b}; }
  /// Red, green, blue and opacity by their number. Precondition: i < 4.
  constexpr std::uint8_t operator[](int i) const { return i == 0 ? r : i == 1 ? g : i == 2 ? b : a; }
  constexpr bool operator==(const Rgba&) const = default;
};

/// The colour `fraction` of the way from one to another. Precondition: 0 <= fraction <= 1.
Rgb mix(Rgb from, Rgb to, double fraction);

/// What a colour looks like in front of an opaque one.
Rgb laidOver(Rgba front, Rgb behind);

/// The colour of places without data in every picture: a grey that no sea, lake or height has.
inline constexpr Rgb kNodataColor = {190, 191, 194};

}  // namespace arete
