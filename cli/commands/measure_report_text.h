// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/triangle_mesh.h"
#include "engine/base/vec.h"
#include "terrain/measure/measure.h"
#include "terrain/model/heightfield.h"

namespace arete {

/// Formats a measurement, a line per figure. `unit` may be empty.
std::string measureReportText(const MeasureReport& report, const std::string& unit, bool isRaster);

/// What `arete measure` says of a TIN that covers no sample: where both lie, instead of figures of nothing.

/// The box of a mesh over x and another of its axes: 1 = y, 2 = z. Empty for a mesh without vertices. O(n).
Box2 planBoxOf(const TriangleMesh& mesh, int axis);
/// The box of the samples, in source coordinates. O(1) for rasters, O(n) for points.
Box2 planBoxOf(const RasterHeightfield& field);
Box2 planBoxOf(const PointHeightfield& field);

/// "x 0 to 100, y 5 to 20".
std::string rangesText(const Box2& box);

/// What stands in the place of the report.
std::string apartText(const MeasureReport& report, const Box2& tin, const Box2& dem);

/// ": is its y up?", ": local coordinates?" or another guess; empty where the boxes meet, as over NODATA.
/// @param tinOverZ the box of the TIN over x and z.
std::string reasonOfApart(const Box2& tin, const Box2& tinOverZ, const Box2& dem);

}  // namespace arete
