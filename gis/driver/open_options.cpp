// SPDX-License-Identifier: GPL-3.0-or-later
#include "gis/driver/open_options.h"

#include <fmt/format.h>

#include <cmath>

namespace arete {
namespace {

Result<std::optional<double>> numberOf(CSLConstList options, const char* name, bool mayBeZero) {
  const char* const text = CSLFetchNameValue(options, name);
  if (text == nullptr || *text == '\0') return std::nullopt;
  char* end = nullptr;
  const double number = CPLStrtod(text, &end);
  if (*end != '\0' || !std::isfinite(number) || !(mayBeZero ? number >= 0 : number > 0))
    return failure(ErrorCode::usage,
                   fmt::format("{} is no number {} 0", text, mayBeZero ? "of at least" : "above"),
                   fmt::format("{}={}", name, text));
  return number;
}

}  // namespace

const char* const kAmtOpenOptions =
    "<OpenOptionList>"
    "<Option name='TOLERANCE' type='float' min='0' default='0' description='Largest error allowed, in the "
    "unit of "
    "heights; 0: the source itself'/>"
    "<Option name='CELL' type='float' description='Side of a pixel in the unit of the CRS; default: the grid "
    "of "
    "the source, of points about their spacing'/>"
    "</OpenOptionList>";

Result<DriverOptions> readOpenOptions(CSLConstList options) {
  ARETE_TRY(const auto tolerance, numberOf(options, "TOLERANCE", true));
  ARETE_TRY(const auto cell, numberOf(options, "CELL", false));
  return DriverOptions{tolerance.value_or(0), cell};
}

}  // namespace arete
