// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/geo/text/point_attributes.h"
#include "io/geo/text/point_rows.h"

namespace arete {

/// @return True for a name that ends in .csv, .tsv, .txt or .xyz, and for any other file whose first line
/// that is not a comment begins with three numbers, or with as many as are needed.
/// @param needed 2 where places are read and no heights.
bool looksLikePointText(const std::string& path, std::size_t needed = 3);

/// The columns that a text of points must have.
enum class PointTextColumns {
  spatial,   ///< x, y and a height
  plan,      ///< x, y; the heights in the result are those of points in WKT, NaN without
  planRows,  ///< as plan; a row without x or y has NaN for what is missing
};

/// Reads the points of a text file; readPoints() describes the format. A quoted text may contain line breaks
/// and separators. Without columns of x and y, a column of points in WKT or EWKT has them
/// (io/files/text/wkt_point.h); it counts as an attribute as well. Row origins are line numbers, counted from
/// 1: of the first line of a record.
///
/// @param zColumn Name of the column of heights; empty: any of the usual names.
/// @param attributes If not null, gets the other fields, a row per point. The columns have the names of the
/// first line, or "field_3", "field_4", ... by their index. Fields beyond the last column are dropped, with a
/// warning.
///
/// Errors: notFound, unreadable. usage: no column `zColumn`. invalidData: a record that does not parse (the
/// culprit is "path:line"), a record of more than a mebibyte. interrupted. O(file size).
Result<PointRows> readPointText(const std::string& path, const std::string& zColumn, Warnings& warnings,
                                const RunContext& context,
                                PointTextColumns columns = PointTextColumns::spatial,
                                PointAttributes* attributes = nullptr);

}  // namespace arete
