// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/files/existing_file.h"
#include "io/geo/table/point_table.h"
#include "terrain/locate/ground_height.h"

namespace arete {

/// A table of heights has the columns of the input, then x and y as the input states and names them, in CSV
/// the z of points that have one (a GeoPackage has it in its points), and height, below and above, which are
/// empty without terrain. The height at full resolution is within [height - above, height + below]. A column
/// of the input with one of these names gets the suffix "_in".

/// @return "1234.5": at most twelve significant digits, more than the precision of any DEM.
std::string heightText(double height);

/// Formats the table as CSV (RFC 4180, with line feeds). Calls `write` for the header line and for each row.
void forCsvLines(const PointTable& table, std::span<const std::optional<GroundHeight>> heights,
                 const std::function<void(std::string_view)>& write);

/// @return The names of columns of the input, each with the one that it gets in the table, where they differ.
/// @param path Of the table; empty: CSV on stdout.
std::vector<std::array<std::string, 2>> renamedColumns(const PointTable& table, const std::string& path);

/// @return True for a name that writeHeightTable() accepts: .csv, .gpkg.
bool isHeightTable(const std::string& path);

/// Writes the table as CSV or as a GeoPackage (layer "heights", points in the CRS of the input). The file
/// appears complete or not at all.
///
/// @param heights One per point; nothing without terrain.
/// @param existing What happens to the other layers of a GeoPackage that exists.
///
/// Errors: usage: another extension. notFound, unreadable, interrupted. invalidData: a file of that name is
/// no GeoPackage, or has a layer "heights" with other columns. O(points).
Status writeHeightTable(const std::string& path, const PointTable& table,
                        std::span<const std::optional<GroundHeight>> heights, const RunContext& context = {},
                        ExistingFile existing = ExistingFile::keepsOtherLayers);

}  // namespace arete
