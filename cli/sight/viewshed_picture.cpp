// SPDX-License-Identifier: GPL-3.0-or-later
//
// Answers take 8 bits and have a colour table. Numbers of observers take 16, where a table would have 65 536
// colours, each of which QGIS lists; they have none.
#include "cli/sight/viewshed_picture.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace arete {
namespace {

using Mode = ViewshedMode;

/// Numbers of observers take 16 bits, of which the largest are for what has no number.
constexpr double kUnknownCount = 65533, kUndecidedCount = 65534, kNoCount = 65535;

/// Colours that people who cannot tell red from green tell apart too.
std::vector<GeoTiffOptions::Color> answerColors() {
  return {{byteOf(ViewshedCell::seen), 26, 152, 80},
          {byteOf(ViewshedCell::hidden), 189, 189, 189},
          {byteOf(ViewshedCell::unknown), 254, 224, 139},
          {byteOf(ViewshedCell::undecided), 145, 116, 199},
          {byteOf(ViewshedCell::outside), 0, 0, 0}};
}

const char* descriptionOf(Mode mode) {
  switch (mode) {
    case Mode::height:
      return "least height above the terrain that is seen; infinite = none";
    case Mode::horizon:
      return "elevation of the horizon, degrees";
    case Mode::count:
      return "observers that see it; 65533 unknown, 65534 undecided";
    case Mode::server:
      return "nearest observer that sees it, from 1; 0 = none, 65533 unknown, 65534 undecided";
    default:
      return "255 seen, 0 hidden, 100 unknown, 200 undecided";
  }
}

}  // namespace

ViewshedPicture viewshedPictureOfOne(Mode mode, const Viewshed& viewshed) {
  ViewshedPicture picture;
  picture.values.reserve(viewshed.cells.size());
  if (mode == Mode::seen) {
    picture.options = {.sample = GeoTiffOptions::Sample::uint8,
                       .description = descriptionOf(mode),
                       .nodata = double(byteOf(ViewshedCell::outside)),
                       .colors = answerColors()};
    for (const ViewshedCell cell : viewshed.cells) picture.values.push_back(byteOf(cell));
    return picture;
  }
  // Heights and horizons are floats, in which NaN is NODATA.
  picture.options.description = descriptionOf(mode);
  picture.isHeight = mode == Mode::height;
  for (std::size_t i = 0; i < viewshed.cells.size(); ++i) {
    double value = viewshed.cells[i] == ViewshedCell::outside ? std::nan("") : double(viewshed.values[i]);
    if (mode == Mode::horizon) value = std::atan(value) * 180 / std::numbers::pi;
    picture.values.push_back(value);
  }
  return picture;
}

ViewshedPicture viewshedPictureOfMany(Mode mode, const ViewshedOfMany& all) {
  ViewshedPicture picture;
  picture.options = {
      .sample = mode == Mode::seen ? GeoTiffOptions::Sample::uint8 : GeoTiffOptions::Sample::uint16,
      .description = descriptionOf(mode),
      .nodata = mode == Mode::seen ? double(byteOf(ViewshedCell::outside)) : kNoCount};
  if (mode == Mode::seen) picture.options.colors = answerColors();
  picture.values.reserve(all.cells.size());
  for (std::size_t i = 0; i < all.cells.size(); ++i) {
    const bool isOutside = all.cells[i] == ViewshedCell::outside;
    picture.values.push_back(mode == Mode::seen    ? byteOf(all.cells[i])
                             : isOutside           ? std::nan("")
                             : mode == Mode::count ? all.count[i]
                                                   : all.server[i]);
  }
  return picture;
}

PolygonFields viewshedPolygonFields(ViewshedMode mode, std::string layer) {
  PolygonFields fields;
  fields.layer = std::move(layer);
  fields.value = mode == Mode::count ? "count" : mode == Mode::server ? "server" : "value";
  if (mode == Mode::seen) {
    fields.isNumber = [](double) { return true; };
    fields.answer = [](double value) {
      return value == byteOf(ViewshedCell::seen)      ? "seen"
             : value == byteOf(ViewshedCell::hidden)  ? "hidden"
             : value == byteOf(ViewshedCell::unknown) ? "unknown"
                                                      : "undecided";
    };
    return fields;
  }
  fields.isNumber = [](double value) { return value < kUnknownCount; };
  fields.answer = [](double value) {
    return value == kUnknownCount     ? "unknown"
           : value == kUndecidedCount ? "undecided"
           : value > 0                ? "seen"
                                      : "hidden";
  };
  return fields;
}

}  // namespace arete
