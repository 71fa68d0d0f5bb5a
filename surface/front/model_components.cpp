// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/front/model_components.h"

#include <algorithm>
#include <limits>

#include "surface/topology/disjoint_sets.h"

namespace arete {
namespace {

Cut finestFront(const SurfaceModel& model) {
  return frontOfPrefix(model.mt, model.mt.nodeCount());
}

}  // namespace

ModelComponents componentsOf(const SurfaceModel& model) {
  const MultiTriangulation& mt = model.mt;
  DisjointSets sets(mt.vertexCount());
  // The finest triangulation has every vertex, so it decides what is connected.
  const Cut finest = finestFront(model);
  for (const auto& corners : finest.triangles) {
    sets.unite(finest.vertices[corners[0]], finest.vertices[corners[1]]);
    sets.unite(finest.vertices[corners[0]], finest.vertices[corners[2]]);
  }
  std::uint32_t count = 0;
  const auto numbered = sets.numbered(count);
  ModelComponents components;
  components.ofVertex.assign(numbered.begin(), numbered.end());
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<std::pair<Vec3, Vec3>> boxes(count, {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}});
  for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) {
    auto& [low, high] = boxes[components.ofVertex[v]];
    const Vec3 p = mt.position(VertexId(v));
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  for (const auto& [low, high] : boxes) components.diagonals.push_back(norm(high - low));
  return components;
}

DroppedComponents componentsBelow(const SurfaceModel& model, double leastDiagonal) {
  const ModelComponents components = componentsOf(model);
  const MultiTriangulation& mt = model.mt;
  DroppedComponents dropped;
  for (const double diagonal : components.diagonals) dropped.count += diagonal < leastDiagonal ? 1 : 0;
  for (const std::uint32_t component : components.ofVertex)
    dropped.isDropped.push_back(components.diagonals[component] < leastDiagonal);
  const Cut finest = finestFront(model);
  // All corners of a triangle are in one component, so one of them decides.
  for (const auto& corners : finest.triangles)
    dropped.sourceFaces += dropped.isDropped[finest.vertices[corners[0]]] ? 1 : 0;
  for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t)
    dropped.rootTriangles += dropped.isDropped[mt.corners(TriangleId(t))[0]] ? 1 : 0;
  return dropped;
}

KeptCut withoutDropped(const MultiTriangulation& mt, const Cut& whole, const DroppedComponents& dropped) {
  KeptCut rest;
  rest.cut.nodes = whole.nodes;
  rest.cut.isComplete = whole.isComplete;
  std::vector<std::uint32_t> vertexNumber(whole.vertices.size(), MeshAttributes::kNone);
  for (std::uint32_t v = 0; v < whole.vertices.size(); ++v) {
    if (dropped.isDropped[whole.vertices[v]]) continue;
    vertexNumber[v] = static_cast<std::uint32_t>(rest.cut.vertices.size());
    rest.cut.vertices.push_back(whole.vertices[v]);
  }
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    const auto& [a, b, c] = whole.triangles[t];
    // If one corner is dropped, so are the others.
    if (vertexNumber[a] == MeshAttributes::kNone) {
      rest.numberOf.push_back(MeshAttributes::kNone);
      continue;
    }
    rest.numberOf.push_back(static_cast<std::uint32_t>(rest.cut.triangles.size()));
    rest.cut.triangles.push_back({vertexNumber[a], vertexNumber[b], vertexNumber[c]});
    rest.cut.ids.push_back(whole.ids[t]);
    rest.cut.achievedError = std::max(rest.cut.achievedError, mt.error(TriangleId(whole.ids[t])));
  }
  return rest;
}

TriangleMesh droppedSurface(const SurfaceModel& model, const DroppedComponents& dropped) {
  const Cut finest = finestFront(model);
  TriangleMesh mesh;
  for (const std::uint32_t v : finest.vertices) mesh.positions.push_back(model.mt.position(VertexId(v)));
  for (const auto& corners : finest.triangles)
    if (dropped.isDropped[finest.vertices[corners[0]]]) mesh.triangles.push_back(corners);
  return mesh;
}

}  // namespace arete
