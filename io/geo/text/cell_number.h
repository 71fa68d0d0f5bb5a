// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace arete {

/// A field of a table as a number.
struct CellNumber {
  enum class Kind {
    number,
    missing,  ///< empty, or a word that programs write for no value: nan, NA, null, -, ...
    notANumber,
  };
  Kind kind = Kind::notANumber;
  double value = 0;  ///< possibly infinite
  bool hasDecimalComma = false;
  /// "1,234": the comma may group digits as well.
  bool mayBeGrouped = false;
};

/// Reads a field: "1.5", "+2e3", and what other programs write: "2.5D+03" (Fortran), "1,5" (a comma is taken
/// for the decimal sign where it is the only one and no point is there). O(length).
CellNumber readCell(std::string_view field);

/// What is wrong with a field that is not a number: a clause that follows the field, "is not a number", with
/// the reason if there is a usual one.
std::string whyNotANumber(std::string_view field);

}  // namespace arete
