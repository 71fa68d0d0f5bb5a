// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/model/attribute.h"

namespace arete {

/// The transfer function of sRGB (IEC 61966-2-1) and its inverse, exact; of a fraction, odd below 0.
double linearOfSrgb(double encoded);
double srgbOfLinear(double linear);

/// A color as fractions: integers divided by their largest value, floats as they are.
/// @return As many as the attribute has components.
std::vector<double> colorFractions(const Attribute& color, std::size_t element);

/// Colors between files whose numbers are sRGB (8 bits, text) and glTF, whose numbers are proportional to
/// light. Red, green and blue are converted unless they are of the space already; alpha is a proportion in
/// both. Numbers beyond 0 and 1 are held within. `none` counts as sRGB.
///
/// 16 bits hold every 8-bit code: toSrgb8(toLinear16(c)) is c. O(elements).
Attribute toLinear16(const Attribute& color);  ///< uint16, normalized, linear
Attribute toLinear32(const Attribute& color);  ///< float32, linear

/// uint8, normalized, sRGB.
/// @param isRounded Set where a number is further than half a step of 16 bits, in the space of the source,
/// from the code that it becomes; never cleared.
Attribute toSrgb8(const Attribute& color, bool& isRounded);

}  // namespace arete
