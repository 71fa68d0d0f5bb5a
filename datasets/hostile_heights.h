// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "terrain/model/heightfield.h"

namespace arete {

/// A small heightfield whose numbers are hard for a bound on errors: of any magnitude from 1e-300 to 1e300,
/// far from zero, of few or of many digits, with heights that stand alone, with voids.
struct HostileHeights {
  RasterHeightfield field;
  std::string what;         ///< how it was made, for messages
  std::size_t planted = 0;  ///< heights that stand alone by the definition of LoneHeights
  bool isOrdinary = false;  ///< a build must take it, and warn of nothing but what was planted
};

/// What a seed makes: every combination of a surface, a magnitude, an offset, digits and outliers, in no
/// particular order. The same on every machine that has IEEE doubles. O(columns * rows).
/// Precondition: columns, rows >= 8.
HostileHeights hostileHeights(std::uint64_t seed, std::uint32_t columns, std::uint32_t rows);

/// The same with the samples as scattered points, each moved within its pixel. Voids are left out.
PointHeightfield hostilePoints(std::uint64_t seed, std::uint32_t columns, std::uint32_t rows);

}  // namespace arete
