// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/crs/transform.h"
#include "terrain/locate/surface_height.h"

namespace arete {

/// What the height of a position is counted from.
enum class HeightKind {
  aboveGround,  ///< agl: the terrain at full resolution
  seaLevel,     ///< msl: the geoid, as the heights of most DEMs
  ellipsoidal,  ///< ell
};
std::string_view toString(HeightKind kind);

/// A position in space as a person states it.
struct PositionArgument {
  Vec2 xy;            ///< in the DEM's CRS
  double height = 0;  ///< in the DEM's vertical unit
  HeightKind kind = HeightKind::aboveGround;
};

/// A finite number, blanks around it allowed. Errors: usage, quoting the text.
Result<double> readNumberText(std::string_view text);

/// A height by itself: "30", "30agl", "120.5msl", "98ell".
struct StatedHeight {
  double height = 0;  ///< in the DEM's vertical unit
  HeightKind kind = HeightKind::aboveGround;
};
Result<StatedHeight> readHeightText(std::string_view text);

/// The place "X,Y". `toDem` brings what was typed into the DEM's CRS: CrsTransform::fromLonLat() for
/// longitude and latitude, CrsTransform() for the DEM's own coordinates. `option` is named in errors. Errors:
/// usage.
Result<Vec2> readPlaceArgument(const std::string& option, const std::string& text, const CrsTransform& toDem);

/// The position "X,Y,H", "X,Y,Hagl", "X,Y,Hmsl" or "X,Y,Hell"; without a word H is above ground. Errors:
/// usage.
Result<PositionArgument> readPositionArgument(const std::string& option, const std::string& text,
                                              const CrsTransform& toDem);

/// The height of a position in the terms of the DEM's own heights. Above ground needs terrain below it; msl
/// is the DEM's own unless the DEM says that its heights are ellipsoidal, ell if it says so. Errors:
/// invalidData (no terrain below a height above ground), usage (msl and ell where the DEM has the other one).
Result<double> demHeight(const PositionArgument& position, const SurfaceHeights& heights);

}  // namespace arete
