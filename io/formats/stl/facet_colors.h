// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "surface/model/attribute.h"

namespace arete {

/// What programs write into the two bytes behind a facet of a binary STL, which the format calls unused.
///
/// VisCAM and SolidView: five bits each of blue, green and red, from the lowest bit on; the highest bit says
/// that there is a colour. Materialise Magics, whose header has "COLOR=" and four bytes: red, green and blue;
/// the highest bit says that the facet has the colour of the header instead.

/// The attribute "color" of the facets, if it is clear: all have one of VisCAM's, or the header is of
/// Magics and its colour opaque, and not all words are 0. Else "attribute", the words as they are; nothing if
/// all are 0.
std::optional<Attribute> facetAttribute(std::string_view header, const std::vector<std::uint16_t>& words);

/// A facet's colour as VisCAM has it.
///
/// @param isRounded becomes true if five bits do not hold it.
std::uint16_t facetWord(std::span<const double> color, bool& isRounded);

}  // namespace arete
