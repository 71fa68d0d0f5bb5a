// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/files/text/stated_size.h"
#include "io/query/surface/fit_front.h"
#include "surface/attributes/attribute_changes.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// How a mesh is made smaller, once, in the words of docs/topics/decimation.md.
struct DecimationRequest {
  /// "measured": the cut of a multitriangulation that is built in memory, fitted; the others are in
  /// surface/decimate/decimate.h: "qem", "lindstrom-turk", "half-edge", "vertex-pair", "face", "cluster".
  std::string method = "measured";
  std::string queue = "lazy";               ///< or "greedy", "estimate"
  std::string quadricWeight = "area";       ///< or "none"
  std::string clusterVertices = "quadric";  ///< or "original"
  std::optional<std::uint32_t> maxTriangles = {};
  std::optional<StatedSize> maxError = {};  ///< a distance, or a share of the diagonal; of "measured" alone
  /// "uv:1,color:0.5": what attributes count beside distances (AttributeWeight), by their names for options;
  /// empty: the usual ones, but for "measured" without maxTriangles, where nothing is weighed. Of all but
  /// "lindstrom-turk".
  std::string attributeWeights = {};
  bool keepsBorders = false, forbidsCrossings = false;
  bool wantsFaces = false;  ///< DecimatedOutcome::triangleFor also of "measured"
};

/// What texture coordinates and colours count where no weight is stated (AttributeWeight). Others do not
/// count. "measured" has another one for texture coordinates, whose cost is an integral over the source.
inline constexpr double kUsualTexcoordWeight = 0.2, kMeasuredTexcoordWeight = 0.4, kUsualColorWeight = 0.15;
/// In diagonals. Where a unit of texture coordinates covers less on the surface, because a picture repeats,
/// their weight is as much smaller: they would count so much that the shape is lost.
inline constexpr double kUsualLength = 0.8;

/// What became of a mesh, whatever the method.
struct DecimatedOutcome {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> vertexOf;  ///< by vertex: of the input
  /// By face of the input: the triangle that stands for it, or MeshAttributes::kNone. Of "measured" only
  /// where it is wanted.
  std::vector<std::uint32_t> triangleFor;
  std::optional<std::uint64_t> crossings = {},
                               sourceCrossings = {};   ///< pairs of triangles; the source's if there are any
  std::vector<AttributeChange> attributeChanges = {};  ///< at faces of the input
  std::vector<std::string> lost = {};
  std::uint64_t evaluations = 0, steps = 0;
  std::optional<FitOutcome> fit = {};
  std::optional<double> maxError = {};  ///< the tolerance that was stated
  bool isComplete = true;               ///< false: the budget ended it before the tolerance was reached
  bool dropsFlatNormals = false;
  std::string seams = {};  ///< seamsText() where they keep most of the mesh from being smaller
};

/// Whether the request contradicts itself. Errors: usage; the culprit is the field, and the sentence names
/// others in backquotes. "operator" is the method, "keepBorders" and "noCrossings" the flags.
Status checkDecimation(const DecimationRequest& request);

/// Makes a mesh smaller. Errors: as checkDecimation(), buildSurface() and takeSurface() or
/// decimate(); usage, culprit "maxTriangles" and the number: the method does not reach so few. O(n log n).
Result<DecimatedOutcome> decimateMesh(SurfaceMesh mesh, const DecimationRequest& request,
                                      const RunContext& context = {});

}  // namespace arete
