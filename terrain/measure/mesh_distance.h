// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// How far two meshes are from each other in space, whatever they are: closed or open, overhanging,
/// intersecting themselves, their triangles facing any way.
///
/// The distance from a point to a mesh is the one to the nearest point of its triangles. From one mesh to
/// another it has a maximum, a mean and a root mean square over the surface, and it is not the same both
/// ways. As MeshLab's "Hausdorff Distance" filter and Metro (Cignoni, Rocchini, Scopigno 1998) do, the
/// surface is sampled; the maximum found is a lower bound of the true one. All lengths are in the unit of the
/// positions.

/// What a mesh is, for reports.
struct MeshSummary {
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  std::uint64_t unusedVertices = 0;       ///< in no triangle: in no statistic
  std::uint64_t degenerateTriangles = 0;  ///< without area: to be near to, never sampled
  double area = 0;
  double diagonal = 0;  ///< of the box around the triangles
};

/// The distance from one mesh to the other. Mean and RMS are over the samples, which are spread evenly over
/// the area; the maximum is over samples, vertices and the points of the search.
struct DistanceOneWay {
  std::uint64_t samples = 0;
  std::uint64_t vertices = 0;
  double maximum = 0;  ///< the largest found: at `worst`
  double atMost = 0;   ///< no point is farther, but for the rounding of doubles
  double mean = 0;
  double rms = 0;
  double maximumAtVertices = 0;
  Vec3 worst;         ///< where the maximum is, on the one mesh
  Vec3 worstNearest;  ///< the point of the other that is nearest to it
};

struct MeshDistanceReport {
  MeshSummary first, second;
  DistanceOneWay forward;   ///< from the first to the second
  DistanceOneWay backward;  ///< from the second to the first
  std::uint64_t seed = 0;

  /// Both ways as one: the larger maximum; mean and RMS over both surfaces, an area counting alike in either.
  double hausdorff() const;
  double hausdorffAtMost() const;
  double mean() const;
  double rms() const;
  /// Largest |coordinate|: what rounding is relative to.
  double largestCoordinate = 0;
};

struct MeshDistanceOptions {
  /// On each mesh; 0 = ten for each triangle of the larger one, and at least a million.
  std::uint64_t samples = 0;
  /// Where the samples fall.
  std::uint64_t seed = 1;
  /// The search for the farthest point ends when it cannot be farther by more than this fraction, or than a
  /// hundred-thousandth of the diagonal, or when it has asked for four points for each sample of a triangle.
  /// Infinity: no search, and no bound.
  double accuracy = 0.001;
};

/// Measures both ways. `vertexDistances`, when given, is filled with the distance from each vertex of `first`
/// to `second`, unused vertices too.
/// Errors: invalidData for a mesh that does not validate(), degenerate for one without a triangle that has
/// area, with "first" or "second" as the culprit; invalidData where no double holds the fourth power of the
/// diagonal of both; interrupted. The result
/// is the same, to the bit, for any number of threads. O((n + samples) log n); about 250 bytes per triangle.
Result<MeshDistanceReport> measureDistance(const TriangleMesh& first, const TriangleMesh& second,
                                           const MeshDistanceOptions& options = {},
                                           const RunContext& context = {},
                                           std::vector<double>* vertexDistances = nullptr);

/// Ok when hausdorff() is within E + 16 ulp of the largest coordinate; else a brokenPromise error that says
/// where it is not.
Status checkDistance(const MeshDistanceReport& report, double expectedDistance);

/// Whether hausdorffAtMost() is within that too: then no point of either mesh is farther than E.
bool isProven(const MeshDistanceReport& report, double expectedDistance);

}  // namespace arete
