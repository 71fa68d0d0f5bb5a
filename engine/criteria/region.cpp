// SPDX-License-Identifier: GPL-3.0-or-later
//
// One tree holds all edges, of rings and lines; a second one those of rings alone, for the even-odd rule.
// Without a distance a query is answered in plan coordinates, by the signs of cross products; with a distance
// it is transformed to metric space, and the distances to the nearest edges decide.
#include "engine/criteria/region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(Vec2 o, Vec2 a, Vec2 b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

bool onSegment(Vec2 a, Vec2 b, Vec2 p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segmentsMeet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double d1 = cross(c, d, a), d2 = cross(c, d, b), d3 = cross(a, b, c), d4 = cross(a, b, d);
  if (((d1 > 0 && d2 < 0) || (d1 < 0 && d2 > 0)) && ((d3 > 0 && d4 < 0) || (d3 < 0 && d4 > 0))) return true;
  return (d1 == 0 && onSegment(c, d, a)) || (d2 == 0 && onSegment(c, d, b)) ||
         (d3 == 0 && onSegment(a, b, c)) || (d4 == 0 && onSegment(a, b, d));
}

double squaredDistance(Vec2 p, Vec2 a, Vec2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0;
  const double ex = a.x + t * dx - p.x, ey = a.y + t * dy - p.y;
  return ex * ex + ey * ey;
}

/// Of segments that do not meet.
double squaredDistance(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return std::min({squaredDistance(a, c, d), squaredDistance(b, c, d), squaredDistance(c, a, b),
                   squaredDistance(d, a, b)});
}

Box2 around(const Box2& box, double distance) {
  return {box.xMin - distance, box.yMin - distance, box.xMax + distance, box.yMax + distance};
}

bool isEdgeWithin(const SegmentBvh& edges, Vec2 p, double distance) {
  return edges.anyIn(around({p.x, p.y, p.x, p.y}, distance),
                     [&](const Segment2& e) { return squaredDistance(p, e.a, e.b) <= distance * distance; });
}

void appendEdges(const std::vector<Vec2>& chain, bool isClosed, std::vector<Segment2>& edges) {
  if (chain.size() == 1) edges.push_back({chain[0], chain[0]});
  for (std::size_t i = 0; i + (isClosed ? 0 : 1) < chain.size(); ++i) {
    const Vec2 a = chain[i], b = chain[i + 1 < chain.size() ? i + 1 : 0];
    if (a != b) edges.push_back({a, b});
  }
}

}  // namespace

// The bounds stay in plan coordinates and are widened by the distance, so that a query outside them ends
// without a transformation. The chains are transformed once, here.
Region::Region(RegionShape shape, const MetricFrame& metric) : shape_(std::move(shape)) {
  if (shape_.distance > 0) frame_ = metric;
  std::erase_if(shape_.rings, [](const auto& ring) { return ring.size() < 3; });
  std::erase_if(shape_.lines, [](const auto& line) { return line.empty(); });
  Box2 bounds{kInfinity, kInfinity, -kInfinity, -kInfinity};
  std::vector<Segment2> edges, ringEdges;
  for (auto* chains : {&shape_.rings, &shape_.lines})
    for (auto& chain : *chains)
      for (Vec2& p : chain) {
        bounds = {std::min(bounds.xMin, p.x), std::min(bounds.yMin, p.y), std::max(bounds.xMax, p.x),
                  std::max(bounds.yMax, p.y)};
        p = toInner(p);
      }
  for (const auto& ring : shape_.rings) appendEdges(ring, true, ringEdges);
  edges = ringEdges;
  for (const auto& line : shape_.lines) appendEdges(line, false, edges);
  tree_ = SegmentBvh(std::move(edges));
  ringTree_ = SegmentBvh(std::move(ringEdges));
  const double dx = shape_.distance / std::abs(frame_.scale.x),
               dy = shape_.distance / std::abs(frame_.scale.y);
  bounds_ = {bounds.xMin - dx, bounds.yMin - dy, bounds.xMax + dx, bounds.yMax + dy};
}

Region Region::box(const Box2& b) {
  return Region({{{b.xMin, b.yMin}, {b.xMax, b.yMin}, {b.xMax, b.yMax}, {b.xMin, b.yMax}}});
}

// The edges that a ray towards larger x crosses are counted. An end at the height of the ray counts as below
// it, so a vertex there changes the parity as it should. A point on an edge is inside.
bool Region::isInRings(Vec2 p) const {
  bool inside = false;
  const bool onEdge = ringTree_.anyIn({p.x, p.y, kInfinity, p.y}, [&](const Segment2& e) {
    const double side = cross(e.a, e.b, p);
    if (side == 0 && onSegment(e.a, e.b, p)) return true;
    if ((e.a.y > p.y) != (e.b.y > p.y) && (side > 0) == (e.b.y > e.a.y)) inside = !inside;
    return false;
  });
  return onEdge || inside;
}

bool Region::contains(Vec2 plan) const {
  if (plan.x < bounds_.xMin || plan.x > bounds_.xMax || plan.y < bounds_.yMin || plan.y > bounds_.yMax)
    return false;
  const Vec2 p = toInner(plan);
  if (isInRings(p)) return true;
  return isEdgeWithin(tree_, p, shape_.distance);
}

// A triangle can meet a region without a vertex of one in the other, so edges are compared with edges. If no
// edge is near, the triangle is wholly inside or outside, and one corner decides.
bool Region::meetsInner(Vec2 a, Vec2 b, Vec2 c) const {
  const double turn = cross(a, b, c) < 0 ? -1 : 1;
  const auto inTriangle = [&](Vec2 p) {
    return turn * cross(a, b, p) >= 0 && turn * cross(b, c, p) >= 0 && turn * cross(c, a, p) >= 0;
  };
  const double d = shape_.distance;
  const Box2 box{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::max({a.x, b.x, c.x}),
                 std::max({a.y, b.y, c.y})};
  const bool nearEdge = tree_.anyIn(around(box, d), [&](const Segment2& e) {
    if (inTriangle(e.a) || segmentsMeet(e.a, e.b, a, b) || segmentsMeet(e.a, e.b, b, c) ||
        segmentsMeet(e.a, e.b, c, a))
      return true;
    return d > 0 && std::min({squaredDistance(e.a, e.b, a, b), squaredDistance(e.a, e.b, b, c),
                              squaredDistance(e.a, e.b, c, a)}) <= d * d;
  });
  return nearEdge || isInRings(a);
}

bool Region::meetsTriangle(Vec2 a, Vec2 b, Vec2 c) const {
  if (std::max({a.x, b.x, c.x}) < bounds_.xMin || std::min({a.x, b.x, c.x}) > bounds_.xMax ||
      std::max({a.y, b.y, c.y}) < bounds_.yMin || std::min({a.y, b.y, c.y}) > bounds_.yMax)
    return false;
  return meetsInner(toInner(a), toInner(b), toInner(c));
}

// Discs are widened and narrowed by a little, so that rounding never makes an answer wrong in the unsafe
// direction.
bool Region::meetsDisc(Vec2 centre, double radius) const {
  const Vec2 p = toInner(centre);
  return isEdgeWithin(tree_, p, (shape_.distance + radius) * (1 + 1e-9)) || isInRings(p);
}

bool Region::holdsDisc(Vec2 centre, double radius) const {
  const Vec2 p = toInner(centre);
  const double r = radius * (1 + 1e-9), left = shape_.distance * (1 - 1e-9) - r;
  return (left >= 0 && isEdgeWithin(tree_, p, left)) || (!isEdgeWithin(tree_, p, r) && isInRings(p));
}

/// With a distance the region is in metric space already; otherwise its chains are transformed.
Region Region::scaled(const MetricFrame& metric) const {
  RegionShape shape = shape_;
  if (shape.distance == 0)
    for (auto* chains : {&shape.rings, &shape.lines})
      for (auto& chain : *chains)
        for (Vec2& p : chain) {
          const Vec3 q = metric.toMetric({p.x, p.y, 0});
          p = {q.x, q.y};
        }
  return Region(std::move(shape));
}

}  // namespace arete
