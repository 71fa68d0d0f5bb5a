// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

namespace arete {

/// The names by which every reader of tables finds a column, in lower case and in order of preference.
struct ColumnNames {
  static std::span<const std::string_view> x();  ///< x, lon, easting, ...
  static std::span<const std::string_view> y();  ///< y, lat, northing, ...
  static std::span<const std::string_view> z();  ///< the height of a point: z, elev, height, ...

  static std::span<const std::string_view> wkt();  ///< a point as text: wkt, the_geom, geometry, ...

  /// Of the two ends of a sight line: x1, from_lon, ... The first end has the names of a point as well.
  ///
  /// @param end 0 or 1.
  static std::span<const std::string_view> endX(int end);
  static std::span<const std::string_view> endY(int end);
  /// The stated height of an end, above ground or with its own word: h1, observer_height, agl, ...
  static std::span<const std::string_view> endHeight(int end);

  static std::span<const std::string_view> azimuth();
  static std::span<const std::string_view> range();
  static std::span<const std::string_view> beamwidth();
};

/// Finds the column that has the most preferred name; upper and lower case are equal. Of two columns with one
/// name it is the first.
///
/// @param count Number of columns.
/// @param nameOf The name of a column by its index.
/// @param names In lower case.
std::optional<std::size_t> findColumn(std::size_t count,
                                      const std::function<std::string_view(std::size_t)>& nameOf,
                                      std::span<const std::string_view> names);

}  // namespace arete
