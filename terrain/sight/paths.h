// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"
#include "terrain/sight/answer.h"
#include "terrain/sight/earth.h"
#include "terrain/sight/engine.h"
#include "terrain/sight/fresnel.h"
#include "terrain/sight/profile.h"

namespace arete {

/// A path to evaluate: two antennas, or an observer and a target.
struct SightPath {
  Vec2 from, to;                        ///< plan coordinates; see sightPlan()
  double fromHeight = 0, toHeight = 0;  ///< in the DEM's vertical unit, from the DEM's own zero
};

/// @param xy source coordinates.
/// @return the plan coordinates that paths use: longitudes are brought to the turn that the DEM lies in, and
///     places within GroundHeights::margin() of a lattice line are put on it.
Vec2 sightPlan(const TerrainModel& model, Vec2 xy);

/// Vegetation and buildings, added to the height of the terrain.
struct SightClutter {
  /// Height above the terrain in the DEM's vertical unit, at a plan position. Evaluated in the middle of each
  /// stretch and used for all of it. Thread-safe. Empty = no clutter.
  std::function<double(Vec2)> height;
  double stepMetres = 0;  ///< length of the longest stretch; 0 = the height is the same everywhere
  double freeMetres = 0;  ///< metres along the ground from either end that have no clutter
};

struct SightPathOptions {
  SightOptions sight;
  double frequencyMegahertz = 0;  ///< > 0: the Fresnel zone too, at full resolution
  SightClutter clutter;           ///< lines are then evaluated over whole profiles, without a tolerance
};

/// The answer for one path.
struct SightPathAnswer {
  SightAnswer sight;
  double distanceMetres = 0;    ///< along the ground
  double azimuthDegrees = 0;    ///< at the first end, clockwise from north
  double elevationDegrees = 0;  ///< of the second end over the horizontal of the first, without refraction
  std::optional<FresnelClearance> fresnel;  ///< leastFresnelClearance(), if a frequency is given
};

/// @return the sight line between the ends of a path. Errors: those of SightEarth::track() and
///     checkSightHeights().
Result<SightLine> sightLine(const SightPath& path, const SightEarth& earth, const TerrainModel& model);

/// Answers one path. O(engine), and O(profile) for a Fresnel zone or clutter.
/// @param profiles of the engine's model.
/// @return Errors: those of sightLine().
Result<SightPathAnswer> answerPath(const SightPath& path, const SightEarth& earth, const SightEngine& engine,
                                   const Profiles& profiles, const SightPathOptions& options);

/// Answers many paths in parallel; the same for any number of threads.
/// @return one result per path, in their order, each an answer or an error of answerPath(). Errors:
/// interrupted.
Result<std::vector<Result<SightPathAnswer>>> answerPaths(std::span<const SightPath> paths,
                                                         const SightEarth& earth, const SightEngine& engine,
                                                         const Profiles& profiles,
                                                         const SightPathOptions& options,
                                                         const RunContext& context = {});

}  // namespace arete
