// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the parameters of a frame in the layout std140 of shaders/frame.glsl.
#include "viewer/gl/frame_block.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

glm::vec4 floats(const Vec3& v, double w = 0) {
  return glm::vec4(glm::dvec4(v.x, v.y, v.z, w));
}

glm::dvec4 doubles(const Vec3& v) {
  return {v.x, v.y, v.z, 0};
}

}  // namespace

FrameBlock frameBlock(const FrameView& f, const MetricFrame& metric) {
  const Frustum frustum(f.view);
  const Frustum::Planes p = frustum.planes();
  // GLSL need not know infinity.
  const double far = std::min(f.view.farDistance, 1e30), near = std::max(f.view.nearDistance, -1e30);
  const double unitsToMetric = std::abs(metric.scale.z) * f.stretch;
  const double errorPerReach = f.pixels / frustum.pixelsPerUnit() / unitsToMetric;

  FrameBlock block;
  const Vec3 eye = f.view.eye;
  block.eyeHigh = floats(eye);
  block.eyeLow = floats(
      {eye.x - double(block.eyeHigh.x), eye.y - double(block.eyeHigh.y), eye.z - double(block.eyeHigh.z)});
  const double side = f.isMirrored ? -1 : 1;
  block.right = floats({side * p.right.x, side * p.right.y, side * p.right.z});
  block.up = floats(p.up);
  block.forward = floats(p.forward);
  block.lens = glm::vec4{float(1 / p.halfWidth(1)), float(1 / p.halfHeight(1)), float(f.drawnNear),
                         float(f.earthRadius > 0 ? 1 : f.stretch)};
  block.sides = glm::vec4{float(p.slopeX), float(p.slopeY), float(p.lengthX), float(p.lengthY)};
  block.reach = glm::vec4{float(near), float(far), float(p.leastCosine), float(errorPerReach)};
  block.morph = glm::vec4{float(f.pixels), float(f.morphPixels),
                          float(frustum.pixelsPerUnit() * unitsToMetric), f.morphPixels > 0 ? 1.0f : 0.0f};
  block.earth = glm::vec4{float(f.stretch), float(f.earthRadius), 0, 0};
  block.eyeExact = doubles(eye);
  block.rightExact = doubles(p.right);
  block.upExact = doubles(p.up);
  block.forwardExact = doubles(p.forward);
  block.sidesExact = glm::dvec4{p.slopeX, p.slopeY, p.lengthX, p.lengthY};
  block.reachExact = glm::dvec4{near, far, p.leastCosine, errorPerReach};
  block.halvesExact = glm::dvec4{p.halfX, p.halfY, 0, 0};
  block.parallel = glm::vec4{float(p.halfX), float(p.halfY), f.view.isParallel() ? 1.0f : 0.0f,
                             float(1 / (2 * f.depthReach))};
  block.metricOrigin = floats(metric.origin);
  block.metricScale = floats(metric.scale);
  const glm::vec2 high(float(f.eyeGround.x), float(f.eyeGround.y));
  block.eyeGround =
      glm::vec4(high, float(f.eyeGround.x - double(high.x)), float(f.eyeGround.y - double(high.y)));
  return block;
}

}  // namespace arete
