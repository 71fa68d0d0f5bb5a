// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/base/triangle_mesh.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/caught_failure.h"

namespace arete {

Status TriangleMesh::validate() const try {
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3& p = positions[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return failure(ErrorCode::invalidData, fmt::format("vertex {} has a coordinate that is not finite", v));
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t])
      if (v >= positions.size())
        return failure(ErrorCode::invalidData,
                       fmt::format("triangle {} names vertex {} of {}", t, v, positions.size()));
  return {};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
