// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <optional>
#include <span>

#include "terrain/viewshed/azimuthal_map.h"
#include "terrain/viewshed/exact.h"

namespace arete {

/// What the methods are handed: one observer on one raster, all checked.
struct ViewshedTask {
  const TerrainModel& model;
  const SightGrid& grid;
  const SightEarth& earth;
  const ViewshedObserver& observer;
  const ViewshedOptions& options;
  const ViewshedExact& exact;
  const std::vector<float>& steepness;  ///< viewshedSteepness(), where the Earth has geodesics
};

/// Each cell by itself; fills cells, values and rays. Errors: interrupted, those of the earth.
Status viewshedRays(const ViewshedTask& task, const RunContext& context, Viewshed& result);
/// The same for places in plan coordinates; NaN and what has no terrain is outside.
Status viewshedOfPlaces(const ViewshedExact& exact, const SightGrid& grid, std::span<const Vec2> places,
                        const RunContext& context, Viewshed& result);

/// Why the sweep cannot do this; nothing where it can. Without the map that the Earth has, as far as the
/// observer and the options go. O(1).
std::optional<std::string> whyNotSweep(const ViewshedTask& task, const AzimuthalMap* map);
/// Preconditions: !whyNotSweep(task, map); the map is the observer's; null where the Earth is a plane. Fills
/// cells, values and rays. Errors: interrupted, those of the earth.
Status viewshedSweep(const ViewshedTask& task, const AzimuthalMap* map, const RunContext& context,
                     Viewshed& result);

}  // namespace arete
