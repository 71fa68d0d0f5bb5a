// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every node's ball is computed anew, as a build does: around its star and its children's balls. Scaling the
// existing balls would be simpler but worse: a ball around an exaggerated ball is larger than one around its
// content, and the rounding of centres, which depends on the size of the coordinates, could move a small ball
// out of its parent.
#include "engine/mt/exaggerated_mt.h"

#include <cassert>
#include <cmath>
#include <vector>

#include "engine/mt/node_blocks.h"
#include "engine/mt/saturated_balls.h"

namespace arete {
namespace {

struct ExaggeratedOwner {
  MultiTriangulation original;
  std::vector<Sphere> sphere;
  NodeBlocks blocks;
};

}  // namespace

MultiTriangulation exaggerated(const MultiTriangulation& mt, double factor) {
  assert(std::isfinite(factor) && factor > 0);
  auto owner = std::make_shared<ExaggeratedOwner>();
  owner->original = mt;
  MtArrays a = mt.arrays();
  a.metric.scale.z *= factor;
  owner->sphere =
      saturatedBalls(mt, [&](std::uint32_t v) { return a.metric.toMetric(mt.position(VertexId(v))); });
  owner->blocks = makeNodeBlocks(a.saturatedError, owner->sphere);
  a.sphere = owner->sphere;
  a.blockSphere = owner->blocks.sphere;
  a.blockError = owner->blocks.error;
  return MultiTriangulation(a, owner);
}

}  // namespace arete
