// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"
#include "io/files/existing_file.h"
#include "io/geo/text/point_attributes.h"

namespace arete {

/// Lines with results: the columns of the input, then those of the results. A column of the input with the
/// name of a column of the results gets the suffix "_in".
struct LineTable {
  std::string layer;                          ///< name of the layer in a GeoPackage
  std::string crsWkt;                         ///< of the ends; empty: unknown
  std::span<const std::array<Vec2, 2>> ends;  ///< NaN: no geometry
  const PointAttributes* inputs = nullptr;    ///< a row per line
  const PointAttributes* results = nullptr;   ///< a row per line; an empty value is missing
  /// What happens to the other layers of a GeoPackage that exists.
  ExistingFile existing = ExistingFile::keepsOtherLayers;
};

/// Formats the table as CSV (RFC 4180, with line feeds). Calls `write` for the header line and for each row.
void forCsvLines(const LineTable& table, const std::function<void(std::string_view)>& write);

/// @return True for a name that writeLineTable() accepts: .csv, .gpkg.
bool isLineTable(const std::string& path);

/// Writes the table as CSV or as a GeoPackage with a layer of lines. The same table gives the same bytes. The
/// file appears complete or not at all.
///
/// Errors: usage: another extension. notFound, unreadable, interrupted. invalidData: a file of that name is
/// no GeoPackage, or has a layer of that name with other columns. O(rows).
Status writeLineTable(const std::string& path, const LineTable& table, const RunContext& context = {});

}  // namespace arete
