// SPDX-License-Identifier: GPL-3.0-or-later
//
// A leg enters and leaves triangles at edges. Each vertex has a side of the leg and a parameter along it; an
// edge whose ends are on different sides is crossed at a parameter and height interpolated between them. Both
// triangles of an edge compute the same crossing, so their spans join except for rounding.
#include "terrain/sight/mt_crossing.h"

#include <algorithm>
#include <cmath>

namespace arete {

MtCrossing::MtCrossing(const TriangleLocator& locator, const SightLeg& leg)
    : locator_(locator),
      leg_(leg),
      perLength_(1 / (leg.dx * leg.dx + leg.dy * leg.dy)),
      shortest_(kShortestInPlan * std::sqrt(perLength_)) {}

MtCrossing::Projected MtCrossing::project(std::uint32_t vertex) const {
  const Vec2 p = locator_.planPosition(VertexId(vertex));
  const double x = p.x - leg_.x, y = p.y - leg_.y;
  // The sign of `side` says on which side the vertex lies; `along` is 0 at the beginning of the leg and 1 at
  // its end.
  return {leg_.dx * y - leg_.dy * x, (leg_.dx * x + leg_.dy * y) * perLength_,
          locator_.mt().vertices().height(VertexId(vertex))};
}

void MtCrossing::add(std::uint32_t triangle, const Projected& a, const Projected& b, const Projected& c,
                     double first, double last, std::vector<TriangleSpan>& spans) const {
  if ((a.side > 0 && b.side > 0 && c.side > 0) || (a.side < 0 && b.side < 0 && c.side < 0)) return;
  TriangleSpan span{HUGE_VAL, -HUGE_VAL, 0, 0, triangle};
  const auto meet = [&span](double t, double z) {
    if (t < span.t0) {
      span.t0 = t;
      span.z0 = z;
    }
    if (t > span.t1) {
      span.t1 = t;
      span.z1 = z;
    }
  };
  const auto cross = [&meet](const Projected& p, const Projected& q) {
    // A vertex on the leg counts by itself, so that no crossing is lost between two edges.
    if (p.side == 0) meet(p.along, p.z);
    if (!((p.side < 0 && q.side > 0) || (p.side > 0 && q.side < 0))) return;
    const double f = p.side / (p.side - q.side);
    meet(p.along + f * (q.along - p.along), p.z + f * (q.z - p.z));
  };
  cross(a, b);
  cross(b, c);
  cross(c, a);
  if (!(span.t0 < last && span.t1 > first)) return;
  span.cut(first, last);
  if (span.t1 > span.t0) spans.push_back(span);
}

void MtCrossing::addRoots(std::vector<TriangleSpan>& spans) const {
  std::vector<TriangleId> roots;
  locator_.roots().along({leg_.x, leg_.y}, {leg_.x + leg_.dx, leg_.y + leg_.dy}, roots);
  for (const TriangleId r : roots) {
    const auto& corners = locator_.mt().rootTriangles()[r.index()];
    add(r.index(), project(corners[0]), project(corners[1]), project(corners[2]), 0, 1, spans);
  }
}

void MtCrossing::addStar(std::uint32_t node, double first, double last,
                         std::vector<TriangleSpan>& spans) const {
  const MultiTriangulation& mt = locator_.mt();
  const NodeId n(node);
  const std::span<const std::uint32_t> link = mt.link(n);
  const std::uint32_t firstTriangle = mt.slotTriangle(n, 0).index();
  const auto slots = static_cast<std::uint32_t>(link.size());
  const Projected apex = project(mt.apex(n).index()), firstLink = project(link[0]);
  Projected p = firstLink;
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    const Projected q = slot + 1 < slots ? project(link[slot + 1]) : firstLink;
    // The last slot of an open star is not a triangle.
    if (slot + 1 < slots || !mt.isOpen(n)) add(firstTriangle + slot, apex, p, q, first, last, spans);
    p = q;
  }
}

void MtCrossing::sort(std::span<TriangleSpan> spans) {
  std::sort(spans.begin(), spans.end(), [](const TriangleSpan& p, const TriangleSpan& q) {
    return p.t0 != q.t0 ? p.t0 < q.t0 : p.t1 > q.t1;
  });
}

}  // namespace arete
