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

/// Which vertices stay in the root beside the corners of the domain (V_fixed).
struct FixedVertexOptions {
  /// The most persistent peaks, pits and passes; nullopt = none.
  std::optional<FeatureOptions> features = FeatureOptions{};
  /// Positions in source coordinates; each selects the nearest sample.
  std::vector<Vec2> given;
  /// Selects the vertices of the classes corner and interior edge (engine/simplify/vertex_classes.h), where a
  /// crease is an edge whose triangles' normals differ by more than this, 0..180 degrees; nullopt = none.
  std::optional<double> creaseAngleDegrees;
};

struct FixedVertices {
  std::vector<std::uint32_t> vertices;  ///< sample or point indices, rising, each once
  std::size_t features = 0;             ///< how many of them are features,
  std::size_t given = 0;                ///< how many given positions selected one,
  std::size_t creases = 0;              ///< and how many are on creases; a vertex may be counted in several
  std::size_t givenOutside = 0;         ///< given positions without a sample of the domain nearby: ignored
};

/// Chooses V_fixed on the finest triangulation. A given position selects the nearest corner of its cell that
/// is in the domain (raster), or the nearest point, provided it lies within the points' bounding box. Empty
/// at no cost where the options select nothing, and where there is no triangle (build() reports that). O(n
/// log n). Errors: interrupted; those of finestPoints().
Result<FixedVertices> chooseFixedVertices(const RasterHeightfield& heightfield,
                                          const FixedVertexOptions& options, const RunContext& context = {});
Result<FixedVertices> chooseFixedVertices(const PointHeightfield& heightfield,
                                          const FixedVertexOptions& options, const RunContext& context = {});
/// @param finest  finestPoints() of the same points
Result<FixedVertices> chooseFixedVertices(const PointHeightfield& heightfield, const FinestPoints& finest,
                                          const FixedVertexOptions& options, const RunContext& context = {});

}  // namespace arete
