// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// The distance between two arbitrary meshes in space: closed or open, overhanging, self-intersecting, with
/// triangles of any orientation.
///
/// The distance from a point to a mesh is that to the nearest point of its triangles. From one mesh to
/// another it has a maximum, a mean and a root mean square over the surface; these are not symmetric. The
/// surface is sampled, as in Metro [CignoniRocchiniScopigno1998] and MeshLab's "Hausdorff Distance" filter,
/// so the maximum found is a lower bound of the true one; a branch-and-bound search adds an upper bound. All
/// lengths are in the unit of the positions.

/// Figures of one mesh, for reports.
struct MeshSummary {
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  std::uint64_t unusedVertices = 0;       ///< in no triangle: left out of all figures
  std::uint64_t degenerateTriangles = 0;  ///< without area: part of the target, never sampled
  double area = 0;
  double diagonal = 0;  ///< of the box around the triangles
};

/// The distance from one mesh to the other. Mean and RMS are over the samples, which are spread evenly over
/// the area; the maximum is over samples, vertices and the points of the search.
struct DistanceOneWay {
  std::uint64_t samples = 0;
  std::uint64_t vertices = 0;
  double maximum = 0;  ///< the largest found: at `worst`
  double atMost = 0;   ///< upper bound: no point is farther, but for the rounding of doubles
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

  /// Both directions together: the larger maximum; mean and RMS over both surfaces, weighted by area.
  double hausdorff() const;
  double hausdorffAtMost() const;
  double mean() const;
  double rms() const;
  /// Largest |coordinate|; rounding is relative to it.
  double largestCoordinate = 0;

  /// Adds a length to every distance: how far the vertices of a mesh may be from those that it stands for.
  void raise(double by);
};

struct MeshDistanceOptions {
  /// Number of samples on each mesh; 0 = ten for each triangle of the larger one, and at least a million.
  std::uint64_t samples = 0;
  /// Determines the positions of the samples.
  std::uint64_t seed = 1;
  /// The search for the farthest point of a triangle ends when the upper bound exceeds the maximum found by
  /// no more than this fraction, or is below a hundred-thousandth of the diagonal, or after four queries for
  /// each sample of the triangle. Infinity: no search, and no upper bound.
  double accuracy = 0.001;
};

/// Measures the distance in both directions. The result is the same, to the bit, for any number of threads.
/// O((n + samples) log n); about 250 bytes per triangle.
/// @param vertexDistances  where not null, filled with the distance from each vertex of `first`, unused ones
///        included, to `second`
/// Errors, with the culprit "first" or "second": invalidData: the mesh does not validate(); degenerate: it
/// has no triangle with area. Without a culprit: invalidData: the fourth power of the common diagonal
/// overflows; interrupted.
Result<MeshDistanceReport> measureDistance(const TriangleMesh& first, const TriangleMesh& second,
                                           const MeshDistanceOptions& options = {},
                                           const RunContext& context = {},
                                           std::vector<double>* vertexDistances = nullptr);

/// No point of `first` is farther than this from `second`, but for the rounding of doubles: the `atMost` of
/// measureDistance() one way, without samples. Within a thousandth of the largest distance, or below a
/// hundred-thousandth of the diagonal, unless the search ends early on a large triangle. The result is the
/// same, to the bit, for any number of threads. O(n log n). Errors: as measureDistance().
/// @param samples  that let the search end early: MeshDistanceOptions::samples
Result<double> farthestDistance(const TriangleMesh& first, const TriangleMesh& second,
                                const RunContext& context = {}, std::uint64_t samples = 0);

/// Which distances a promise is about.
enum class PromisedWay {
  both,
  fromSecond,  ///< of the points of the second mesh alone: what a cut promises of its source
};

/// Checks that the largest distance, hausdorff() or that of one way, is at most E + 16 ulp of the largest
/// coordinate. Errors: brokenPromise: it is not, with the farthest point.
Status checkDistance(const MeshDistanceReport& report, double expectedDistance,
                     PromisedWay way = PromisedWay::both);

/// Whether its upper bound is within the same: then no point (of the second mesh, or of either) is farther
/// than E.
bool isProven(const MeshDistanceReport& report, double expectedDistance, PromisedWay way = PromisedWay::both);

}  // namespace arete
