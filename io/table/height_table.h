// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/table/point_table.h"
#include "terrain/locate/surface_height.h"

namespace arete {

/// Points with the heights found for them: the input's own columns, then x and y as the input states them,
/// and height, below and above, which are empty where there is no terrain. Full resolution is within [height
/// - above, height + below]. A column of the input that has one of these names gets "_in" behind it.

/// "1234.5": twelve digits, which is more than any DEM knows.
std::string heightText(double height);

/// The table as CSV, RFC 4180 with line feeds: `write` gets the header line and then row after row.
void forCsvLines(const PointTable& table, std::span<const std::optional<SurfaceHeight>> heights,
                 const std::function<void(std::string_view)>& write);

/// True for a name that writeHeightTable() knows: .csv, .gpkg.
bool isHeightTable(const std::string& path);

/// Writes the table as CSV or as a GeoPackage (layer "heights", points in the CRS of the input). The file
/// appears whole or not at all. Precondition: a height or none per point. Errors: usage (another extension),
/// notFound, unreadable, interrupted. O(points).
Status writeHeightTable(const std::string& path, const PointTable& table,
                        std::span<const std::optional<SurfaceHeight>> heights,
                        const RunContext& context = {});

}  // namespace arete
