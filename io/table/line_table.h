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
#include "io/table/point_attributes.h"

namespace arete {

/// Lines with what was found for them: the input's own columns, then ours. A column of the input that has the
/// name of one of ours gets "_in" behind it.
struct LineTable {
  std::string layer;                          ///< name of a GeoPackage's layer
  std::string crsWkt;                         ///< of the ends; empty = not known
  std::span<const std::array<Vec2, 2>> ends;  ///< NaN: no geometry
  const PointAttributes* inputs = nullptr;    ///< a row per line
  const PointAttributes* results = nullptr;   ///< a row per line; empty values are none
};

/// The table as CSV, RFC 4180 with line feeds: `write` gets the header line and then row after row.
void forCsvLines(const LineTable& table, const std::function<void(std::string_view)>& write);

/// True for a name that writeLineTable() knows: .csv, .gpkg.
bool isLineTable(const std::string& path);

/// Writes the table as CSV or as a GeoPackage with a layer of lines, the same bytes for the same table. The
/// file appears whole or not at all. Errors: usage (another extension), notFound, unreadable, interrupted.
/// O(rows).
Status writeLineTable(const std::string& path, const LineTable& table, const RunContext& context = {});

}  // namespace arete
