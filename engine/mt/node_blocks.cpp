// SPDX-License-Identifier: GPL-3.0-or-later
//
// A ball around spheres has its centre in the middle of the box of their centres and reaches to the farthest
// of them. It is widened as a parent's sphere is (enclosing_ball.h), so that whatever touches a node's sphere
// touches its cluster's, in spite of the rounding of any test. Cluster groups are made from nodes, not from
// clusters: balls around balls would be larger.
#include "engine/mt/node_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr double kWiden = 1 + 1e-6;

Sphere ballAround(std::span<const Sphere> spheres) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float low[3] = {kInfinity, kInfinity, kInfinity}, high[3] = {-kInfinity, -kInfinity, -kInfinity};
  for (const Sphere& s : spheres) {
    const float p[3] = {s.x, s.y, s.z};
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  Sphere ball{low[0] + (high[0] - low[0]) / 2, low[1] + (high[1] - low[1]) / 2,
              low[2] + (high[2] - low[2]) / 2, 0};
  double radius = 0;
  for (const Sphere& s : spheres) {
    const double dx = double(s.x) - ball.x, dy = double(s.y) - ball.y, dz = double(s.z) - ball.z;
    radius = std::max(radius, std::sqrt(dx * dx + dy * dy + dz * dz) + s.radius);
  }
  ball.radius = std::nextafter(static_cast<float>(radius * kWiden), kInfinity);
  return ball;
}

}  // namespace

std::uint64_t nodeBlockCount(std::uint64_t nodes) {
  constexpr std::uint64_t kSize = MultiTriangulation::kNodesPerBlock;
  return (nodes + kSize - 1) / kSize;
}

std::uint64_t nodeBlockAndPageCount(std::uint64_t nodes) {
  constexpr std::uint64_t kSize = MultiTriangulation::kNodesPerPage;
  return nodeBlockCount(nodes) + (nodes + kSize - 1) / kSize;
}

NodeBlocks makeNodeBlocks(std::span<const OutwardScale::Code> saturatedError,
                          std::span<const Sphere> sphere) {
  const std::size_t nodes = sphere.size(), blocks = nodeBlockCount(nodes);
  NodeBlocks made;
  made.sphere.resize(nodeBlockAndPageCount(nodes));
  made.error.resize(made.sphere.size());
  const auto make = [&](std::size_t entry, std::size_t begin, std::size_t size) {
    const std::size_t count = std::min(size, nodes - begin);
    made.sphere[entry] = ballAround(sphere.subspan(begin, count));
    made.error[entry] = std::ranges::max(saturatedError.subspan(begin, count));
  };
  parallelFor(std::size_t(0), made.sphere.size(), [&](std::size_t entry) {
    if (entry < blocks)
      make(entry, entry * MultiTriangulation::kNodesPerBlock, MultiTriangulation::kNodesPerBlock);
    else
      make(entry, (entry - blocks) * MultiTriangulation::kNodesPerPage, MultiTriangulation::kNodesPerPage);
  });
  return made;
}

bool holdsError(const MtArrays& a, std::uint64_t entry, std::uint32_t n) {
  return a.saturatedError[n] <= a.blockError[entry];
}

bool holdsSphere(const MtArrays& a, std::uint64_t entry, std::uint32_t n) {
  const Sphere &s = a.sphere[n], &ball = a.blockSphere[entry];
  const double dx = double(s.x) - ball.x, dy = double(s.y) - ball.y, dz = double(s.z) - ball.z;
  return std::sqrt(dx * dx + dy * dy + dz * dz) + s.radius <= ball.radius;
}

std::array<std::uint64_t, 2> blockEntries(std::uint64_t nodes, std::uint32_t n) {
  return {n / MultiTriangulation::kNodesPerBlock,
          nodeBlockCount(nodes) + n / MultiTriangulation::kNodesPerPage};
}

}  // namespace arete
