// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/geo/crs/longitude_turns.h"
#include "python/bindings/terrain.h"
#include "terrain/sight/answer.h"
#include "terrain/sight/earth.h"

namespace arete::python {

/// How lines of sight are taken.
struct SightRequest {
  std::string earth, nodata;
  std::optional<double> refraction;
};

/// Errors: usage, naming the argument.
Result<std::unique_ptr<SightEarth>> makeEarth(const SightRequest& request, const TerrainModel& model);
Result<NodataSight> nodataOf(const SightRequest& request);

/// An end above the ground, in plan coordinates and from the DEM's zero. Errors: usage, naming the end.
/// @param ground  what was read at the end
Result<std::pair<Vec2, double>> endOf(const LocatedTerrain& ground, const LongitudeTurns& turns,
                                      const double* xyh, const std::string& culprit);

/// Lines of sight, viewsheds, and what a mesh is off the terrain.
void defineSight(pybind11::class_<Terrain, std::shared_ptr<Terrain>>& terrain);

}  // namespace arete::python
