// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/region.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/multitriangulation.h"

namespace arete {
namespace {

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

constexpr std::size_t kMaxBands = 1 << 14;

}  // namespace

Region::Region(std::vector<std::vector<Vec2>> rings) : rings_(std::move(rings)) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  bounds_ = {kInfinity, kInfinity, -kInfinity, -kInfinity};
  std::erase_if(rings_, [](const auto& ring) { return ring.size() < 3; });
  for (const auto& ring : rings_)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[i + 1 < ring.size() ? i + 1 : 0];
      bounds_ = {std::min(bounds_.xMin, a.x), std::min(bounds_.yMin, a.y), std::max(bounds_.xMax, a.x),
                 std::max(bounds_.yMax, a.y)};
      if (a != b) edges_.push_back({a, b});
    }
  if (edges_.empty()) return;

  const std::size_t bands = std::clamp<std::size_t>(edges_.size(), 1, kMaxBands);
  bandHeight_ = std::max((bounds_.yMax - bounds_.yMin) / double(bands), std::numeric_limits<double>::min());
  const auto band = [&](double y) {
    return static_cast<std::size_t>(std::clamp((y - bounds_.yMin) / bandHeight_, 0.0, double(bands - 1)));
  };
  bandBegin_.assign(bands + 1, 0);
  for (const Edge& e : edges_)
    for (std::size_t i = band(std::min(e.a.y, e.b.y)); i <= band(std::max(e.a.y, e.b.y)); ++i)
      ++bandBegin_[i + 1];
  for (std::size_t i = 0; i < bands; ++i) bandBegin_[i + 1] += bandBegin_[i];
  bandEdges_.resize(bandBegin_[bands]);
  std::vector<std::uint32_t> at(bandBegin_.begin(), bandBegin_.end() - 1);
  for (std::uint32_t k = 0; k < edges_.size(); ++k) {
    const Edge& e = edges_[k];
    for (std::size_t i = band(std::min(e.a.y, e.b.y)); i <= band(std::max(e.a.y, e.b.y)); ++i)
      bandEdges_[at[i]++] = k;
  }
}

Region Region::box(const Box2& b) {
  return Region({{{b.xMin, b.yMin}, {b.xMax, b.yMin}, {b.xMax, b.yMax}, {b.xMin, b.yMax}}});
}

/// Calls visit(edge) for edges that touch the bands of [yLow, yHigh], some more than once; stops when it
/// returns true.
template <class Visit>
void Region::forEdgesBetween(double yLow, double yHigh, const Visit& visit) const {
  if (edges_.empty() || yHigh < bounds_.yMin || yLow > bounds_.yMax) return;
  const auto bands = static_cast<double>(bandBegin_.size() - 1);
  // One band more on either side covers the rounding of the division.
  const auto first =
      static_cast<std::size_t>(std::clamp((yLow - bounds_.yMin) / bandHeight_ - 1, 0.0, bands - 1));
  const auto last =
      static_cast<std::size_t>(std::clamp((yHigh - bounds_.yMin) / bandHeight_ + 1, 0.0, bands - 1));
  for (std::size_t i = bandBegin_[first]; i < bandBegin_[last + 1]; ++i)
    if (visit(edges_[bandEdges_[i]])) return;
}

bool Region::contains(Vec2 p) const {
  if (edges_.empty() || p.x < bounds_.xMin || p.x > bounds_.xMax || p.y < bounds_.yMin || p.y > bounds_.yMax)
    return false;
  const auto bands = static_cast<double>(bandBegin_.size() - 1);
  const auto band = static_cast<std::size_t>(std::clamp((p.y - bounds_.yMin) / bandHeight_, 0.0, bands - 1));
  bool inside = false;
  // An edge that crosses the height of p is listed in p's own band or, by rounding, in a neighbour: look at
  // the three and count each edge in the first of them that lists it.
  const std::size_t first = band > 0 ? band - 1 : 0, last = std::min(band + 1, bandBegin_.size() - 2);
  std::vector<std::uint32_t> seen;
  for (std::size_t i = first; i <= last; ++i)
    for (std::size_t k = bandBegin_[i]; k < bandBegin_[i + 1]; ++k) seen.push_back(bandEdges_[k]);
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  for (const std::uint32_t k : seen) {
    const Edge& e = edges_[k];
    const double side = cross(e.a, e.b, p);
    if (side == 0 && onSegment(e.a, e.b, p)) return true;
    if ((e.a.y > p.y) != (e.b.y > p.y) && (side > 0) == (e.b.y > e.a.y)) inside = !inside;
  }
  return inside;
}

bool Region::meetsTriangle(Vec2 a, Vec2 b, Vec2 c) const {
  const double xLow = std::min({a.x, b.x, c.x}), xHigh = std::max({a.x, b.x, c.x});
  const double yLow = std::min({a.y, b.y, c.y}), yHigh = std::max({a.y, b.y, c.y});
  if (edges_.empty() || xHigh < bounds_.xMin || xLow > bounds_.xMax || yHigh < bounds_.yMin ||
      yLow > bounds_.yMax)
    return false;
  const double turn = cross(a, b, c) < 0 ? -1 : 1;
  const auto inTriangle = [&](Vec2 p) {
    return turn * cross(a, b, p) >= 0 && turn * cross(b, c, p) >= 0 && turn * cross(c, a, p) >= 0;
  };
  bool meets = false;
  forEdgesBetween(yLow, yHigh, [&](const Edge& e) {
    if (std::max(e.a.x, e.b.x) < xLow || std::min(e.a.x, e.b.x) > xHigh) return false;
    meets = inTriangle(e.a) || segmentsMeet(e.a, e.b, a, b) || segmentsMeet(e.a, e.b, b, c) ||
            segmentsMeet(e.a, e.b, c, a);
    return meets;
  });
  return meets || contains(a);
}

bool Region::meetsDisc(Vec2 centre, double radius) const {
  const double r = radius * (1 + 1e-9);
  if (edges_.empty() || centre.x + r < bounds_.xMin || centre.x - r > bounds_.xMax ||
      centre.y + r < bounds_.yMin || centre.y - r > bounds_.yMax)
    return false;
  bool meets = false;
  forEdgesBetween(centre.y - r, centre.y + r, [&](const Edge& e) {
    meets = squaredDistance(centre, e.a, e.b) <= r * r;
    return meets;
  });
  return meets || contains(centre);
}

Region Region::scaled(const MetricFrame& metric) const {
  std::vector<std::vector<Vec2>> rings = rings_;
  for (auto& ring : rings)
    for (Vec2& p : ring) {
      const Vec3 q = metric.toMetric({p.x, p.y, 0});
      p = {q.x, q.y};
    }
  return Region(std::move(rings));
}

}  // namespace arete
