// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/base/vec.h"

namespace arete {

enum class SightVerdict : std::uint8_t {
  visible,    ///< the terrain touches the line at most
  blocked,    ///< the terrain rises above the line somewhere
  unknown,    ///< nothing known is in the way, but part of the line is over NODATA or outside of the DEM
  undecided,  ///< the terrain within the requested tolerance does not decide it
};

/// Its name: "visible", "blocked", "unknown", "undecided".
std::string_view toString(SightVerdict verdict);

/// What a part of a line that has no terrain below it counts as.
enum class NodataSight : std::uint8_t { unknown, clear, blocked };
std::string_view toString(NodataSight nodata);

struct SightOptions {
  NodataSight nodata = NodataSight::unknown;
  /// Tolerance in the DEM's vertical unit: terrain is refined until its bounds are within it, and the answer
  /// may be `undecided`. 0 = full resolution. The descent alone uses it; other engines are always exact.
  double maxError = 0;
  /// Compute the least clearance along the whole line. Without it the search ends at the first obstruction.
  bool wantsClearance = true;
  /// Compute where a blocked line is first obstructed. Without it and the clearance an engine may return the
  /// verdict alone.
  bool wantsObstruction = true;
};

/// A point of the line.
struct SightPlace {
  double distance = 0;                        ///< metres along the ground from the first end
  Vec2 plan;                                  ///< plan coordinates of the model
  double terrainHeight = 0, sightHeight = 0;  ///< in the DEM's vertical unit
};

struct SightAnswer {
  SightVerdict verdict = SightVerdict::visible;
  /// Where the line first goes below the terrain; with NodataSight::blocked, or first is over NODATA (then
  /// its terrainHeight is NaN). Set if the line is blocked and wantsObstruction. From there on the terrain
  /// rises above the line by more than SightLine::tolerance().
  std::optional<SightPlace> obstruction;
  /// With a tolerance: the obstruction is one of approximate terrain. That of full resolution is there or
  /// nearer to the first end.
  bool isObstructionLatest = false;
  /// The least height of the line above the terrain, negative if blocked; in the DEM's vertical unit. Set if
  /// terrain is below the line and wantsClearance.
  std::optional<double> clearance;
  SightPlace least;  ///< where the least clearance is
  /// With a tolerance: the clearance is within this of that at full resolution.
  double clearanceWithin = 0;
  /// The least clearance is within SightLine::tolerance() of 0. That counts as visible.
  bool isTouching = false;
  double gapMetres = 0;       ///< length of the line without terrain below it; 0 with NodataSight::clear
  std::uint64_t visited = 0;  ///< triangles, or cells and squares of cells, that were examined
};

}  // namespace arete
