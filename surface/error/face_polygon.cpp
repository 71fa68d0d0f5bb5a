// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hulls by monotone chains [Andrew1979]. Coordinates have 30 bits, so cross products are exact in 64.
#include "surface/error/face_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace arete {
namespace {

std::int64_t crossOf(const FacePoint& o, const FacePoint& a, const FacePoint& b) {
  const auto du = std::int64_t{a.u} - o.u, dv = std::int64_t{a.v} - o.v;
  return du * (std::int64_t{b.v} - o.v) - dv * (std::int64_t{b.u} - o.u);
}

std::uint32_t between(std::uint32_t from, std::uint32_t to, double part) {
  return static_cast<std::uint32_t>(std::int64_t{from} +
                                    std::llround(part * double(std::int64_t{to} - std::int64_t{from})));
}

constexpr std::array<FacePoint, 3> kWholeFace{{{0, 0}, {FacePoint::kOne, 0}, {0, FacePoint::kOne}}};

}  // namespace

std::span<const FacePoint> wholeFace() {
  return kWholeFace;
}

bool isWholeFace(std::span<const FacePoint> polygon) {
  return polygon.size() == 3 && std::ranges::is_permutation(polygon, kWholeFace);
}

void takeConvexHull(FacePolygon& points) {
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return;
  FacePolygon hull(2 * points.size());
  std::size_t size = 0;
  const auto add = [&](const FacePoint& p, std::size_t least) {
    while (size >= least + 2 && crossOf(hull[size - 2], hull[size - 1], p) <= 0) --size;
    hull[size++] = p;
  };
  for (const FacePoint& p : points) add(p, 0);
  const std::size_t lower = size - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  hull.resize(size - 1);
  points.swap(hull);
}

std::int64_t twiceArea(std::span<const FacePoint> polygon) {
  std::int64_t sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) sum += crossOf(polygon[0], polygon[i], polygon[i + 1]);
  return sum;
}

void cut(std::span<const FacePoint> polygon, std::span<const double> heights, FacePolygon& below,
         FacePolygon& above) {
  below.clear();
  above.clear();
  const auto add = [](FacePolygon& part, const FacePoint& p) {
    if (part.empty() || part.back() != p) part.push_back(p);
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t j = i + 1 < polygon.size() ? i + 1 : 0;
    if (heights[i] <= 0) add(below, polygon[i]);
    if (heights[i] >= 0) add(above, polygon[i]);
    if ((heights[i] < 0) == (heights[j] < 0) || heights[i] == 0 || heights[j] == 0) continue;
    const double part = heights[i] / (heights[i] - heights[j]);
    const FacePoint p{between(polygon[i].u, polygon[j].u, part), between(polygon[i].v, polygon[j].v, part)};
    add(below, p);
    add(above, p);
  }
  for (FacePolygon* part : {&below, &above})
    if (part->size() > 1 && part->front() == part->back()) part->pop_back();
}

}  // namespace arete
