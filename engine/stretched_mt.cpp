// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every node's ball is made anew, as a build makes it: around its star, grown to hold its children's. Scaling
// the balls that are there would be simpler, and worse twice over: a ball around a stretched ball is larger
// than one around what is in it, and the rounding of centres, which is of the size of the coordinates, could
// push a small ball out of its parent.
#include "engine/stretched_mt.h"

#include <cassert>
#include <cmath>
#include <vector>

#include "engine/enclosing_ball.h"
#include "engine/node_blocks.h"

namespace arete {
namespace {

struct Owner {
  MultiTriangulation original;
  std::vector<Sphere> sphere;
  NodeBlocks blocks;
};

}  // namespace

MultiTriangulation stretched(const MultiTriangulation& mt, double factor) {
  assert(std::isfinite(factor) && factor > 0);
  auto owner = std::make_shared<Owner>();
  owner->original = mt;
  MtArrays a = mt.arrays();
  a.metric.scale.z *= factor;
  owner->sphere.resize(mt.nodeCount());
  std::vector<Vec3> star;
  for (std::uint32_t n = mt.nodeCount(); n-- > 0;) {
    const NodeId node(n);
    star.clear();
    star.push_back(a.metric.toMetric(mt.position(mt.apex(node))));
    for (const std::uint32_t v : mt.link(node)) star.push_back(a.metric.toMetric(mt.position(VertexId(v))));
    EnclosingBall ball = EnclosingBall::around(star);
    for (std::uint32_t i = 0; i < mt.ceilingSize(node); ++i)
      if (const NodeId child = mt.remover(mt.slotTriangle(node, i)); child.isValid())
        ball.encloseChild(owner->sphere[child.index()]);
    owner->sphere[n] = ball.rounded();
  }
  owner->blocks = makeNodeBlocks(a.saturatedError, owner->sphere);
  a.sphere = owner->sphere;
  a.blockSphere = owner->blocks.sphere;
  a.blockError = owner->blocks.error;
  return MultiTriangulation(a, owner);
}

}  // namespace arete
