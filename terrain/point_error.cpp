// SPDX-License-Identifier: GPL-3.0-or-later
//
// The walk along a segment a-b through the finest triangulation: at a vertex on the segment, turn through its
// star to the triangle that the segment enters (or to a neighbour that lies on it); inside a triangle, the
// corner opposite the edge just crossed lies left of, right of or on the segment, which names the next edge
// or vertex. Every decision is an exact orientation; only the heights at the crossings are computed in
// doubles.
#include "terrain/point_error.h"

#include <algorithm>
#include <cmath>

namespace arete {

bool PointError::covers(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const {
  const Vec2 pa = plan_.planPosition(a), pb = plan_.planPosition(b), pc = plan_.planPosition(c),
             q = plan_.planPosition(p);
  if (q.x < std::min({pa.x, pb.x, pc.x}) || q.x > std::max({pa.x, pb.x, pc.x}) ||
      q.y < std::min({pa.y, pb.y, pc.y}) || q.y > std::max({pa.y, pb.y, pc.y}))
    return false;
  return plan_.orientation(a, b, p) >= 0 && plan_.orientation(b, c, p) >= 0 &&
         plan_.orientation(c, a, p) >= 0;
}

/// z of the plane through a, b, c minus z of p, at p.
double PointError::difference(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const {
  const Vec2 o = plan_.planPosition(a), pb = plan_.planPosition(b), pc = plan_.planPosition(c),
             q = plan_.planPosition(p);
  const double bx = pb.x - o.x, by = pb.y - o.y, cx = pc.x - o.x, cy = pc.y - o.y, x = q.x - o.x,
               y = q.y - o.y;
  const double area = bx * cy - by * cx;
  // A sliver whose area doubles cannot hold, though its corners turn left. Over a point that it covers its
  // plane is between the corners.
  if (!(area > 0)) {
    const double da = heights_[a] - heights_[p], db = heights_[b] - heights_[p],
                 dc = heights_[c] - heights_[p];
    return std::max({da, db, dc}, [](double l, double r) { return std::abs(l) < std::abs(r); });
  }
  const double u = (x * cy - y * cx) / area, w = (bx * y - by * x) / area;
  return heights_[a] + u * (heights_[b] - heights_[a]) + w * (heights_[c] - heights_[a]) - heights_[p];
}

namespace {
// One hole at a time per thread: its points are gathered into a buffer that keeps its capacity.
thread_local std::vector<std::uint32_t> holePoints;
}  // namespace

PointError::Hole::Hole(PointError& errors, const Star& star, std::uint32_t apex)
    : errors_(errors), star_(star), polygon_(errors.plan_, apex, star.linkView()), points_(holePoints) {
  points_.assign(1, apex);
  for (int i = 0; i < star.triangleCount; ++i)
    for (std::uint32_t p = errors.head_[star.triangle(i)]; p != kNone; p = errors.next_[p])
      points_.push_back(p);
}

Vec3 PointError::Hole::fromApex(int i) const {
  const std::uint32_t apex = points_.front(), corner = star_.link[i];
  const PointPlan::Point o = errors_.plan_.point(apex), p = errors_.plan_.point(corner);
  return {p.x() - o.x(), p.y() - o.y(), errors_.heights_[corner] - errors_.heights_[apex]};
}

double PointError::Hole::apexError(int i, int j, int m) const {
  return std::abs(errors_.difference(star_.link[i], star_.link[j], star_.link[m], points_.front()));
}

double PointError::Hole::maximum(int i, int j, int m, double limit) const {
  const std::uint32_t a = star_.link[i], b = star_.link[j], c = star_.link[m];
  double worst = 0;
  for (const std::uint32_t p : points_) {
    // The difference is cheaper than the exact test: only a point that would raise the maximum is located.
    const double error = std::abs(errors_.difference(a, b, c, p));
    if (!(error > worst) || !errors_.covers(a, b, c, p)) continue;
    worst = error;
    if (worst > limit) break;
  }
  return worst;
}

double PointError::Hole::maximum(int i, int j, int m, double limit, SignedBound& bound) const {
  const std::uint32_t a = star_.link[i], b = star_.link[j], c = star_.link[m];
  double worst = 0;
  for (const std::uint32_t p : points_) {
    const double d = errors_.difference(a, b, c, p);
    if ((d <= bound.above && -d <= bound.below) || !errors_.covers(a, b, c, p)) continue;
    bound.include(d);
    worst = std::max(worst, std::abs(d));
    if (worst > limit) break;
  }
  return worst;
}

void PointError::Hole::settle(const HoleTriangulation& floor) {
  for (int t = 0; t < star_.triangleCount; ++t) errors_.head_[star_.triangle(t)] = kNone;
  for (const std::uint32_t p : points_)
    for (int f = 0; f < floor.size; ++f) {
      const auto& t = floor.triangles[f];
      if (!errors_.covers(star_.link[t[0]], star_.link[t[1]], star_.link[t[2]], p)) continue;
      std::uint32_t& head = errors_.head_[star_.triangle(f)];
      errors_.next_[p] = head;
      head = p;
      break;
    }
}

void PointError::compact(const SlotMap& newSlot) {
  std::vector<std::uint32_t> moved(newSlot.liveCount(), kNone);
  for (std::size_t t = 0; t < head_.size(); ++t)
    if (newSlot[t] != kNone) moved[newSlot[t]] = head_[t];
  head_ = std::move(moved);
}

SignedBound PointError::alongEdge(std::uint32_t a, std::uint32_t b) const {
  SignedBound bound;
  const Vec2 pa = plan_.planPosition(a), pb = plan_.planPosition(b);
  const double dx = pb.x - pa.x, dy = pb.y - pa.y, squared = dx * dx + dy * dy;
  const auto side = [&](std::uint32_t v) {
    const Vec2 p = plan_.planPosition(v);
    return dx * (p.y - pa.y) - dy * (p.x - pa.x);
  };
  const auto isAhead = [&](std::uint32_t from, std::uint32_t v) {
    const Vec2 p = plan_.planPosition(v), o = plan_.planPosition(from);
    return (p.x - o.x) * dx + (p.y - o.y) * dy > 0;
  };
  // A point on the segment travels with one of the two triangles at the edge; the bound of the other needs
  // it.
  const auto pass = [&](std::uint32_t v) {
    if (v == b) return;
    const Vec2 p = plan_.planPosition(v);
    const double t = std::clamp(((p.x - pa.x) * dx + (p.y - pa.y) * dy) / squared, 0.0, 1.0);
    bound.include(heights_[a] + t * (heights_[b] - heights_[a]) - heights_[v]);
  };
  const auto cross = [&](std::uint32_t u, std::uint32_t w) {
    const double su = std::abs(side(u)), sw = std::abs(side(w));
    if (su + sw == 0) return;
    const double s = su / (su + sw);
    const Vec2 p = plan_.planPosition(u), q = plan_.planPosition(w);
    const double x = p.x + s * (q.x - p.x), y = p.y + s * (q.y - p.y);
    const double t = std::clamp(((x - pa.x) * dx + (y - pa.y) * dy) / squared, 0.0, 1.0);
    bound.include(heights_[a] + t * (heights_[b] - heights_[a]) -
                  (heights_[u] + s * (heights_[w] - heights_[u])));
  };

  std::uint32_t at = a;
  while (at != b) {
    // Out of the vertex `at`: a neighbour on the segment, or the triangle whose far edge the segment crosses.
    std::uint32_t through = kNone, onward = kNone;
    const std::uint32_t first = finest_.vertexHalfedge[at];
    std::uint32_t h = first;
    do {
      const std::uint32_t far = LiveMesh::nextInTriangle(h);
      const std::uint32_t u = finest_.origin(far), w = finest_.origin(LiveMesh::nextInTriangle(far));
      const int ou = plan_.orientation(a, b, u), ow = plan_.orientation(a, b, w);
      if (ou == 0 && isAhead(at, u)) onward = u;
      if (ow == 0 && isAhead(at, w)) onward = w;
      // u before w counter-clockwise: the segment leaves between them when u is right of it and w left.
      if (ou < 0 && ow > 0) through = far;
      if (onward != kNone || through != kNone) break;
      h = finest_.twinOf(LiveMesh::previousInTriangle(h));
    } while (h != kNone && h != first);
    if (onward != kNone) {
      at = onward;
      pass(at);
      continue;
    }
    if (through == kNone) return bound;  // along the hull, within rounding of it: nothing is crossed
    for (std::uint32_t edge = through;;) {
      cross(finest_.origin(edge), finest_.origin(LiveMesh::nextInTriangle(edge)));
      const std::uint32_t across = finest_.twinOf(edge);
      if (across == kNone) return bound;
      const std::uint32_t apex = finest_.origin(LiveMesh::previousInTriangle(across));
      const int o = plan_.orientation(a, b, apex);
      if (o == 0) {
        at = apex;
        pass(at);
        break;
      }
      // `across` runs from the left end of the crossed edge to its right end; the apex replaces the end on
      // its own side.
      edge = o > 0 ? LiveMesh::nextInTriangle(across) : LiveMesh::previousInTriangle(across);
    }
  }
  return bound;
}

}  // namespace arete
