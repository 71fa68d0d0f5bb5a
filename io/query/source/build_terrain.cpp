// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/source/build_terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "engine/memory/required_memory.h"
#include "io/files/text/grouped.h"
#include "terrain/features/fixed_vertices.h"

namespace arete {
namespace {

/// What a build needs at the least; rough terrain takes up to twice as much (terrain/builder/build.h).
constexpr double kLeastBuildBytesPerSample = 164;
/// What it needs at the most. A budget is held in any case.
constexpr double kMostBuildBytesPerSample = 300;

}  // namespace

// Samples without data take no memory.
Status checkBuildMemory(const DemHeightfield& heights, const std::string& path) {
  return std::visit(
      [&](const auto& field) -> Status {
        const double valid = static_cast<double>(
            field.heights.size() - static_cast<std::size_t>(std::ranges::count_if(
                                       field.heights, [](double height) { return std::isnan(height); })));
        const bool hasBudget = memoryBudget() > 0;
        // Of a budget the heights are in use already.
        const double bytes = hasBudget ? valid * kMostBuildBytesPerSample
                                       : valid * kLeastBuildBytesPerSample +
                                             static_cast<double>(field.heights.size() * sizeof(double));
        const Status memory = checkMemory(
            bytes, fmt::format("a build of {} samples would", grouped(static_cast<std::uint64_t>(valid))));
        if (memory) return {};
        if (hasBudget) return failure(memory.error().code, memory.error().message, path);
        return failure(memory.error().code,
                       memory.error().message +
                           ": build a part of it (gdal_translate -srcwin) or a coarser DEM (gdalwarp -tr)",
                       path);
      },
      heights);
}

Result<TerrainModel> buildTerrain(const DemHeightfield& heights, const std::string& path,
                                  BuildOptions options, const RunContext& context) {
  ARETE_CHECK(checkBuildMemory(heights, path));
  return std::visit(
      [&](const auto& field) -> Result<TerrainModel> {
        if constexpr (std::is_same_v<decltype(field), const PointHeightfield&>) {
          ARETE_CHECK(checkBuild(field, options));
          ARETE_TRY(FinestPoints finest, finestPoints(field, context));
          ARETE_TRY(FixedVertices fixed, chooseFixedVertices(field, finest, {}, context));
          options.fixedVertices = std::move(fixed.vertices);
          return build(field, std::move(finest), options, context);
        } else {
          ARETE_TRY(FixedVertices fixed, chooseFixedVertices(field, {}, context));
          options.fixedVertices = std::move(fixed.vertices);
          return build(field, options, context);
        }
      },
      heights);
}

}  // namespace arete
