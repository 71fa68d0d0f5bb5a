// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/geo/features/feature_layer.h"
#include "terrain/sight/profile.h"

namespace arete {

/// A layer of features as it lies on a terrain. A vertex takes 24 bytes.
struct GroundFeatures {
  struct Place {
    Vec2 xy;            ///< source coordinates
    double height = 0;  ///< in the DEM's vertical unit
  };
  struct Label {
    std::string text;  ///< UTF-8, one line
    Place at;
  };

  std::string name;
  /// Of lines, straight between neighbours: wherever one crosses an edge of the finest triangulation there is
  /// a vertex.
  std::vector<Place> vertices;
  /// Where the lines begin in `vertices`, and their number at the end: line i is vertices [begin[i],
  /// begin[i + 1]).
  std::vector<std::uint64_t> begin = {0};
  std::vector<Place> points;
  std::vector<Label> labels;
  Warnings warnings;  ///< of the reading, and about what is not on the terrain

  std::uint64_t lines() const { return begin.size() - 1; }
};

struct GroundFeatureOptions {
  /// Places that state a height (z) stand there, in the DEM's vertical unit, and not on the ground.
  bool floats = false;
  /// A layer whose lines need more vertices is refused.
  std::uint64_t mostVertices = 8'000'000;
};

/// Lays features on the finest triangulation: places get its height, lines follow it exactly and end where it
/// ends, at voids and borders. What is not on the terrain is left out, and a warning counts it.
///
/// Errors: invalidData: no place is on the terrain (the message says where both lie). unsupported: more
/// vertices than allowed. interrupted, outOfMemory. Parallel; the result does not depend on the number of
/// threads. O(vertices of the result) over the cells of a raster, by a descent else.
Result<GroundFeatures> layOnGround(const FeatureLayer& layer, const Profiles& profiles,
                                   const GroundFeatureOptions& options = {}, const RunContext& context = {});

}  // namespace arete
