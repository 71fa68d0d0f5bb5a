// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "io/store/packed/nodes/tables.h"

namespace arete::packed {

/// Classes of triangle areas, by which tables are chosen.

/// The doubled area of a triangle as one byte. On a lattice it is a whole number, and small areas allow few
/// errors. 65 stands for more than 64, 66 for any triangle of scattered points.
inline std::uint8_t shownArea(bool isLattice, float doubledArea) {
  if (!isLattice) return 66;
  return static_cast<std::uint8_t>(std::min(doubledArea, 65.0f));
}
/// By shown area: the class that chooses the table of an error, below kAreaClasses (tables.h).
inline constexpr auto kAreaClass = [] {
  std::array<std::uint8_t, 67> classes{};
  for (unsigned area = 0; area < 67; ++area)
    classes[area] = static_cast<std::uint8_t>(area <= 8    ? area
                                              : area <= 16 ? 9
                                              : area <= 32 ? 10
                                              : area <= 64 ? 11
                                              : area == 65 ? 12
                                                           : 13);
  return classes;
}();
/// The class that chooses the table of an inserted vertex's position, by the doubled area of the floor.
inline unsigned placeClass(float doubledArea, bool isOpen) {
  if (isOpen) return kPlaceClasses - 1;
  if (doubledArea <= 12) return static_cast<unsigned>(doubledArea);
  if (doubledArea <= 32) return 12 + static_cast<unsigned>((doubledArea - 12) / 4);
  return std::min(
      12 + static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(std::min(doubledArea, 1e6f)))),
      kPlaceClasses - 2);
}

}  // namespace arete::packed
