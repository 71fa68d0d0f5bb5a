// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ceiling of a node is the star of its apex and covers the same area as its floor. A point of the floor
// is therefore in the star, and the two spokes that it lies between determine its triangle: one orientation
// per spoke, and no test against the link. Two signs are enough although a line through the apex meets the
// star twice: the angle between two successive spokes is below 180 degrees, so a point left of or on the
// first and right of or on the second is not behind the apex.
//
// Where coarse triangles may cover NODATA, the star can be smaller than the floor, and the link is tested
// too. A point beyond the border by less than the margin is in no triangle; on every level the nearest one is
// taken.
#include "terrain/locate/triangle_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "terrain/model/plan_orientation.h"

namespace arete {
namespace {

/// a * b - c * d to within two units in the last place, Kahan's algorithm [JeannerodLouvetMuller2013].
double differenceOfProducts(double a, double b, double c, double d) {
  const double cd = c * d;
  const double rest = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + rest;
}

/// Twice the area of (p, a, b): exactly 0 where p is a or b.
double turn(Vec2 p, Vec2 a, Vec2 b) {
  return differenceOfProducts(a.x - p.x, b.y - p.y, a.y - p.y, b.x - p.x);
}

std::array<VertexId, 3> idsOf(const std::array<std::uint32_t, 3>& corners) {
  return {VertexId(corners[0]), VertexId(corners[1]), VertexId(corners[2])};
}

double distanceToSegment(Vec2 p, Vec2 a, Vec2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  const double along = squared > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / squared : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(p.x - (a.x + t * dx), p.y - (a.y + t * dy));
}

}  // namespace

TriangleLocator::TriangleLocator(MultiTriangulation mt, const LocatorOptions& options)
    : mt_(std::move(mt)),
      options_(options),
      perColumn_(1.0 / std::max(1u, mt_.vertices().columns)),
      roots_(mt_, options.margin) {}

double TriangleLocator::distance(const std::array<VertexId, 3>& corners, Vec2 p) const {
  const Vec2 a = planPosition(corners[0]), b = planPosition(corners[1]), c = planPosition(corners[2]);
  return std::min({distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
}

std::optional<LocatedTriangle> TriangleLocator::inRoot(Vec2 p) const {
  const std::span<const TriangleId> candidates = roots_.near(p);
  const auto& rootTriangles = mt_.rootTriangles();
  for (const TriangleId t : candidates) {
    const std::array<VertexId, 3> corners = idsOf(rootTriangles[t.index()]);
    const Vec2 a = planPosition(corners[0]), b = planPosition(corners[1]), c = planPosition(corners[2]);
    if (planOrientation(a, b, p) >= 0 && planOrientation(b, c, p) >= 0 && planOrientation(c, a, p) >= 0)
      return LocatedTriangle{t, corners};
  }
  std::optional<LocatedTriangle> nearest;
  double least = options_.margin;
  for (const TriangleId t : candidates) {
    const std::array<VertexId, 3> corners = idsOf(rootTriangles[t.index()]);
    if (const double d = distance(corners, p); d < least || (!nearest && d <= least)) {
      nearest = LocatedTriangle{t, corners, false};
      least = d;
    }
  }
  return nearest;
}

std::optional<LocatedTriangle> TriangleLocator::finer(const LocatedTriangle& t, Vec2 p) const {
  const NodeId n = mt_.remover(t.triangle);
  if (!t.isInside) return nearestOf(n, p, std::numeric_limits<double>::infinity());

  const VertexId apex = mt_.apex(n);
  const Vec2 centre = planPosition(apex);
  const std::span<const std::uint32_t> link = mt_.link(n);
  const std::uint32_t count = mt_.ceilingSize(n);
  Vec2 from = planPosition(VertexId(link[0]));
  const Vec2 first = from;
  int sign = planOrientation(centre, from, p);
  const int firstSign = sign;
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool closes = i + 1 == link.size();
    const Vec2 to = closes ? first : planPosition(VertexId(link[i + 1]));
    const int nextSign = closes ? firstSign : planOrientation(centre, to, p);
    if (sign >= 0 && nextSign <= 0 && (!options_.mayFill || planOrientation(from, to, p) >= 0))
      return LocatedTriangle{mt_.slotTriangle(n, i),
                             {apex, VertexId(link[i]), VertexId(link[closes ? 0 : i + 1])}};
    from = to;
    sign = nextSign;
  }
  return nearestOf(n, p, options_.margin);
}

std::optional<LocatedTriangle> TriangleLocator::nearestOf(NodeId n, Vec2 p, double within) const {
  // Over NODATA: the part of a coarse triangle that its finer ones do not cover is no terrain.
  if (options_.mayFill) within = std::min(within, options_.margin * (1 + 1e-6));
  std::optional<LocatedTriangle> nearest;
  const std::span<const std::uint32_t> link = mt_.link(n);
  for (std::uint32_t i = 0; i < mt_.ceilingSize(n); ++i) {
    const std::array corners = {mt_.apex(n), VertexId(link[i]),
                                VertexId(link[i + 1 < link.size() ? i + 1 : 0])};
    if (const double d = distance(corners, p); d < within || (!nearest && d <= within)) {
      nearest = LocatedTriangle{mt_.slotTriangle(n, i), corners, false};
      within = d;
    }
  }
  return nearest;
}

double TriangleLocator::interpolate(const std::array<VertexId, 3>& corners, Vec2 p) const {
  std::array<Vec2, 3> at;
  std::array<double, 3> z;
  for (int i = 0; i < 3; ++i) {
    at[i] = planPosition(corners[i]);
    z[i] = mt_.vertices().height(corners[i]);
  }
  // A negative weight comes from rounding, or from a point beyond an edge, which is moved onto the edge.
  std::array<double, 3> weight;
  for (int i = 0; i < 3; ++i) weight[i] = std::max(0.0, turn(p, at[(i + 1) % 3], at[(i + 2) % 3]));
  const double sum = weight[0] + weight[1] + weight[2];
  if (!(sum > 0)) return z[0];
  // Relative to the corner with the largest weight: at a vertex the result is its height to the bit.
  const int i = static_cast<int>(std::max_element(weight.begin(), weight.end()) - weight.begin());
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  return z[i] + (weight[j] / sum * (z[j] - z[i]) + weight[k] / sum * (z[k] - z[i]));
}

}  // namespace arete
