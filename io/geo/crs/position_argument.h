// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/geo/crs/transform.h"
#include "terrain/locate/ground_height.h"

namespace arete {

struct DataUnit;

/// The reference of a height.
enum class HeightKind {
  aboveGround,  ///< agl: above the terrain at full resolution
  seaLevel,     ///< msl: above the geoid, as the heights of most DEMs
  ellipsoidal,  ///< ell: above the ellipsoid
};
std::string_view toString(HeightKind kind);

/// A position in space as typed by a person.
struct PositionArgument {
  Vec2 xy;            ///< in the DEM's CRS
  double height = 0;  ///< in the DEM's vertical unit
  HeightKind kind = HeightKind::aboveGround;
};

/// Reads a finite number with optional spaces around it. Errors: usage: quotes the text.
Result<double> readNumberText(std::string_view text);

/// A height and its reference: "30", "30agl", "120.5msl", "98ell".
struct StatedHeight {
  double height = 0;  ///< in the DEM's vertical unit
  HeightKind kind = HeightKind::aboveGround;
};
/// Without a word the height is above ground.
///
/// @param unit of the DEM's heights (io/files/text/length_unit.h), for a height with a unit of its own,
/// "30ft" or "1.5kmmsl"; null: there is none, as in the columns of a table.
///
/// Errors: usage: quotes the text.
Result<StatedHeight> readHeightText(std::string_view text, const DataUnit* unit = nullptr);

/// Reads "X,Y".
///
/// @param option What the text is, for the culprit of errors: "<option> <text>".
/// @param toDem Into the DEM's CRS: CrsTransform::fromLonLat() for longitude and latitude, CrsTransform() for
/// the DEM's own coordinates.
///
/// Errors: usage.
Result<Vec2> readPlaceArgument(const std::string& option, const std::string& text, const CrsTransform& toDem);

/// Reads "X,Y,H", "X,Y,Hagl", "X,Y,Hmsl" or "X,Y,Hell"; without a word H is above ground. Parameters and
/// errors as readPlaceArgument() and readHeightText().
Result<PositionArgument> readPositionArgument(const std::string& option, const std::string& text,
                                              const CrsTransform& toDem, const DataUnit* unit = nullptr);

/// Converts the height of a position to the vertical reference of the DEM. The DEM's heights are msl unless
/// its vertical datum is "ellipsoid".
///
/// Errors: invalidData: no terrain below a height above ground. usage: msl for ellipsoidal DEM heights or ell
/// for others, since no geoid is known.
Result<double> demHeight(const PositionArgument& position, const GroundHeights& heights);

}  // namespace arete
