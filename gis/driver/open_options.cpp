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
    "<Option name='MAX_ERROR' alias='TOLERANCE' type='float' min='0' default='0' description='Largest error "
    "allowed, in the unit of heights; 0: the source itself. TOLERANCE is an older name'/>"
    "<Option name='CELL' type='float' description='Side of a pixel in the unit of the CRS; default: the grid "
    "of "
    "the source, of points about their spacing'/>"
    "</OpenOptionList>";

Result<DriverOptions> readOpenOptions(CSLConstList options) {
  ARETE_TRY(const auto maxError, numberOf(options, "MAX_ERROR", true));
  ARETE_TRY(const auto older, numberOf(options, "TOLERANCE", true));
  if (maxError && older && *maxError != *older)
    return failure(ErrorCode::usage, "differs from TOLERANCE, its older name",
                   fmt::format("MAX_ERROR={}", *maxError));
  const auto tolerance = maxError ? maxError : older;
  ARETE_TRY(const auto cell, numberOf(options, "CELL", false));
  return DriverOptions{tolerance.value_or(0), cell};
}

}  // namespace arete
