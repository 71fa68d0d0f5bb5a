// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "surface/model/attribute.h"

namespace arete {

/// An attribute of numbers that a file has as text. Its type is float32 if for each of them the nearest
/// float32, written with its shortest digits, reads as the same double; else float64. So a text that was
/// written from floats gives the same floats, and none loses a digit.
///
/// @param numbers element by element; a whole number of elements. O(size).
Attribute attributeOfTextNumbers(std::string name, AttributeMeaning meaning, std::uint8_t components,
                                 std::span<const double> numbers);

/// The number that an element's component stands for: of normalized integers a fraction.
double fractionOf(const Attribute& attribute, double number);

/// Whether the digits of float32 hold what the attribute stands for, as text counts it: texture coordinates
/// from below. One number that needs the digits of doubles makes a reader take all for doubles. O(size).
bool hasFloat32Digits(const Attribute& attribute);

}  // namespace arete
