// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace arete {

/// What a rough surface throws back in one reflection of light that falls evenly from all sides (GGX, Smith's
/// shadows with the height, Schlick's mirror): the sum of the reflectance of light that falls straight times
/// the first number, and of that of light that grazes it times the second.
///
/// Row by row of rising roughness, each of `side` rising cosines between the normal and the eye, at the
/// middles of `side` equal parts of 0 to 1. O(side squared).
std::vector<std::array<float, 2>> reflectedLight(std::size_t side);

}  // namespace arete
