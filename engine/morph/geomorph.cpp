// SPDX-License-Identifier: GPL-3.0-or-later
//
// The floor triangle of a vertex is the first that contains it; on a lattice that test is exact.
//
// Tolerance. ViewError's bound holds for infinitesimal displacements. At a point p with distance d and depth
// z a unit of height takes at most f / reach(p) pixels, reach = z^2 / d; its gradient 2 c F - c^2 P (F, P
// unit vectors forward and to p, c = z / d their cosine) has the length sqrt(4 c^2 - 3 c^4), at most 2 /
// sqrt(3). So along a path of length L from p the reach is at least reach(p) - L 2 / sqrt(3), and what takes
// x pixels by the scale at p takes at most x / (1 - x b), b = 2 / (sqrt(3) f), in all. To guarantee t pixels,
// t / (1 + t b) at the scale of p are used: 0.1 % less for a pixel of a usual screen. The bound holds
// wherever the path leads, also out of the ball or the frustum. In parallel projection the reach does not
// change.
#include "engine/morph/geomorph.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/vector_clones.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"

namespace arete {
namespace {

constexpr double kBend = 2 * std::numbers::inv_sqrt3;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

MorphNode morphNode(const MultiTriangulation& mt, NodeId n) {
  const VertexArrays& vertices = mt.vertices();
  const VertexId apex = mt.apex(n);
  const Vec2 v = vertices.planPosition(apex);
  const auto fromApex = [&](std::uint32_t corner) {
    const Vec2 p = vertices.planPosition(VertexId(corner));
    return Vec2{p.x - v.x, p.y - v.y};
  };
  std::array<std::uint32_t, 3> best{};
  std::array<double, 3> bestWeights{};
  double bestLeast = -kInfinity;
  for (const std::uint32_t t : mt.floor(n)) {
    const auto corners = mt.corners(TriangleId(t));
    const Vec2 a = fromApex(corners[0]), b = fromApex(corners[1]), c = fromApex(corners[2]);
    std::array<double, 3> weights = {cross(b, c), cross(c, a), cross(a, b)};
    const double area = weights[0] + weights[1] + weights[2];
    if (!(area > 0)) continue;  // only where rounding has flattened it
    for (double& w : weights) w /= area;
    const double least = std::min({weights[0], weights[1], weights[2]});
    if (!(least > bestLeast)) continue;
    best = corners, bestWeights = weights, bestLeast = least;
    if (least >= 0) break;
  }
  // If rounding flattens every triangle of the floor, a corner stands for the place of the apex.
  if (bestLeast == -kInfinity) best = mt.corners(TriangleId(mt.floor(n)[0])), bestWeights = {1, 0, 0};
  double sum = 0;
  for (double& w : bestWeights) sum += w = std::max(w, 0.0);
  const double w0 = bestWeights[0] / sum, w1 = bestWeights[1] / sum, z2 = vertices.height(VertexId(best[2]));
  const double floor =
      w0 * (vertices.height(VertexId(best[0])) - z2) + w1 * (vertices.height(VertexId(best[1])) - z2);
  return {best,
          {static_cast<float>(w0), static_cast<float>(w1)},
          static_cast<float>(vertices.height(apex) - z2 - floor)};
}

std::vector<MorphNode> makeMorphNodes(const MultiTriangulation& mt, const RunContext& context) {
  std::vector<MorphNode> made(mt.nodeCount());
  withThreads(context, [&] {
    parallelFor(IndexRange<std::uint32_t>(0, mt.nodeCount(), 1024), [&](const auto& range) {
      for (std::uint32_t n = range.begin(); n < range.end(); ++n) made[n] = morphNode(mt, NodeId(n));
    });
  });
  return made;
}

MorphCamera::MorphCamera(const Options& options, const MetricFrame& metric)
    : frustum_(options.view),
      pixelsPerReach_(frustum_.pixelsPerUnit() * std::abs(metric.scale.z)),
      bend_(frustum_.isParallel() ? 0 : kBend),
      moves_(options.moves) {
  // The cut and the vertices on their way share one tolerance.
  const double whole = options.pixels / (1 + options.pixels * bend_ / frustum_.pixelsPerUnit());
  tolerance_.cut = moves_ ? options.cutShare * whole : whole;
  tolerance_.offset = whole - tolerance_.cut;
}

void MorphCamera::widen(double cutPixels) {
  assert(std::isfinite(cutPixels) && cutPixels > 0);
  tolerance_.offset *= cutPixels / tolerance_.cut;
  tolerance_.cut = cutPixels;
}

double MorphCamera::pixelsPerHeight(const Sphere& ball) const {
  if (!frustum_.mayMeet(ball)) return 0;
  const Vec3 centre = frustum_.toView({ball.x, ball.y, ball.z});
  const double reach = frustum_.reach(centre, ball.radius, centre.z - ball.radius);
  return reach > 0 ? pixelsPerReach_ / reach : kInfinity;
}

double MorphCamera::pixelsPerHeight(std::span<const Vec3> hull) const {
  thread_local std::vector<Vec3> inView;
  inView.clear();
  Vec3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const Vec3& place : hull) {
    const Vec3 p = frustum_.toView(place);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    inView.push_back(p);
  }
  if (!frustum_.mayMeet(inView)) return 0;
  // A ball around the middle of the hull's box holds the hull.
  const Vec3 centre{(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2};
  double squared = 0;
  for (const Vec3& p : inView)
    squared = std::max(squared, (p.x - centre.x) * (p.x - centre.x) + (p.y - centre.y) * (p.y - centre.y) +
                                    (p.z - centre.z) * (p.z - centre.z));
  const double reach = frustum_.reach(centre, std::sqrt(squared), low.z);
  return reach > 0 ? pixelsPerReach_ / reach : kInfinity;
}

// The formulas of view.cpp, branch-free, so that the loop is vectorized.
ARETE_VECTOR_CLONES
void MorphCamera::pixelsPerHeight(std::span<const Sphere> balls, std::span<double> results) const {
  assert(balls.size() == results.size());
  const Frustum::Planes p = frustum_.planes();
  const Vec3 eye = frustum_.eye();
  const double near = frustum_.nearDistance(), far = frustum_.farDistance(), scale = pixelsPerReach_;
  const bool isParallel = frustum_.isParallel();
  const std::size_t count = balls.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = balls[i].radius;
    const double dx = balls[i].x - eye.x, dy = balls[i].y - eye.y, dz = balls[i].z - eye.z;
    const double x = dx * p.right.x + dy * p.right.y + dz * p.right.z,
                 y = dx * p.up.x + dy * p.up.y + dz * p.up.z,
                 z = dx * p.forward.x + dy * p.forward.y + dz * p.forward.z;
    // All four always compared, so that the loop has no branch.
    const int isBetweenX = std::abs(x) - p.slopeX * z - p.halfX <= radius * p.lengthX,
              isBetweenY = std::abs(y) - p.slopeY * z - p.halfY <= radius * p.lengthY,
              isBeyondNear = z + radius >= near, isBeforeFar = z - radius <= far;
    const bool isSeen = (isBetweenX & isBetweenY & isBeyondNear & isBeforeFar) != 0;
    const double distance = std::sqrt(x * x + y * y + z * z), nearest = distance - radius;
    const double depth = z - radius, byDepth = (depth > near ? depth : near) * p.leastCosine;
    const double cosine = z / distance, sine2 = 1 - cosine * cosine, ballSine = radius / distance,
                 ballCosine2 = 1 - ballSine * ballSine;
    const double angle =
        cosine * std::sqrt(ballCosine2 > 0 ? ballCosine2 : 0) - std::sqrt(sine2 > 0 ? sine2 : 0) * ballSine;
    const double reached = angle > p.leastCosine ? angle : p.leastCosine;
    const double byAngle = nearest * reached * reached;
    const double inPerspective =
        byAngle > byDepth ? byAngle : byDepth;  // around the eye the first is negative
    const double reach = isParallel ? 1 : inPerspective;
    results[i] = isSeen ? scale / (reach > 0 ? reach : 0) : 0;
  }
}

double MorphCamera::pixelsOf(double height, double pixelsPerHeight) const {
  return height == 0 || pixelsPerHeight == 0 ? 0 : pixelsOf(height * pixelsPerHeight);
}

double MorphCamera::pixelsOf(double pixelsThere) const {
  const double left = 1 - pixelsThere * bend_ / frustum_.pixelsPerUnit();
  return left > 0 ? pixelsThere / left : kInfinity;
}

}  // namespace arete
