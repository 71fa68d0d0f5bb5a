// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// How far two tuples of numbers are apart.
enum class NumbersNorm : std::uint8_t {
  largest,   ///< the largest difference of a component
  length,    ///< the Euclidean distance
  angle,     ///< degrees between the first three; a fourth of another sign is infinitely far
  equality,  ///< 0 if equal, else infinity; not interpolated
};

/// Numbers at the corners of the triangles of two meshes, which vary linearly over each triangle.
struct ComparedNumbers {
  NumbersNorm norm = NumbersNorm::length;
  std::size_t components = 1;
  /// By triangle, corner and component, of the source and of the mesh that stands for it.
  std::vector<double> ofSource = {}, ofMesh = {};
  /// By triangle. A point of the source is compared with triangles of its own part alone; with any where it
  /// has kNoPart, and not at all where it has kNotCompared. Empty: all are of one part.
  std::vector<std::uint32_t> partOfSource = {}, partOfMesh = {};
  /// Within parts: by triangle, a point of the source is compared with triangles of its own chart and of
  /// kNoPart; with any of its part where it has kNoPart. Empty: all are of one chart.
  std::vector<std::uint32_t> chartOfSource = {}, chartOfMesh = {};
  /// What is expected of the largest: values above are searched again, finer.
  double expected = std::numeric_limits<double>::infinity();

  static constexpr std::uint32_t kNoPart = 0xFFFFFFFF, kNotCompared = 0xFFFFFFFE;
};

/// How far numbers of a source are from those near it on another mesh.
struct NumbersFound {
  /// Points of the source that were compared: corners, middles of sides, and points spread over the surface.
  std::uint64_t points = 0;
  std::uint64_t unequal = 0;      ///< of them, those that are infinitely far
  std::uint64_t beyond = 0;       ///< of them, those that NearNumbersOptions::reachesOwn is for
  double largest = 0;             ///< may be infinite
  double mean = 0, rms = 0;       ///< over the points spread evenly over the area, infinite ones aside
  Vec3 worst;                     ///< the first point of the source with the largest
  std::optional<Vec3> worstNear;  ///< the point of the mesh that has it; nothing: none is near enough
  /// At the nearest point of the mesh, whatever is near beside it: largest, and over the spread points.
  double meanAtNearest = 0, rmsAtNearest = 0;
};

struct NearNumbersOptions {
  double within = 0;  ///< E
  /// Whether a point with nothing of its part and chart within E is compared with the nearest point that has
  /// these, as far as it is; else it is infinitely far.
  bool reachesOwn = false;
  /// Spread over the source: 0: two for each of its triangles, and at least 100 000.
  std::uint64_t samples = 0;
  std::uint64_t seed = 1;
};

/// For points x of the source, the least distance of its numbers from the ones at a point y of the mesh with
/// |x - y| <= E: every triangle of the mesh within E is searched. A corner and a side that several triangles
/// of the source share are points of each of them whose numbers differ there: of each side of a seam.
///
/// Over a triangle the numbers are linear and the points within E of x are a convex set, so the points at
/// which the numbers are no farther than some bound are convex too (angles: below 90 degrees): the least is
/// found along sides, and by nested golden sections [Kiefer1953] inside. What is found is the value of a
/// point within E, so it is never below the least; it is above by at most about a ten-thousandth of the
/// change of the numbers over the part of the triangle within E, and a hundred-millionth where it is above
/// what is expected.
///
/// The same, to the bit, for any number of threads. O(points * (log n + triangles within E)).
/// Errors, with the culprit "first" (the mesh) or "second" (the source): invalidData: one does not
/// validate(), or the coordinates are too far apart; degenerate: it has no triangle with area; interrupted.
/// Precondition: the sizes of the numbers match the meshes.
Result<std::vector<NumbersFound>> measureNearNumbers(const TriangleMesh& mesh, const TriangleMesh& source,
                                                     const std::vector<ComparedNumbers>& compared,
                                                     const NearNumbersOptions& options,
                                                     const RunContext& context = {});

}  // namespace arete
