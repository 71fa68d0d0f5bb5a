// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/region_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/geo/crs/reader.h"
#include "io/geo/gdal/polygon_set.h"
#include "io/query/extract/ground_buffer.h"
#include "io/query/extract/region_reader.h"

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

/// The corners of a box. One whose xmin is above its xmax crosses the antimeridian where x are longitudes.
Result<std::vector<Vec2>> cornersOf(const std::array<double, 4>& box, const Georeference& axes) {
  for (const double value : box)
    if (!std::isfinite(value)) return failure(ErrorCode::usage, "a box needs finite numbers");
  const double xMin = box[0], yMin = box[1], yMax = box[3];
  double xMax = box[2];
  if (xMin > xMax && axes.isGeographic) xMax += turnOf(axes);
  if (!(xMin < xMax && yMin < yMax))
    return failure(ErrorCode::usage, "xmin must be below xmax, and ymin below ymax");
  return std::vector<Vec2>{{xMin, yMin}, {xMax, yMin}, {xMax, yMax}, {xMin, yMax}};
}

/// The corners of a box, brought into the DEM's CRS; nothing if the text is no list of numbers.
Result<std::optional<std::vector<Vec2>>> readBox(const RegionText& region, const Georeference& dem) {
  const auto box = numbersOf(region.text);
  if (!box || region.text.find(',') == std::string::npos) return std::nullopt;
  if (box->size() != 4)
    return failure(ErrorCode::usage,
                   fmt::format("a box has four numbers, xmin,ymin,xmax,ymax, not {}", box->size()));
  // The axes of the box decide whether it may cross the meridian where longitudes jump.
  Georeference axes = dem;
  if (!region.crs.empty()) {
    ARETE_TRY(const auto crs, crsFromUser(region.crs));
    axes = {};
    ARETE_CHECK(describeCrs(crs, axes));
  }
  ARETE_TRY(auto corners, cornersOf({(*box)[0], (*box)[1], (*box)[2], (*box)[3]}, axes));
  if (region.crs.empty()) return corners;
  if (dem.crsWkt.empty())
    return failure(ErrorCode::usage,
                   "has a CRS and the DEM has none, so the two cannot be brought together; "
                   "state the DEM's with `crs` when it is read");
  ARETE_TRY(auto projected, reprojectRing(corners, region.crs, dem.crsWkt));
  return projected;
}

Result<RegionArgument> readFile(const RegionText& region, const std::string& demCrs,
                                const RunContext& context) {
  const std::string& text = region.text;
  const bool hasDistance = region.distance > 0;
  auto read = readRegion(text, demCrs,
                         {.crs = region.crs, .takesLines = hasDistance, .takesPoints = hasDistance}, context);
  if (!read) {
    Error error = read.error();
    // A second reading finds out whether the file holds lines or points, and the sentence says so.
    if (!hasDistance && (error.code == ErrorCode::unsupported || error.code == ErrorCode::invalidData))
      if (const auto lines =
              readRegion(text, demCrs, {.crs = region.crs, .takesLines = true, .takesPoints = true}, context);
          lines && lines->rings.empty())
        return failure(
            ErrorCode::usage,
            lines->lines.empty()
                ? "holds points, and a point has no inside; state how far around them with `distance`"
                : "holds lines, and a line has no inside; state how far around them with `distance`");
    if (error.code == ErrorCode::notFound && text.find(',') != std::string::npos)
      error.message += ", nor are these the four numbers xmin,ymin,xmax,ymax";
    return tl::unexpected(error);
  }
  if (read->lacksCrs)
    return failure(ErrorCode::usage,
                   demCrs.empty() ? "has a CRS and the DEM has none, so the two cannot be brought together; "
                                    "state the DEM's with `crs` when it is read"
                                  : "has no CRS and the DEM has one, so the two cannot be brought together; "
                                    "`region-crs` states it");
  RegionShape shape{.rings = std::move(read->rings), .lines = std::move(read->lines)};
  // A point is a line of one vertex, and the distance extends it.
  for (const Vec2& point : read->points) shape.lines.push_back({point});
  return RegionArgument{std::move(shape), std::move(read->warnings)};
}

Result<RegionArgument> readAndPlace(const RegionText& text, const Georeference& dem,
                                    const LongitudeTurns& turns, const RunContext& context) {
  ARETE_TRY(auto box, readBox(text, dem));
  RegionArgument region;
  if (box) {
    region.shape.rings = {std::move(*box)};
  } else {
    auto read = readFile(text, dem.crsWkt, context);
    if (!read) return read;
    region = std::move(*read);
  }
  region.shape.distance = text.distance;
  // With a CRS the distance is on the ground; without one it is in units of the plan and stays as it is.
  if (text.distance > 0 && !dem.crsWkt.empty()) {
    ARETE_TRY(auto extended, extendedOnGround(region.shape, dem, region.warnings, context));
    region.shape = std::move(extended);
  }
  turnOnto(turns, region);
  return region;
}

}  // namespace

void turnOnto(const LongitudeTurns& turns, RegionArgument& region) {
  RegionShape& shape = region.shape;
  double west = std::numeric_limits<double>::infinity(), east = -west;
  for (const auto* chains : {&shape.rings, &shape.lines})
    for (const auto& chain : *chains)
      for (const Vec2& p : chain) {
        west = std::min(west, p.x);
        east = std::max(east, p.x);
      }
  const std::vector<double> shifts = turns.shiftsOnto(west, east);
  if (shifts.empty()) return;  // not on the DEM, wherever it is
  const auto copied = [](const std::vector<std::vector<Vec2>>& chains, double dx) {
    std::vector<std::vector<Vec2>> copies = chains;
    for (auto& chain : copies)
      for (Vec2& p : chain) p.x += dx;
    return copies;
  };
  if (shifts.size() == 1) {
    if (shifts[0] == 0) return;
    shape.rings = copied(shape.rings, shifts[0]);
    shape.lines = copied(shape.lines, shifts[0]);
    return;
  }
  OGRMultiPolygon all;
  std::vector<std::vector<Vec2>> lines;
  for (const double dx : shifts) {
    for (auto& line : copied(shape.lines, dx)) lines.push_back(std::move(line));
    const OGRMultiPolygon copy = polygonsOf(copied(shape.rings, dx));
    for (const OGRPolygon* polygon : copy) all.addGeometry(polygon);
  }
  shape.lines = std::move(lines);
  shape.rings = ringsOf(united(repaired(all, region.warnings), region.warnings));
}

Result<RegionArgument> regionArgumentOf(const StatedRegion& region, const Georeference& dem,
                                        const LongitudeTurns& turns) try {
  RegionArgument argument;
  if (region.box) {
    auto corners = cornersOf(*region.box, dem);
    if (!corners) return failure(corners.error().code, corners.error().message, "region");
    argument.shape.rings = {std::move(*corners)};
  } else {
    auto read = regionOf(region.polygons, dem.crsWkt);
    if (!read) return failure(ErrorCode::usage, read.error().message, "region");
    argument.shape.rings = std::move(read->rings);
    argument.warnings = std::move(read->warnings);
  }
  turnOnto(turns, argument);
  return argument;
} catch (...) {
  return caughtFailure("region");
}

Result<RegionArgument> readRegionArgument(const RegionText& region, const Georeference& dem,
                                          const LongitudeTurns& turns, const RunContext& context) try {
  auto read = readAndPlace(region, dem, turns, context);
  if (!read && read.error().culprit.empty()) read.error().culprit = fmt::format("region {}", region.text);
  return read;
} catch (...) {
  return caughtFailure(fmt::format("region {}", region.text));
}

}  // namespace arete
