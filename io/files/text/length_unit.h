// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace arete {

/// The unit of the data that a length is stated for: of heights, of the coordinates of a mesh, or the metre
/// of distances along the ground.
struct DataUnit {
  double metres = 0;  ///< in one unit; 0: the unit is not known
};

/// A length as a person states it: a number, perhaps with a unit behind it, as "20km" or "1.5 us-ft".
struct StatedLength {
  double number = 0;
  double unitMetres = 0;  ///< in one of its unit; 0: it has none

  bool hasUnit() const { return unitMetres > 0; }
};

/// The units that a length may have: "mm, cm, m, km, ft, us-ft, mi, nmi". ft is the international foot, us-ft
/// the US survey foot, mi the international mile, nmi the nautical mile.
std::string_view lengthUnitNames();

/// Parses a length. Names of units are in lower case, since "M" means other things to other people. Numbers
/// do not depend on the locale; their comma is a point.
///
/// Errors: usage, with the culprit given: no number, NaN, a unit that is not known, an infinite length with a
/// unit.
Result<StatedLength> parseLength(std::string_view text, const std::string& culprit);

/// The length as a number in the unit of the data; without a unit its number.
///
/// Errors: usage, with the culprit given: the length has a unit and the data's is not known.
Result<double> inDataUnit(const StatedLength& length, const DataUnit& data, const std::string& culprit);

}  // namespace arete
