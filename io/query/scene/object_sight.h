// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/scene/open_scene.h"
#include "terrain/sight/paths.h"

namespace arete {

/// A line bends over an object in chords that are off by at most so many metres.
inline constexpr double kChordSag = 1e-4;
/// What is within so many metres of an end of a line does not block it: an antenna stands on its mast.
inline constexpr double kFreeAtEnds = 1e-3;

/// Where a line of sight first meets an object.
struct ObjectHit {
  std::size_t object = 0;  ///< of the scene
  SightPlace place;        ///< its terrainHeight is that of the object there
};

/// Finds, for each path, the first triangle of the scene's surfaces at full resolution that the line meets,
/// touching included; the terrain does not count. Objects that are not shown do not block.
///
/// On flat metric space the objects stand as placedInScene() says; lines are those of sightLine(), curved by
/// the Earth and by refraction, in chords (kChordSag). What is a line without a track has no answer.
///
/// Errors: interrupted. O(paths * objects) for balls, and a descent for each that a line comes near.
/// Parallel; the same for any number of threads.
Result<std::vector<std::optional<ObjectHit>>> hitObjects(std::span<const SightPath> paths,
                                                         const SightEarth& earth, const OpenScene& scene,
                                                         const RunContext& context = {});

/// Joins both answers: a line that meets an object is blocked, whatever is known of the terrain; the
/// obstruction is the nearer one. Clearances, touching and gaps stay those of the terrain.
///
/// @return whether the object is the obstruction.
bool joinHit(SightAnswer& answer, const ObjectHit& hit);

}  // namespace arete
