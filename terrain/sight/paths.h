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

/// One line of sight that is asked for.
struct SightPath {
  Vec2 from, to;                        ///< plan coordinates; see sightPlan()
  double fromHeight = 0, toHeight = 0;  ///< in the DEM's vertical unit, from the DEM's own zero
};

/// Plan coordinates of a place in source coordinates, as lines of sight take them: longitudes are brought to
/// the turn that the DEM lies in, and what is within SurfaceHeights::margin() of a lattice line is put on it.
Vec2 sightPlan(const TerrainModel& model, Vec2 xy);

/// What grows on the terrain or is built on it, added to its height.
struct SightClutter {
  /// In the DEM's vertical unit, at a plan position; the same all over the stretch that it is asked in the
  /// middle of. Thread-safe. Empty = no clutter.
  std::function<double(Vec2)> height;
  double stepMetres = 0;  ///< stretches are cut so that none is longer; 0 = the height is one everywhere
  double freeMetres = 0;  ///< none this close to either end, measured along the ground
};

struct SightPathOptions {
  SightOptions sight;
  double frequencyMegahertz = 0;  ///< > 0: the Fresnel zone as well, at full resolution
  SightClutter clutter;           ///< answered from full profiles; no tolerance then
};

/// What a radio planner wants to know of a path.
struct SightPathAnswer {
  SightAnswer sight;
  double distanceMetres = 0;    ///< along the ground
  double azimuthDegrees = 0;    ///< at the first end, clockwise from north
  double elevationDegrees = 0;  ///< of the target over the horizontal of the first end, without refraction
  std::optional<FresnelClearance> fresnel;
};

/// A line over the Earth between the ends of a path. Errors: those of SightEarth::track(); invalidData for
/// heights that are not finite or so far below the ground that no line is straight.
Result<SightLine> sightLine(const SightPath& path, const SightEarth& earth, const TerrainModel& model);

/// Answers for one path. `profiles` is needed for a Fresnel zone and for clutter. O(engine).
Result<SightPathAnswer> answerPath(const SightPath& path, const SightEarth& earth, const SightEngine& engine,
                                   const Profiles& profiles, const SightPathOptions& options);

/// Answers for many, in their order, in parallel, the same for any number of threads. A path that has no line
/// has an error of its own. Errors: interrupted.
Result<std::vector<Result<SightPathAnswer>>> answerPaths(std::span<const SightPath> paths,
                                                         const SightEarth& earth, const SightEngine& engine,
                                                         const Profiles& profiles,
                                                         const SightPathOptions& options,
                                                         const RunContext& context = {});

}  // namespace arete
