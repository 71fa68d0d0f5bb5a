// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"
#include "io/store/amt/file.h"
#include "io/store/format/required_error.h"
#include "terrain/model/terrain_model.h"
#include "terrain/sight/earth.h"

namespace arete {

// A question reads the outline of a file, which says where its places lie, finds with it which terrain they
// touch, and reads that. Every answer is the one of the whole model. Every check is done.

/// Reads everything but the terrain: of a raster, the root. Of points, the whole model, because the rounding
/// of their coordinates follows from their number. Errors: as AmtFile::read().
Result<TerrainModel> outlineOf(const AmtFile& file, const RunContext& context = {});

/// Reads the part of the model that a question requires.
/// @param outline  outlineOf() the file
/// @param wanted   the error required at each place; null: everything
/// Errors: as AmtFile::read().
Result<TerrainModel> readWanted(const AmtFile& file, const TerrainModel& outline, const RequiredError& wanted,
                                const RunContext& context = {});

/// What heights at places require: full resolution there.
/// @param plan  in plan coordinates; those that are not finite are ignored
/// O(places + cells of the footprint).
RequiredError wantedAt(std::span<const Vec2> plan, const TerrainModel& outline);

/// What lines of sight require: the terrain at both ends and below the line.
/// @param ends  of each line, in source coordinates
RequiredError wantedBetween(std::span<const std::array<Vec2, 2>> ends, const SightEarth& earth,
                            const TerrainModel& outline);

/// What profiles along lines require.
/// @param lines  their vertices, in source coordinates
RequiredError wantedAlong(std::span<const std::vector<Vec2>> lines, const SightEarth& earth,
                          const TerrainModel& outline);

/// An observer of a viewshed, and how far it looks.
struct AskedRange {
  Vec2 place;         ///< in source coordinates
  double metres = 0;  ///< along the ground; may be infinite
};
/// What viewsheds require: the terrain within range of an observer. Null (everything) where one has no limit.
/// @param margin  also the rectangle around all of it, wider by this part of its longer side, as for a map
/// Errors: interrupted. O(cells of the footprint) distances for each observer.
Result<RequiredError> wantedInRange(std::span<const AskedRange> observers, const SightEarth& earth,
                                    const TerrainModel& outline, std::optional<double> margin = std::nullopt,
                                    const RunContext& context = {});

}  // namespace arete
