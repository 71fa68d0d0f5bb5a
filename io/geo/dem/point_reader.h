// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/heightfield.h"

namespace arete {

/// Which height a place has where points of a file have different ones there.
enum class SamePlace { refuse, least, greatest, mean, first };

/// @return The rule by its name: error, min, max, mean, first.
std::optional<SamePlace> samePlaceNamed(std::string_view name);

struct PointReadOptions {
  std::string layer = {};  ///< needed if a file has several; not for text
  /// The attribute or column of heights. Empty: the z of the geometry, or a column with a usual name.
  std::string zField = {};
  SamePlace samePlace = SamePlace::refuse;
  std::string crs = {};               ///< as for rasters
  std::optional<double> nodata = {};  ///< points of that height are left out, with a warning
  std::string verticalUnit = {};      ///< as for rasters
  std::optional<bool> isDepth = {};   ///< as for rasters
};

struct PointRead {
  PointHeightfield heightfield;
  Warnings warnings;
};

/// Reads scattered points: text (.csv, .tsv, .txt, .xyz, or any file that looks like it) or points and
/// multipoints of any vector format GDAL knows.
///
/// Text: one point per line; comma, semicolon, tab, vertical bar or spaces between the fields; '#' outside
/// quotes begins a comment; a text in quotes may contain separators and line breaks. UTF-8, UTF-16, any line
/// ends. A first line without any number names the columns: x or lon or easting, y or lat or northing, z or
/// elev or height (or PointReadOptions::zField) and their like; without one, or with no name known, the first
/// three are x, y, z, or the three behind a first field that is not a number. Numbers have a decimal point,
/// or all of them a decimal comma where that is not a separator; exponents may be Fortran's (1.5D+03). Points
/// whose height is nan or missing are left out, with a warning.
///
/// Keeps the order of the file. Of equal points (x, y and z) the first is kept; a warning counts the others.
/// Points at one place with different heights become one by PointReadOptions::samePlace, with a warning.
/// The georeference is the identity: grid coordinates equal source coordinates. Heights count upwards: the
/// depths of a CRS that points down are negated, with a warning.
///
/// Errors: notFound, unreadable, corrupt. unsupported: no layer of points, or several (lists them); other
/// geometries. usage: no such column or field; not a CRS. invalidData: a line that does not parse, with its
/// number; a coordinate that is not finite; no point. degenerate: equal x, y with different z, and no rule
/// for it; names both points. interrupted. O(n log n); memory about 60 bytes per point.
Result<PointRead> readPoints(const std::string& path, const PointReadOptions& options = {},
                             const RunContext& context = {});

/// Takes points that another reader has read, as readPoints() takes those of a file: equal ones once, and one
/// height for each place. PointReadOptions::layer and zField have no meaning.
///
/// @param crsWkt theirs; empty: none.
/// @param source names them in messages, as the culprit, and in the heightfield.
/// Errors: those of readPoints() but for files. O(n log n).
Result<PointRead> pointsFrom(std::span<const Vec3> points, const std::string& crsWkt,
                             const std::string& source, const PointReadOptions& options = {});

}  // namespace arete
