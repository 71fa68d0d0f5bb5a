// SPDX-License-Identifier: GPL-3.0-or-later
//
// Popping. The distance to a triangle is a convex function, so over a convex piece it is largest at a corner
// of the piece. Any partition of the star into pieces, each with a triangle of the floor, therefore gives a
// bound, and a good one where every piece lies over its triangle: the pieces are cut along the sides of the
// floor's triangles, in the direction of the polygon's area vector. What lies over none, as beyond a border
// that the vertex bends, takes the triangle of the floor that gives the least. The same bounds the floor's
// distance to the star.
//
// In nearly all cases floor and star are both one to one with the polygon's shadow in that direction. Then
// both are linear between the vertex, the polygon and the crossings of spokes and inner edges of the floor,
// and the distance along the direction is largest at one of these: faster by a factor of ten.
#include "engine/morph/space_motion.h"

#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/triangle_shares.h"

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Piece = std::vector<Vec3>;  // a convex polygon

/// Cuts a piece by a plane through `at`: what is on the side of `normal`, and the rest.
void cut(const Piece& piece, const Vec3& at, const Vec3& normal, Piece& inside, Piece& outside) {
  inside.clear();
  outside.clear();
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3 &p = piece[i], &q = piece[(i + 1) % piece.size()];
    const double here = dot(p - at, normal), there = dot(q - at, normal);
    if (here >= 0) inside.push_back(p);
    if (here <= 0) outside.push_back(p);
    if ((here < 0 && there > 0) || (here > 0 && there < 0)) {
      const Vec3 crossing = p + (here / (here - there)) * (q - p);
      inside.push_back(crossing);
      outside.push_back(crossing);
    }
  }
  if (inside.size() < 3) inside.clear();
  if (outside.size() < 3) outside.clear();
}

double farthest(const Piece& piece, const SpaceTriangle& from) {
  double most = 0;
  for (const Vec3& p : piece) most = std::max(most, distanceToTriangle(p, from));
  return most;
}

/// A bound of the distance of any point of `from` to `to`, cut in the direction of `axis`.
double distanceBound(const std::vector<SpaceTriangle>& from, const std::vector<SpaceTriangle>& to,
                     const Vec3& axis) {
  double most = 0;
  std::vector<Piece> left, next;
  Piece inside, outside, rest;
  for (const SpaceTriangle& t : from) {
    left.assign(1, Piece(t.begin(), t.end()));
    for (const SpaceTriangle& below : to) {
      if (!(dot(areaNormal(below), axis) > 0)) continue;
      next.clear();
      for (const Piece& piece : left) {
        rest = piece;
        for (std::size_t i = 0; i < 3 && !rest.empty(); ++i) {
          cut(rest, below[i], cross(axis, below[(i + 1) % 3] - below[i]), inside, outside);
          if (!outside.empty()) next.push_back(outside);
          rest = inside;
        }
        if (!rest.empty()) most = std::max(most, farthest(rest, below));
      }
      std::swap(left, next);
    }
    for (const Piece& piece : left) {
      double least = kInfinity;
      for (const SpaceTriangle& below : to) least = std::min(least, farthest(piece, below));
      most = std::max(most, least);
    }
  }
  return most;
}

}  // namespace

SpaceMorphNode SpaceMotion::nodeOf(const MultiTriangulation& mt, NodeId n) {
  const Vec3 v = mt.position(mt.apex(n));
  SpaceMorphNode node{};
  double least = kInfinity;
  std::array<Vec3, 3> places{};
  for (const std::uint32_t t : mt.floor(n)) {
    const auto ids = mt.corners(TriangleId(t));
    const SpaceTriangle corners = {mt.position(VertexId(ids[0])) - v, mt.position(VertexId(ids[1])) - v,
                                   mt.position(VertexId(ids[2])) - v};
    const Vec3 nearest = nearestOnTriangle({}, corners);
    const double distance = dot(nearest, nearest);
    if (!(distance < least)) continue;
    least = distance;
    node.corner = ids;
    places = corners;
  }
  const auto weights = nearestShares({}, places);
  node.weight = {static_cast<float>(weights[0]), static_cast<float>(weights[1])};
  node.detail = -node.interpolate(places[0], places[1], places[2]);
  return node;
}

SpaceOffset SpaceMotion::offset(const MorphCamera& camera, const Node& node, double rho, double pixelsPerUnit,
                                const Offset& at0, const Offset& at1, const Offset& at2) {
  const double share = camera.share(rho);
  if (share == 0) return {};
  Vec3 free = node.interpolate(at0.vector(), at1.vector(), at2.vector()) - share * node.detail;
  const double length = norm(free), most = camera.mostOffset(pixelsPerUnit);
  if (length > most) free = (most / length) * free;
  return {static_cast<float>(free.x), static_cast<float>(free.y), static_cast<float>(free.z)};
}

void SpaceMotion::addPlaces(const Vec3& place, double room, const MetricFrame& metric,
                            std::vector<Vec3>& hull) {
  if (room == 0) {
    hull.push_back(metric.toMetric(place));
    return;
  }
  for (const double x : {-room, room})
    for (const double y : {-room, room})
      for (const double z : {-room, room}) hull.push_back(metric.toMetric(place + Vec3{x, y, z}));
}

/// The popping of a star that is one to one with its shadow, as its floor is; nothing where one is not.
template <class Star>
static std::optional<double> shadowPopping(const Star& star, const Vec3& axis) {
  const std::size_t k = star.link.size();
  thread_local std::vector<Vec3> flat;  // plan and height along the axis
  flat.clear();
  const Vec3 n = unit(axis);
  const Vec3 least = std::abs(n.x) <= std::abs(n.y) && std::abs(n.x) <= std::abs(n.z) ? Vec3{1, 0, 0}
                     : std::abs(n.y) <= std::abs(n.z)                                 ? Vec3{0, 1, 0}
                                                                                      : Vec3{0, 0, 1};
  const Vec3 x = unit(cross(least, n)), y = cross(n, x);
  for (const Vec3& p : star.link) flat.push_back({dot(p, x), dot(p, y), dot(p, n)});
  const auto turn = [](const Vec3& a, const Vec3& b) { return a.x * b.y - a.y * b.x; };
  std::size_t rounds = 0;
  for (std::size_t i = 0; i < k; ++i) {
    const Vec3 &a = flat[i], &b = flat[(i + 1) % k];
    if (!(turn(a, b) > 0)) return std::nullopt;
    rounds += a.y < 0 && b.y >= 0 ? 1 : 0;
  }
  if (rounds != 1) return std::nullopt;
  double most = -1;
  for (const auto& t : star.floor) {
    const Vec3 &a = flat[t[0]], &b = flat[t[1]], &c = flat[t[2]];
    const double wa = turn(b, c), wb = turn(c, a), wc = turn(a, b), area = wa + wb + wc;
    if (!(area > 0)) return std::nullopt;
    if (wa >= 0 && wb >= 0 && wc >= 0) most = std::max(most, std::abs(wa * a.z + wb * b.z + wc * c.z) / area);
  }
  if (most < 0) return std::nullopt;
  for (const auto& t : star.floor)
    for (int i = 0; i < 3; ++i) {
      // An inner edge belongs to two triangles, in opposite directions: one of them suffices.
      const std::uint32_t from = t[i], to = t[(i + 1) % 3];
      if (from > to) continue;
      const Vec3 &a = flat[from], &b = flat[to];
      const double dx = b.x - a.x, dy = b.y - a.y, side = a.x * dy - a.y * dx;
      for (std::uint32_t s = 0; s < k; ++s) {
        if (s == from || s == to || side == 0) continue;
        const Vec3& spoke = flat[s];
        const double across = spoke.x * dy - spoke.y * dx;
        if (!(side > 0 ? across > side : across < side)) continue;
        const double at = side / across, px = at * spoke.x - a.x, py = at * spoke.y - a.y;
        const double along = (px * dx + py * dy) / (dx * dx + dy * dy);
        if (along > 0 && along < 1)
          most = std::max(most, std::abs(at * spoke.z - (a.z + along * (b.z - a.z))));
      }
    }
  return most;
}

double SpaceMotion::bound(const Star& star) {
  std::vector<SpaceTriangle> floor, ceiling;
  Vec3 axis;
  for (const auto& t : star.floor) {
    floor.push_back({star.link[t[0]], star.link[t[1]], star.link[t[2]]});
    axis = axis + areaNormal(floor.back());
  }
  if (star.isClosed && dot(axis, axis) > 0)
    if (const auto most = shadowPopping(star, axis)) return *most;
  const std::size_t k = star.link.size();
  for (std::size_t i = 0; i + (star.isClosed ? 0 : 1) < k; ++i)
    ceiling.push_back({Vec3{}, star.link[i], star.link[(i + 1) % k]});
  return std::max(distanceBound(ceiling, floor, axis), distanceBound(floor, ceiling, axis));
}

}  // namespace arete
