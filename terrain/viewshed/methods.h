// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <optional>
#include <span>

#include "terrain/viewshed/azimuthal_map.h"
#include "terrain/viewshed/exact.h"

namespace arete {

/// One observer on one raster, all checked: the input of both methods.
struct ViewshedTask {
  const TerrainModel& model;
  const SightGrid& grid;
  const SightEarth& earth;
  const ViewshedObserver& observer;
  const ViewshedOptions& options;
  const ViewshedExact& exact;
  const std::vector<float>& steepness;  ///< viewshedSteepness(), if the Earth has geodesics
};

/// Evaluates each cell by its own line. Fills cells, values and rays. Errors: interrupted, those of the
/// earth.
Status viewshedRays(const ViewshedTask& task, const RunContext& context, Viewshed& result);
/// The same for places in plan coordinates. NaN, and places without terrain, stay outside.
Status viewshedOfPlaces(const ViewshedExact& exact, const SightGrid& grid, std::span<const Vec2> places,
                        const RunContext& context, Viewshed& result);

/// @param map the observer's, if there is one; null checks what can be checked without it. O(1).
/// @return why the sweep cannot do the task; nothing if it can.
std::optional<std::string> whyNotSweep(const ViewshedTask& task, const AzimuthalMap* map);
/// Sweeps the plane. Fills cells, values and rays. Precondition: !whyNotSweep(task, map). Errors:
/// interrupted, those of the earth.
/// @param map the observer's; null if the Earth is a plane.
Status viewshedSweep(const ViewshedTask& task, const AzimuthalMap* map, const RunContext& context,
                     Viewshed& result);

}  // namespace arete
