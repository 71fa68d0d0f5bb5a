// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/table/point_attributes.h"
#include "io/table/point_rows.h"

namespace arete {

/// True by the name (.csv, .tsv, .txt, .xyz), or, for other names, if the first line that is no comment
/// starts with three numbers.
bool looksLikePointText(const std::string& path);

/// What the lines of a text hold.
enum class PointTextColumns {
  spatial,  ///< x, y and a height
  plan,     ///< x, y; the heights read are meaningless
};

/// The points of a text file; the format is described at readPoints(). `zColumn` names the column of heights;
/// empty = by the usual names. Origins are line numbers, counted from 1. `attributes` takes the fields that
/// are none of these, under the names of the first line, or "field_3", "field_4", ... by their place; it has
/// a row per point. Fields beyond the columns are left out, with a warning.
Result<PointRows> readPointText(const std::string& path, const std::string& zColumn,
                                std::vector<std::string>& warnings, const RunContext& context,
                                PointTextColumns columns = PointTextColumns::spatial,
                                PointAttributes* attributes = nullptr);

}  // namespace arete
