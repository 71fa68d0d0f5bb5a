// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/fronts/shading_normals.h"

#include <utility>

#include "engine/cut/cut.h"
#include "surface/normals/smooth_corners.h"

namespace arete {

std::vector<Vec3> shadingNormals(const SurfaceModel& model) {
  const MultiTriangulation& mt = model.mt;
  const Cut finest = frontOfPrefix(mt, mt.nodeCount());
  TriangleMesh mesh;
  for (const std::uint32_t v : finest.vertices)
    mesh.positions.push_back(mt.metric().toMetric(mt.position(VertexId(v))));
  mesh.triangles.assign(finest.triangles.begin(), finest.triangles.end());
  const CornerNormals smooth = smoothCorners(mesh, kCreaseDegrees);
  constexpr std::uint32_t kUnseen = 0xFFFFFFFF, kSharp = 0xFFFFFFFE;
  std::vector<std::uint32_t> normalOf(mesh.positions.size(), kUnseen);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& normal = normalOf[mesh.triangles[t][k]];
      const std::uint32_t own = smooth.normalOf[t][k];
      normal = normal == kUnseen || normal == own ? own : kSharp;
    }
  std::vector<Vec3> normals(mt.vertexCount());
  for (std::size_t v = 0; v < normalOf.size(); ++v)
    if (normalOf[v] < kSharp) normals[finest.vertices[v]] = smooth.normals[normalOf[v]];
  return normals;
}

}  // namespace arete
