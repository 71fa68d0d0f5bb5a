// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fields between commas; the word behind a height gives its reference. Numbers do not depend on the locale.
#include "io/geo/crs/position_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"
#include "io/files/number_text.h"
#include "io/files/text/length_unit.h"

namespace arete {
namespace {

constexpr std::array kWords = {std::pair{std::string_view("agl"), HeightKind::aboveGround},
                               std::pair{std::string_view("msl"), HeightKind::seaLevel},
                               std::pair{std::string_view("ell"), HeightKind::ellipsoidal}};

/// Missing if the text is not a finite number.
std::optional<double> finiteNumber(std::string_view text) {
  const auto number = text::parseNumber(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::vector<std::string_view> fieldsOf(std::string_view text) {
  std::vector<std::string_view> fields;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    fields.push_back(text::withoutSpaces(text.substr(at, end - at)));
    at = end + 1;
  }
  return fields;
}

Result<Vec2> placeOf(std::string_view x, std::string_view y, const CrsTransform& toDem,
                     const std::string& culprit) {
  Vec2 place;
  for (const auto& [field, value] : {std::pair{x, &place.x}, std::pair{y, &place.y}}) {
    const auto number = readNumberText(field);
    if (!number) return failure(number.error().code, number.error().message, culprit);
    *value = *number;
  }
  const auto known = toDem(place);
  if (!known)
    return failure(ErrorCode::usage,
                   "is outside the domain of the DEM's CRS; expected longitude, latitude in degrees",
                   culprit);
  return *known;
}

/// Removes the word from the end of "120.5msl".
HeightKind takeKind(std::string_view& height) {
  for (const auto& [word, kind] : kWords) {
    if (height.size() < word.size()) continue;
    const std::string_view end = height.substr(height.size() - word.size());
    const bool isWord = std::equal(end.begin(), end.end(), word.begin(), [](char a, char b) {
      return std::tolower(static_cast<unsigned char>(a)) == b;
    });
    if (!isWord) continue;
    height = text::withoutSpaces(height.substr(0, height.size() - word.size()));
    return kind;
  }
  return HeightKind::aboveGround;
}

}  // namespace

std::string_view toString(HeightKind kind) {
  for (const auto& [word, k] : kWords)
    if (k == kind) return word;
  return "unknown";
}

Result<double> readNumberText(std::string_view text) try {
  const auto number = finiteNumber(text::withoutSpaces(text));
  if (!number) return failure(ErrorCode::usage, fmt::format("'{}' is not a number", text));
  return *number;
} catch (...) {
  return caughtFailure();
}

Result<StatedHeight> readHeightText(std::string_view text, const DataUnit* unit) try {
  std::string_view height = text::withoutSpaces(text);
  // The word is taken away first; what is left has to be a number.
  const HeightKind kind = takeKind(height);
  auto value = finiteNumber(height);
  if (!value && unit) {
    const auto length = parseLength(height, "");
    if (length && length->hasUnit()) {
      ARETE_TRY(const double inUnit, inDataUnit(*length, *unit, std::string(text)));
      value = inUnit;
    }
  }
  if (!value)
    return failure(ErrorCode::usage,
                   fmt::format("'{}' is not a height: a number, optionally followed by {}agl, msl or ell",
                               text, unit ? fmt::format("a unit ({}) and ", lengthUnitNames()) : ""));
  return StatedHeight{*value, kind};
} catch (...) {
  return caughtFailure();
}

Result<Vec2> readPlaceArgument(const std::string& option, const std::string& text,
                               const CrsTransform& toDem) try {
  const std::string culprit = fmt::format("{} {}", option, text);
  const auto fields = fieldsOf(text);
  if (fields.size() != 2)
    return failure(ErrorCode::usage, fmt::format("a place is two numbers, X,Y, not {}", fields.size()),
                   culprit);
  return placeOf(fields[0], fields[1], toDem, culprit);
} catch (...) {
  return caughtFailure();
}

Result<PositionArgument> readPositionArgument(const std::string& option, const std::string& text,
                                              const CrsTransform& toDem, const DataUnit* unit) try {
  const std::string culprit = fmt::format("{} {}", option, text);
  const auto fields = fieldsOf(text);
  if (fields.size() != 3)
    return failure(ErrorCode::usage,
                   fmt::format("a position is X,Y,H with agl, msl or ell behind H, not {}",
                               counted(fields.size(), "field", "fields")),
                   culprit);
  PositionArgument position;
  const auto height = readHeightText(fields[2], unit);
  if (!height) return failure(height.error().code, height.error().message, culprit);
  position.height = height->height;
  position.kind = height->kind;
  ARETE_TRY(const auto place, placeOf(fields[0], fields[1], toDem, culprit));
  position.xy = place;
  return position;
} catch (...) {
  return caughtFailure();
}

Result<double> demHeight(const PositionArgument& position, const GroundHeights& heights) try {
  const std::string culprit =
      fmt::format("{},{},{}{}", position.xy.x, position.xy.y, position.height, toString(position.kind));
  if (position.kind == HeightKind::aboveGround) {
    const auto ground = heights.at(position.xy);
    if (!ground)
      return failure(ErrorCode::invalidData, "has no terrain below it: outside the DEM, or on NODATA",
                     culprit);
    return ground->height + position.height;
  }
  // The two kinds of heights differ by a geoid, which is not known here, so neither is converted.
  const bool isDemEllipsoidal = heights.model().georeference.verticalDatum == "ellipsoid";
  if (isDemEllipsoidal != (position.kind == HeightKind::ellipsoidal))
    return failure(
        ErrorCode::usage,
        isDemEllipsoidal
            ? "the DEM's heights are ellipsoidal, so a height above sea level needs a geoid; use ell or agl"
            : "the DEM's heights are not stated to be ellipsoidal, so this needs a geoid; use msl or agl",
        culprit);
  return position.height;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
