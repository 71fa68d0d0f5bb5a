// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lists of names in order of preference; the files that people have use few others.
#include "io/geo/text/column_rules.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "io/files/text_scan.h"

namespace arete {
namespace {

using Names = std::vector<std::string_view>;

const Names kX = {"x",    "lon", "long",    "longitude", "lng",    "easting",
                  "east", "e",   "x_coord", "xcoord",    "point_x"};
const Names kY = {"y", "lat", "latitude", "northing", "north", "n", "y_coord", "ycoord", "point_y"};
const Names kZ = {"z",   "elev",     "elevation", "height", "h",      "alt",
                  "ele", "altitude", "z_coord",   "zcoord", "point_z"};

const Names kWkt = {"wkt",      "_wkt", "the_geom",     "geom_wkt",     "wkt_geom",
                    "geometry", "geom", "wkt_geometry", "geometry_wkt", "wkt_point"};

Names joined(Names first, const Names& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

const std::array<Names, 2> kEndX = {
    joined({"x1", "from_x", "x_from", "lon1", "from_lon", "tx_x", "tx_lon"}, kX),
    Names{"x2", "to_x", "x_to", "lon2", "to_lon", "rx_x", "rx_lon"}};
const std::array<Names, 2> kEndY = {
    joined({"y1", "from_y", "y_from", "lat1", "from_lat", "tx_y", "tx_lat"}, kY),
    Names{"y2", "to_y", "y_to", "lat2", "to_lat", "rx_y", "rx_lat"}};
const std::array<Names, 2> kEndHeight = {
    Names{"h1", "from_h", "from_height", "height1", "tx_h", "tx_height", "observer_height", "h", "height",
          "agl", "height_agl", "antenna_height"},
    Names{"h2", "to_h", "to_height", "height2", "rx_h", "rx_height", "target_height"}};
const Names kAzimuth = {"azimuth", "az", "bearing"}, kRange = {"range", "range_m"},
            kBeamwidth = {"beamwidth", "beam_width", "hpbw"};

}  // namespace

std::span<const std::string_view> ColumnNames::x() {
  return kX;
}
std::span<const std::string_view> ColumnNames::y() {
  return kY;
}
std::span<const std::string_view> ColumnNames::z() {
  return kZ;
}
std::span<const std::string_view> ColumnNames::wkt() {
  return kWkt;
}
std::span<const std::string_view> ColumnNames::endX(int end) {
  return kEndX[std::size_t(end)];
}
std::span<const std::string_view> ColumnNames::endY(int end) {
  return kEndY[std::size_t(end)];
}
std::span<const std::string_view> ColumnNames::endHeight(int end) {
  return kEndHeight[std::size_t(end)];
}
std::span<const std::string_view> ColumnNames::azimuth() {
  return kAzimuth;
}
std::span<const std::string_view> ColumnNames::range() {
  return kRange;
}
std::span<const std::string_view> ColumnNames::beamwidth() {
  return kBeamwidth;
}

std::optional<std::size_t> findColumn(std::size_t count,
                                      const std::function<std::string_view(std::size_t)>& nameOf,
                                      std::span<const std::string_view> names) {
  for (const std::string_view name : names)
    for (std::size_t i = 0; i < count; ++i)
      if (text::lowered(nameOf(i)) == name) return i;
  return std::nullopt;
}

}  // namespace arete
