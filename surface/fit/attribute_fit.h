// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// By triangle: the charts of a source and of a cut (surface/model/charts.h). Empty: all are one.
struct FitCharts {
  std::span<const std::uint32_t> ofSource = {}, ofCut = {};
};

/// How far an attribute of a cut is from the source's, at the nearest points of the same chart: the root mean
/// square of the Euclidean distances, in the numbers of the file.
struct AttributeRms {
  std::string name;
  double before = 0, after = 0;

  /// Whether moves have made it larger, beyond rounding.
  bool hasGrown() const { return after > before * (1 + 1e-9) + rounding; }
  double rounding = 0;  ///< of the attribute's numbers
};

/// Gives a cut whose vertices have moved the attributes of the source there, by vertex and by wedge,
/// where they may be averaged. Each is the least squares solution for samples of the source, against their
/// nearest points of the same chart and the same side of a seam.
///
/// Numbers stay within the range that the source has in their chart, normals keep their length. Texture
/// coordinates on borders and on either side of a seam are the values of the source's line at the nearest
/// place, so that they stay in their chart and both sides show the same place; no triangle of a picture turns
/// over. What is affine in the position, as a picture that was projected, has its value at the new place
/// instead. Labels, the signs of tangents and what is not finite stay as they are, and so does what equals
/// the source's already.
///
/// @param cut     with moved vertices and with the attributes of where they were
/// @param before  by vertex of the cut: where it was, a place of a vertex of the source
/// @param samples of the source; 0: as SurfaceFitOptions::samples
/// Errors: invalidData: sizes that do not fit, a source without area; interrupted. The result does not depend
/// on the threads. O(samples log triangles + triangles); about 150 bytes a sample.
Result<std::vector<AttributeRms>> fitAttributes(SurfaceMesh& cut, const std::vector<Vec3>& before,
                                                const SurfaceMesh& source, const FitCharts& charts = {},
                                                std::uint64_t samples = 0, const RunContext& context = {});

}  // namespace arete
