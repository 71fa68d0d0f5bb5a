// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/query/placed/samples.h"

namespace arete::placed {

std::vector<RimSide> rimOf(const TriangleMesh& mesh) {
  struct Side {
    std::uint32_t low, high;
    RimSide side;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), {t, a, b}});
    }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.side.triangle); });
  std::vector<RimSide> rim;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    if (end == i + 1) rim.push_back(sides[i].side);
    i = end;
  }
  return rim;
}

void coverBesideRim(std::vector<PlacedSample>& samples, std::span<const Vec2> places,
                    const std::vector<RimSide>& rim, std::span<const Vec2> plan, Vec2 reach, double turn,
                    double most, const SideSeen& seen) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (std::isnan(samples[i].tin) && !std::isnan(samples[i].height) && std::isfinite(places[i].x))
      open.push_back(i);
  std::ranges::sort(open, {}, [&](std::size_t i) { return std::pair(places[i].x, i); });
  std::vector<double> distance(open.size(), std::numeric_limits<double>::infinity());
  const auto visit = [&](const RimSide& side, double shift) {
    const Vec2 &a = plan[side.from], &b = plan[side.to];
    const double west = std::min(a.x, b.x) + shift, east = std::max(a.x, b.x) + shift;
    const double south = std::min(a.y, b.y), north = std::max(a.y, b.y);
    auto at = std::ranges::lower_bound(open, west - reach.x, {}, [&](std::size_t i) { return places[i].x; });
    for (; at != open.end() && places[*at].x <= east + reach.x; ++at) {
      const double y = places[*at].y;
      if (y < south - reach.y || y > north + reach.y) continue;
      const auto [p, q] = seen(*at, side);
      const Vec2 along{q.x - p.x, q.y - p.y};
      const double square = dot(along, along);
      const double part = square > 0 ? std::clamp(-(p.x * along.x + p.y * along.y) / square, 0.0, 1.0) : 0;
      const double far = std::hypot(p.x + part * along.x, p.y + part * along.y);
      const auto slot = std::size_t(at - open.begin());
      if (!(far <= most) || !(far < distance[slot])) continue;
      distance[slot] = far;
      samples[*at].tin = p.z + part * (q.z - p.z);
      samples[*at].triangle = side.triangle;
    }
  };
  for (const RimSide& side : rim) {
    visit(side, 0);
    if (turn > 0)
      for (const double shift : {-turn, turn}) visit(side, shift);
  }
}

}  // namespace arete::placed
