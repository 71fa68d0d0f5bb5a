// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <functional>

#include "engine/cut/cut.h"
#include "engine/grid_points_of.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// Calls visit(position of a sample, the front's height there) for every sample of the domain, once per
/// triangle that contains it. By plain search.
inline void forSamples(const TerrainModel& model, const Cut& cut,
                       const std::function<void(Vec3, double)>& visit) {
  const RasterHeightfield field = model.rasterSamples();
  for (const auto& triangle : cut.triangles) {
    std::array<Vec3, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = model.mt.position(VertexId(cut.vertices[triangle[i]]));
    test::forGridPointsOf(p, [&](int x, int y, double onFront) {
      const double z = field.heights[field.index(std::uint32_t(x), std::uint32_t(y))];
      if (!std::isnan(z)) visit({double(x), double(y), z}, onFront);
    });
  }
}

}  // namespace arete
