// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"
#include "io/query/attributes/attribute_parts.h"

namespace arete {

/// The shape of a mesh, and its texture coordinates: two numbers at each corner of each triangle.
struct ChartedShape {
  const TriangleMesh& shape;
  std::span<const double> coords;
};

/// The charts of a mesh, by triangle: what hangs together across edges at whose ends both triangles have the
/// same place and the same coordinates, and the same part. Places are compared, not the numbers of vertices:
/// a glTF has a vertex for each side of a seam. O(n log n).
struct PlacedCharts {
  std::vector<std::uint32_t> ofTriangle;
  std::vector<double> areas, borders;  ///< by chart: lengths of edges at which it ends
};
PlacedCharts chartsByPlace(const ChartedShape& mesh, std::span<const std::uint32_t> partOf);

/// Which charts of two meshes belong together.
struct ChartMatch {
  /// By triangle: charts that belong together have one number; ComparedNumbers::kNoPart of a chart that is
  /// not told from its neighbours.
  std::vector<std::uint32_t> ofSource, ofOther;
  std::size_t charts = 0;  ///< of the source
  std::size_t apart = 0;   ///< of them, those that share a number with no other
};

/// Finds that by where the charts lie: points of each mesh, spread evenly over its area, name the chart of
/// the nearest point of the other mesh. Two charts of one part belong together where the one holds a quarter
/// of the other's points. A chart is not told from its neighbours if such charts hold less than three
/// quarters of its points, or if it is not four times as wide as what points of the meshes may be apart by:
/// its width is twice its area for its border.
///
/// @param named   partsByName() of the two meshes
/// @param within  E
/// Errors: interrupted. Precondition: both meshes have a triangle. O(n log n), parallel.
Result<ChartMatch> matchCharts(const ChartedShape& source, const ChartedShape& other,
                               const AttributeParts& named, double within, const RunContext& context = {});

}  // namespace arete
