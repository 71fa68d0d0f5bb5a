// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "engine/base/result.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A place on a contour line where its height may be written.
struct ContourLabel {
  Vec2 xy;            ///< source coordinates
  double height = 0;  ///< of the line, in the unit of heights
};

/// Places on the lines that are drawn heavier, every fifth, spread over the terrain: the first ones are far
/// apart, and those that follow lie between them, so that a picture takes as many as it has room for. At most
/// one of a level in a square of 32 nodes.
///
/// @param interval  of all lines, > 0
/// O(samples), of points O(nodes of a lattice of 2^20). Errors: as latticeOfTriangles().
Result<std::vector<ContourLabel>> contourLabels(const TerrainModel& model, double interval);

}  // namespace arete
