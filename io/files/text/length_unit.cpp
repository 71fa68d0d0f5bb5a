// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/length_unit.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include "engine/base/caught_failure.h"
#include "io/files/number_text.h"

namespace arete {
namespace {

struct LengthUnit {
  std::string_view name;
  double metres;
};

constexpr std::array kLengthUnits = {
    LengthUnit{"mm", 0.001},    LengthUnit{"cm", 0.01},   LengthUnit{"m", 1},
    LengthUnit{"km", 1000},     LengthUnit{"ft", 0.3048}, LengthUnit{"us-ft", 1200.0 / 3937},
    LengthUnit{"mi", 1609.344}, LengthUnit{"nmi", 1852},
};

/// Where the number at the beginning of a text ends; 0: there is none.
std::size_t lengthOfNumber(std::string_view text) {
  const std::size_t sign = text.starts_with('+') && !text.starts_with("+-") ? 1 : 0;
  double ignored = 0;
  const char* const begin = text.data();
  const auto [end, error] = std::from_chars(begin + sign, begin + text.size(), ignored);
  return error == std::errc::invalid_argument ? 0 : static_cast<std::size_t>(end - begin);
}

}  // namespace

std::string_view lengthUnitNames() {
  return "mm, cm, m, km, ft, us-ft, mi, nmi";
}

Result<StatedLength> parseLength(std::string_view text, const std::string& culprit) try {
  text = text::withoutSpaces(text);
  const std::size_t end = lengthOfNumber(text);
  const std::optional<double> number = text::parseNumber(text.substr(0, end));
  if (!number || std::isnan(*number))
    return failure(ErrorCode::usage, fmt::format("'{}' is not a number", text), culprit);
  const std::string_view unit = text::withoutSpaces(text.substr(end));
  if (unit.empty()) return StatedLength{.number = *number};
  for (const LengthUnit& known : kLengthUnits) {
    if (known.name != unit) continue;
    if (!std::isfinite(*number))
      return failure(ErrorCode::usage, fmt::format("'{}' is not a finite number", text), culprit);
    return StatedLength{*number, known.metres};
  }
  return failure(ErrorCode::usage,
                 fmt::format("'{}' is not a number, nor one with a unit of {}", text, lengthUnitNames()),
                 culprit);
} catch (...) {
  return caughtFailure(culprit);
}

Result<double> inDataUnit(const StatedLength& length, const DataUnit& data, const std::string& culprit) try {
  if (!length.hasUnit()) return length.number;
  if (!(data.metres > 0))
    return failure(ErrorCode::usage,
                   "has a unit, and the unit of the data is not known; a number without one is in it, and "
                   "`verticalUnit` of build states that of a DEM",
                   culprit);
  // Equal units leave the number as it is, to the bit.
  const double number =
      length.unitMetres == data.metres ? length.number : length.number * length.unitMetres / data.metres;
  if (!std::isfinite(number)) return failure(ErrorCode::usage, "is too large for a number", culprit);
  return number;
} catch (...) {
  return caughtFailure(culprit);
}

}  // namespace arete
