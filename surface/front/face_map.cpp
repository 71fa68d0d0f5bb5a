// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/front/face_map.h"

#include <algorithm>
#include <limits>

#include "engine/base/nearest_on_triangle.h"
#include "engine/memory/required_memory.h"

namespace arete {
namespace {

SpaceTriangle placeOf(const MultiTriangulation& mt, TriangleId t) {
  const auto [a, b, c] = mt.corners(t);
  return {mt.position(VertexId(a)), mt.position(VertexId(b)), mt.position(VertexId(c))};
}

}  // namespace

std::vector<std::uint32_t> facesOf(const SurfaceModel& model, const Cut& cut) {
  const MultiTriangulation& mt = model.mt;
  std::vector<std::uint32_t> numberOf(mt.triangleIdCount(), MeshAttributes::kNone);
  for (std::uint32_t i = 0; i < cut.ids.size(); ++i) numberOf[cut.ids[i]] = i;
  requireMemory(model.sourceFaces * sizeof(std::uint32_t));
  std::vector<std::uint32_t> found(model.sourceFaces, MeshAttributes::kNone);
  for (std::uint32_t finest = 0; finest < mt.triangleIdCount(); ++finest) {
    if (mt.remover(TriangleId(finest)).isValid()) continue;
    const SpaceTriangle face = placeOf(mt, TriangleId(finest));
    const Vec3 middle = (face[0] + face[1] + face[2]) / 3.0;
    std::uint32_t t = finest;
    while (numberOf[t] == MeshAttributes::kNone) {
      std::uint32_t nearest = MeshAttributes::kNone;
      double least = std::numeric_limits<double>::infinity();
      for (const std::uint32_t candidate : mt.floor(mt.creator(TriangleId(t)))) {
        const double distance = distanceToTriangle(middle, placeOf(mt, TriangleId(candidate)));
        if (distance < least || nearest == MeshAttributes::kNone) nearest = candidate;
        least = std::min(least, distance);
      }
      t = nearest;
    }
    found[model.faceOf[finest]] = numberOf[t];
  }
  for (const auto& [face, in] : model.leftOutFaces) found[face] = found[in];
  return found;
}

}  // namespace arete
