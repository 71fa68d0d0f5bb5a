// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"
#include "terrain/features/features.h"
#include "terrain/model/heightfield.h"
#include "terrain/triangulation/finest_points.h"

namespace arete {

/// What shall stay in the root beside the domain's corners (V_fixed).
struct FixedVertexOptions {
  /// The most persistent peaks, pits and passes; nothing = none.
  std::optional<FeatureOptions> features = FeatureOptions{};
  /// Positions in source coordinates; each stands for the sample nearest to it.
  std::vector<Vec2> given;
  /// Vertices of the classes corner and interior edge, a crease being an edge whose triangles' normals differ
  /// by more than this, 0..180 degrees; nothing = none.
  std::optional<double> creaseAngleDegrees;
};

struct FixedVertices {
  std::vector<std::uint32_t> vertices;  ///< sample or point indices, rising, each once
  std::size_t features = 0;             ///< how many each of the three wishes asked for
  std::size_t given = 0;
  std::size_t creases = 0;
  std::size_t givenOutside = 0;  ///< given positions with no sample of the domain near: left out
};

/// Chooses V_fixed on the finest triangulation. Given positions snap to the nearest corner of their cell that
/// is in the domain (raster), or to the nearest point, when they lie within the points' bounding box. Without
/// any wish the result is empty and costs nothing, and so it is where there is no triangle, which build()
/// explains. Errors: interrupted; those of the points' triangulation. O(n log n).
Result<FixedVertices> chooseFixedVertices(const RasterHeightfield& heightfield,
                                          const FixedVertexOptions& options, const RunContext& context = {});
Result<FixedVertices> chooseFixedVertices(const PointHeightfield& heightfield,
                                          const FixedVertexOptions& options, const RunContext& context = {});
/// `finest`: finestPoints() of the same points.
Result<FixedVertices> chooseFixedVertices(const PointHeightfield& heightfield, const FinestPoints& finest,
                                          const FixedVertexOptions& options, const RunContext& context = {});

}  // namespace arete
