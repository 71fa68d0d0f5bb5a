// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/extract/region_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/extract/region_reader.h"

namespace arete {
namespace {

/// The numbers of "a,b,c", however many; nothing if a field is not a number.
std::optional<std::vector<double>> numbersOf(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    std::string_view field = text.substr(at, end - at);
    while (!field.empty() && field.front() == ' ') field.remove_prefix(1);
    while (!field.empty() && field.back() == ' ') field.remove_suffix(1);
    double value = 0;
    const auto [behind, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || behind != field.data() + field.size()) return std::nullopt;
    numbers.push_back(value);
    at = end + 1;
  }
  return numbers;
}

}  // namespace

Result<RegionArgument> readRegionArgument(const std::string& text, const std::string& demCrs, double distance,
                                          const RunContext& context) try {
  const std::string culprit = fmt::format("region {}", text);
  if (const auto box = numbersOf(text); box && text.find(',') != std::string::npos) {
    if (box->size() != 4)
      return failure(ErrorCode::usage,
                     fmt::format("a box has four numbers, xmin,ymin,xmax,ymax, not {}", box->size()),
                     culprit);
    const double xMin = (*box)[0], yMin = (*box)[1], xMax = (*box)[2], yMax = (*box)[3];
    for (const double value : *box)
      if (!std::isfinite(value)) return failure(ErrorCode::usage, "a box needs finite numbers", culprit);
    if (!(xMin < xMax && yMin < yMax))
      return failure(ErrorCode::usage, "xmin must be below xmax, and ymin below ymax", culprit);
    return RegionArgument{
        {.rings = {{{xMin, yMin}, {xMax, yMin}, {xMax, yMax}, {xMin, yMax}}}, .distance = distance}, {}};
  }
  auto read = readRegion(text, demCrs, {.takesLines = distance > 0}, context);
  if (!read) {
    Error error = read.error();
    if (distance == 0 && (error.code == ErrorCode::unsupported || error.code == ErrorCode::invalidData))
      if (const auto lines = readRegion(text, demCrs, {.takesLines = true}, context);
          lines && lines->rings.empty())
        return failure(ErrorCode::usage,
                       "holds lines, and a line has no inside; state how far around them with `distance`",
                       culprit);
    if (error.code == ErrorCode::notFound && text.find(',') != std::string::npos)
      error.message += ", nor are these the four numbers xmin,ymin,xmax,ymax";
    return tl::unexpected(error);
  }
  if (read->lacksCrs)
    return failure(ErrorCode::usage,
                   demCrs.empty() ? "has a CRS and the DEM has none, so the two cannot be brought together; "
                                    "state the DEM's with `crs` when it is read"
                                  : "has no CRS and the DEM has one, so the two cannot be brought together",
                   culprit);
  return RegionArgument{
      {.rings = std::move(read->rings), .lines = std::move(read->lines), .distance = distance},
      std::move(read->warnings)};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
