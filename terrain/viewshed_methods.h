// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <optional>

#include "terrain/viewshed_exact.h"

namespace arete {

/// What the methods are handed: one observer on one raster, all checked.
struct ViewshedTask {
  const TerrainModel& model;
  const SightGrid& grid;
  const SightEarth& earth;
  const ViewshedObserver& observer;
  const ViewshedOptions& options;
  const ViewshedExact& exact;
};

/// Each cell by itself; fills cells, values and rays. Errors: interrupted, those of the earth.
Status viewshedRays(const ViewshedTask& task, const RunContext& context, Viewshed& result);

/// Why the sweep cannot do this; nothing where it can. O(1), O(samples) where heights must be known.
std::optional<std::string> whyNotSweep(const ViewshedTask& task);
/// Precondition: !whyNotSweep(). Fills cells, values and rays. Errors: interrupted.
Status viewshedSweep(const ViewshedTask& task, const RunContext& context, Viewshed& result);

}  // namespace arete
