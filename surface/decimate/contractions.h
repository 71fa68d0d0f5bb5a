// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/decimate/decimate.h"

namespace arete {

/// A mesh in a frame near its own place, where squares of coordinates keep their digits.
struct FramedMesh {
  const SurfaceMesh& source;
  TriangleMesh shape;   ///< of the source, around the origin of the frame
  double rounding = 0;  ///< of the largest coordinate out of the frame
};

/// What a method makes of a framed mesh: the result in the frame, without DecimatedMesh::triangleFor.
struct FramedResult {
  DecimatedMesh decimated;
  /// By vertex of the source: the vertex of the source into which it was contracted, perhaps by way of
  /// others; itself where it was not.
  std::vector<std::uint32_t> joinedTo;
};

/// decimate() by the operators that contract edges, pairs of vertices or triangles. Precondition: the mesh is
/// valid.
Result<FramedResult> decimateByContractions(const FramedMesh& mesh, const DecimateOptions& options,
                                            const RunContext& context);

/// Contracts edges opposite to vertices of more than `most` triangles, by quadrics, until they have no more
/// or no such edge is left.
Result<FramedResult> narrowWideVertices(const FramedMesh& mesh, std::size_t most,
                                        const DecimateOptions& options, const RunContext& context);

/// decimate() by clusters.
Result<FramedResult> decimateByClusters(const FramedMesh& mesh, const DecimateOptions& options,
                                        const RunContext& context);

/// decimate() by CGAL's Lindstrom-Turk.
Result<FramedResult> decimateByLindstromTurk(const FramedMesh& mesh, const DecimateOptions& options,
                                             const RunContext& context);

}  // namespace arete
