// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"
#include "io/geo/bent/place_map.h"

namespace arete {

/// How far bending may go.
struct BendOptions {
  /// A triangle may gain this part of its tolerance: of the tolerance below, or of its own error where that
  /// is larger (outside a region).
  double share = 0.1;
  double tolerance = 0;  ///< in the unit of heights of the target
  /// No triangle is split for less, in that unit.
  double least = 1e-3;
  /// Samples of the source, which say how large a pixel is: the rim stays within kRimPixels of where the
  /// samples on it are. 0: the shortest edge counts as a pixel.
  std::uint64_t samples = 0;
};

/// The part of a pixel by which a straight edge of the rim may leave its image.
inline constexpr double kRimPixels = 0.04;

/// A mesh whose vertices were led into a target, with the vertices that split edges have there.
struct BentMesh {
  TriangleMesh source;  ///< in source coordinates; the split points lie on its edges
  TriangleMesh mesh;    ///< the same in the target
  /// By triangle: its error before and what bending adds at most.
  std::vector<double> errors;
  double added = 0;  ///< the most that bending adds to a triangle
  std::uint64_t addedVertices = 0, addedTriangles = 0;
};

/// Leads a heightfield's mesh into a target. A triangle is straight in the source, and its vertices span a
/// straight one in the target, which is another surface: a sample of the source has another height on it.
/// Where that adds more than a triangle may gain, its edges are split at their middles in the source, the
/// same for both triangles of an edge, until it does not; and where triangles would fold over one another,
/// and where the rim would leave its samples. The result depends on nothing but the mesh and the map.
///
/// What bending adds is bounded from the images of the middle of each edge, and of its quarters where it is
/// long, as if the map were quadratic along an edge, with allowances for the rest. This is not a proof; a
/// measurement of every sample is (io/query/placed/measure_placed.h).
///
/// @param errors  by triangle, in the unit of heights of the target; empty: 0
/// Errors, with the culprit of the map: invalidData: a position that the target does not have; a mesh that
/// is torn apart by a seam of the target; heights that differ at a pole. interrupted. usage: more than
/// about 20 million triangles are needed. O(n log n) of the result for each round of splits.
Result<BentMesh> bendMesh(TriangleMesh mesh, std::span<const float> errors, const PlaceMap& map,
                          const BendOptions& options, const RunContext& context = {});

}  // namespace arete
