// SPDX-License-Identifier: GPL-3.0-or-later
//
// Uploads the arrays of the multitriangulation into shader storage buffers, if they fit the limits of the
// device.
#include "viewer/gl/terrain_on_gpu.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "engine/morph/geomorph.h"
#include "engine/mt/node_blocks.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

std::vector<float> metricPositions(const MultiTriangulation& mt) {
  std::vector<float> positions(std::size_t(3) * mt.vertexCount());
  const MetricFrame metric = mt.metric();
  parallelFor(std::uint32_t(0), mt.vertexCount(), [&](std::uint32_t v) {
    const Vec3 p = metric.toMetric(mt.position(VertexId(v)));
    positions[3 * std::size_t(v)] = float(p.x);
    positions[3 * std::size_t(v) + 1] = float(p.y);
    positions[3 * std::size_t(v) + 2] = float(p.z);
  });
  return positions;
}

/// Error, its sign set where the vertex is on a border; first slot. One more entry ends the last star.
std::vector<std::uint32_t> nodeWords(const MultiTriangulation& mt) {
  const MtArrays& a = mt.arrays();
  const std::uint32_t n = mt.nodeCount();
  std::vector<std::uint32_t> words(2 * (std::size_t(n) + 1), 0);
  parallelFor(std::uint32_t(0), n, [&](std::uint32_t i) {
    const std::uint32_t border = mt.isOpen(NodeId(i)) ? 0x80000000u : 0;
    words[2 * std::size_t(i)] = std::bit_cast<std::uint32_t>(a.scale.decode(a.saturatedError[i])) | border;
    words[2 * std::size_t(i) + 1] = a.slotBegin[i];
  });
  words[2 * std::size_t(n) + 1] = a.slotBegin[n];
  return words;
}

/// The largest buffer that the compute shaders would have.
std::string whyNot(const MultiTriangulation& mt) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  GLint bindings = 0;
  glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &bindings);
  const std::size_t largest = std::max(
      {mt.arrays().remover.size_bytes(), mt.arrays().sphere.size_bytes(), std::size_t(24) * mt.nodeCount()});
  if (bindings < 8)
    return fmt::format("the device has {} storage buffers for a compute shader, and 8 are needed", bindings);
  if (largest > std::size_t(most))
    return fmt::format("a storage buffer of the device holds {} MB, and {} MB are needed", most >> 20,
                       (largest >> 20) + 1);
  return {};
}

}  // namespace

TerrainOnGpu uploadTerrain(const MultiTriangulation& mt, const MultiTriangulation* flat,
                           const RunContext& context) {
  const MtArrays& a = mt.arrays();
  TerrainOnGpu t;
  t.vertices = mt.vertexCount();
  t.nodeCount = mt.nodeCount();
  t.rootTriangles = mt.rootTriangleCount();
  t.rootVertices = mt.rootVertexCount();
  t.blocks = static_cast<std::uint32_t>(nodeBlockCount(mt.nodeCount()));
  t.pages = static_cast<std::uint32_t>(a.blockSphere.size()) - t.blocks;
  t.positions = makeBuffer(std::span<const float>(metricPositions(mt)));
  if (flat) t.places = makeBuffer(std::span<const float>(metricPositions(*flat)));
  t.rises = makeBuffer(std::size_t(4) * mt.vertexCount());
  t.refusal = whyNot(mt);
  if (!t.refusal.empty()) return t;

  t.roots =
      makeBuffer(a.rootTriangles.size_bytes(), a.rootTriangles.empty() ? nullptr : a.rootTriangles.data());
  t.nodes = makeBuffer(std::span<const std::uint32_t>(nodeWords(mt)));
  t.nodeBalls = makeBuffer(a.sphere);
  t.blockBalls = makeBuffer(a.blockSphere);
  std::vector<float> errors(a.blockError.size());
  std::ranges::transform(a.blockError, errors.begin(), [&](auto code) { return a.scale.decode(code); });
  t.blockErrors = makeBuffer(std::span<const float>(errors));
  t.links = makeBuffer(a.link);
  t.removers = makeBuffer(a.remover);
  t.morphs = makeBuffer(std::span<const MorphNode>(makeMorphNodes(mt, context)));
  return t;
}

void uploadErrors(TerrainOnGpu& terrain, const MultiTriangulation& mt) {
  std::vector<std::uint16_t> codes(mt.arrays().error.begin(), mt.arrays().error.end());
  if (codes.size() % 2 != 0) codes.push_back(0);
  terrain.triangleErrors = makeBuffer(std::span<const std::uint16_t>(codes));
}

}  // namespace arete
