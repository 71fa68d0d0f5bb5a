// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/fronts/shading_normals.h"

#include <cmath>
#include <numbers>

#include "engine/cut/cut.h"

namespace arete {

std::vector<Vec3> shadingNormals(const SurfaceModel& model) {
  const double leastCosine = std::numbers::sqrt2 / 2;
  const MultiTriangulation& mt = model.mt;
  const Cut finest = frontOfPrefix(mt, mt.nodeCount());
  const auto areaNormal = [&](const std::array<std::uint32_t, 3>& corners) {
    const MetricFrame& metric = mt.metric();
    const auto at = [&](std::size_t i) {
      return metric.toMetric(mt.position(VertexId(finest.vertices[corners[i]])));
    };
    const Vec3 a = at(0);
    return cross(at(1) - a, at(2) - a);
  };
  std::vector<Vec3> normals(mt.vertexCount());
  for (const auto& corners : finest.triangles) {
    const Vec3 n = areaNormal(corners);
    for (const std::uint32_t c : corners) normals[finest.vertices[c]] = normals[finest.vertices[c]] + n;
  }
  for (Vec3& n : normals) {
    const double length = norm(n);
    n = length > 0 ? n / length : Vec3{};
  }
  std::vector<std::uint8_t> isSharp(mt.vertexCount(), 0);
  for (const auto& corners : finest.triangles) {
    const Vec3 n = areaNormal(corners);
    for (const std::uint32_t c : corners) {
      const std::uint32_t v = finest.vertices[c];
      if (dot(n, normals[v]) < leastCosine * norm(n)) isSharp[v] = 1;
    }
  }
  for (std::size_t v = 0; v < normals.size(); ++v)
    if (isSharp[v]) normals[v] = {};
  return normals;
}

}  // namespace arete
