// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "engine/base/vec.h"

namespace arete {

enum class SightVerdict : std::uint8_t {
  visible,    ///< the line touches the terrain at most
  blocked,    ///< the terrain rises above it somewhere
  unknown,    ///< nothing known is in the way, but part of the line is over NODATA or outside of the DEM
  undecided,  ///< the detail asked for does not tell
};

/// What a part of a line that has no terrain below it counts as.
enum class NodataSight : std::uint8_t { unknown, clear, blocked };

struct SightOptions {
  NodataSight nodata = NodataSight::unknown;
  /// Stop at triangles whose bounds are within this, in the DEM's vertical unit: the answer may then be
  /// `undecided`. Only the descent through the multitriangulation does so; the others always tell.
  double maxError = 0;
  /// The least clearance along the whole line. Without it a blocked line is left at its first obstruction.
  bool wantsClearance = true;
  /// Where a blocked line is first obstructed. Without it and the clearance an engine may know only that.
  bool wantsObstruction = true;
};

/// A place on the line.
struct SightPlace {
  double distance = 0;  ///< metres along the ground
  Vec2 plan;
  double terrainHeight = 0, sightHeight = 0;  ///< in the DEM's vertical unit
};

struct SightAnswer {
  SightVerdict verdict = SightVerdict::visible;
  /// Where the line first meets higher terrain, or, where NODATA blocks, NODATA. Set if blocked and asked
  /// for. To the metre it is where the line goes under; by the tolerance of SightLine the terrain is higher
  /// there.
  std::optional<SightPlace> obstruction;
  /// For maxError > 0: the obstruction is that of terrain known within the tolerance; full resolution's is
  /// there or nearer to the first end.
  bool isObstructionLatest = false;
  /// The least height of the line above the terrain, negative when blocked: where terrain is below the line,
  /// and when it was asked for.
  std::optional<double> clearance;
  SightPlace least;  ///< where that is
  /// For maxError > 0: the clearance is within this of full resolution's.
  double clearanceWithin = 0;
  /// The least clearance is within the tolerance of SightLine of 0; it counts as visible.
  bool isTouching = false;
  double gapMetres = 0;       ///< how much of the line has no terrain below it; 0 where NODATA is clear
  std::uint64_t visited = 0;  ///< triangles, or cells and blocks of cells, looked at
};

}  // namespace arete
