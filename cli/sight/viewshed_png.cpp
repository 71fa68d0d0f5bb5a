// SPDX-License-Identifier: GPL-3.0-or-later
//
// The relief below the answers is the terrain at the places of the answer's own grid.
#include "cli/sight/viewshed_png.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "cli/arguments/arguments.h"
#include "io/geo/crs/transform.h"
#include "viewer/decoration/scale_bar.h"
#include "viewer/map/viewshed_map.h"

namespace arete {
namespace {

ViewshedMapKind kindOf(ViewshedMode mode) {
  switch (mode) {
    case ViewshedMode::height:
      return ViewshedMapKind::heights;
    case ViewshedMode::horizon:
      return ViewshedMapKind::horizon;
    case ViewshedMode::count:
      return ViewshedMapKind::counts;
    case ViewshedMode::server:
      return ViewshedMapKind::servers;
    default:
      return ViewshedMapKind::answers;
  }
}

RasterHeightfield groundOf(const ViewshedMapQuestion& q) {
  RasterHeightfield ground;
  ground.columns = q.grid.columns;
  ground.rows = q.grid.rows;
  ground.georeference = q.grid.georeference;
  ground.georeference.verticalUnit = q.model.georeference.verticalUnit;
  ground.georeference.verticalUnitMetres = q.model.georeference.verticalUnitMetres;
  ground.heights.reserve(std::size_t{ground.columns} * ground.rows);
  for (std::uint32_t row = 0; row < ground.rows; ++row)
    for (std::uint32_t column = 0; column < ground.columns; ++column) {
      const std::size_t i = std::size_t{row} * ground.columns + column;
      const Vec2 place = q.grid.places.empty() ? Vec2{double(column), double(row)} : q.grid.places[i];
      const bool isPlace = std::isfinite(place.x + place.y);
      ground.heights.push_back(isPlace ? q.maker.grid().at(place) : std::numeric_limits<double>::quiet_NaN());
    }
  return ground;
}

/// The observers in the columns and rows of the grid; NaN where its CRS has no place for one.
Result<std::vector<Vec2>> dotsOf(const ViewshedMapQuestion& q) {
  CrsTransform toGrid;
  const std::string &from = q.model.georeference.crsWkt, &to = q.grid.georeference.crsWkt;
  if (from != to && !from.empty() && !to.empty()) {
    ARETE_TRY(toGrid, CrsTransform::between(from, to));
  }
  std::vector<Vec2> dots;
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  for (const ViewshedSite& site : q.observers) {
    const auto at = toGrid(q.model.toSource(site.observer.plan));
    dots.push_back(at ? q.grid.georeference.toGrid(at->x, at->y) : Vec2{kNowhere, kNowhere});
  }
  return dots;
}

/// The smallest and the largest of a number that each observer has; NaN is left out.
struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double value) {
    if (std::isnan(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// How high the observers are above the ground, to a thousandth.
Span heightsAboveGround(const ViewshedMapQuestion& q) {
  Span span;
  for (const ViewshedSite& site : q.observers)
    span.add(std::round((site.observer.height - q.maker.grid().at(site.observer.plan)) * 1000) / 1000);
  return span;
}

/// The field of view; empty if all is in it. Observers of a file may have their own ranges and azimuths.
std::string fieldWords(const ViewshedMapQuestion& q) {
  const Georeference& dem = q.model.georeference;
  const auto length = [&](double metres) { return lengthText(metres, !dem.crsWkt.empty(), "units"); };
  const ViewshedField& first = q.observers.front().field;
  Span ranges;
  bool isOneAzimuth = true;
  for (const ViewshedSite& site : q.observers) {
    ranges.add(site.field.greatestMetres);
    isOneAzimuth = isOneAzimuth && site.field.fromAzimuth == first.fromAzimuth &&
                   site.field.azimuthSpan == first.azimuthSpan;
  }
  std::vector<std::string> words;
  if (std::isfinite(ranges.low) && ranges.low == ranges.high)
    words.push_back("within " + length(ranges.high));
  else if (std::isfinite(ranges.low))
    words.push_back("own ranges, from " + length(ranges.low) +
                    (std::isfinite(ranges.high) ? " to " + length(ranges.high) : " to no limit"));
  if (first.leastMetres > 0) words.push_back("beyond " + length(first.leastMetres));
  if (!isOneAzimuth)
    words.emplace_back("own azimuths");
  else if (first.azimuthSpan < 360)
    words.push_back(fmt::format("azimuths {:g}\u00b0 to {:g}\u00b0", first.fromAzimuth,
                                std::fmod(first.fromAzimuth + first.azimuthSpan, 360)));
  if (first.lowest > -90 || first.highest < 90)
    words.push_back(fmt::format("elevations {:g}\u00b0 to {:g}\u00b0", first.lowest, first.highest));
  return fmt::format("{}", fmt::join(words, "   \u00b7   "));
}

/// What was computed, in words.
std::vector<std::string> captionOf(const ViewshedMapQuestion& q) {
  const ViewshedArguments& a = q.arguments;
  const Georeference& dem = q.model.georeference;
  const auto above = [&](double height) { return withUnit(height, dem.verticalUnit) + " above the ground"; };
  std::string first;
  if (q.observers.size() == 1) {
    const ViewshedObserver& observer = q.observers.front().observer;
    const double ground = q.maker.grid().at(observer.plan);
    first = std::isnan(ground) ? "observer at a height of " + withUnit(observer.height, dem.verticalUnit)
                               : "observer " + above(std::round((observer.height - ground) * 1000) / 1000);
  } else {
    first = grouped(q.observers.size(), "observer", "observers");
    const Span heights = heightsAboveGround(q);
    if (heights.low == heights.high)
      first += " " + above(heights.low);
    else if (heights.low < heights.high)
      first += fmt::format(" {:g} to {}", heights.low, above(heights.high));
  }
  // The heights and the horizon do not depend on a target.
  if (a.mode != ViewshedMode::height && a.mode != ViewshedMode::horizon)
    first += "   \u00b7   target " + above(q.options.targetHeight);
  std::string second = earthWords(dem, a.sight.earthName(q.model) == "ellipsoid", a.sight.refraction);
  if (a.sight.nodata != NodataSight::unknown)
    second += fmt::format("   \u00b7   places without data: {}", toString(a.sight.nodata));
  if (q.options.maxError > 0)
    second += fmt::format("   \u00b7   terrain within {}", withUnit(q.options.maxError, dem.verticalUnit));
  std::vector<std::string> caption = {first};
  if (const std::string field = fieldWords(q); !field.empty()) caption.push_back(field);
  caption.push_back(second);
  return caption;
}

std::string titleOf(const ViewshedMapQuestion& q) {
  const std::string file = std::filesystem::path(q.arguments.model).filename().string();
  switch (q.arguments.mode) {
    case ViewshedMode::height:
      return file + ": the least height that is seen";
    case ViewshedMode::horizon:
      return file + ": the elevation of the horizon";
    case ViewshedMode::count:
      return file + ": how many observers see it";
    case ViewshedMode::server:
      return file + ": the nearest observer that sees it";
    default:
      return file + ": what is seen" + (q.observers.size() > 1 ? " by any observer" : "");
  }
}

}  // namespace

Status writeViewshedPng(const ViewshedMapQuestion& q) {
  ARETE_TRY(const auto dots, dotsOf(q));
  const ViewshedMapKind kind = kindOf(q.arguments.mode);
  const RasterHeightfield ground = groundOf(q);
  const bool hasValues = kind != ViewshedMapKind::answers;
  ARETE_TRY(const auto canvas,
            drawViewshedMap(ground, q.cells,
                            hasValues ? std::span<const double>(q.values) : std::span<const double>(), dots,
                            {.title = titleOf(q),
                             .caption = captionOf(q),
                             .isDecorated = !q.arguments.isPlainPicture,
                             .kind = kind}));
  return canvas.savePng(q.arguments.png);
}

}  // namespace arete
