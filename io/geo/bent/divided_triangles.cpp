// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is turned until its split edges come first; then each number of split edges has one pattern.
#include "io/geo/bent/divided_triangles.h"

#include <algorithm>

namespace arete {

DividedTriangles divideTriangles(std::span<const ThreeIds> triangles, std::span<const ThreeIds> middles,
                                 std::span<const Vec3> positions) {
  DividedTriangles divided;
  divided.triangles.reserve(triangles.size());
  divided.parents.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto put = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      divided.triangles.push_back({a, b, c});
      divided.parents.push_back(t);
    };
    ThreeIds v = triangles[t], m = middles[t];
    const auto turn = [&] {
      std::ranges::rotate(v, v.begin() + 1);
      std::ranges::rotate(m, m.begin() + 1);
    };
    const auto count = 3 - std::ranges::count(m, kUnsplit);
    if (count == 0) {
      put(v[0], v[1], v[2]);
    } else if (count == 1) {
      while (m[0] == kUnsplit) turn();
      put(v[0], m[0], v[2]);
      put(m[0], v[1], v[2]);
    } else if (count == 2) {
      while (m[2] != kUnsplit) turn();
      put(m[0], v[1], m[1]);
      const double across = norm(positions[m[0]] - positions[v[2]]),
                   along = norm(positions[v[0]] - positions[m[1]]);
      if (across < along || (across == along && v[0] < v[2])) {
        put(v[0], m[0], v[2]);
        put(m[0], m[1], v[2]);
      } else {
        put(v[0], m[0], m[1]);
        put(v[0], m[1], v[2]);
      }
    } else {
      put(v[0], m[0], m[2]);
      put(m[0], v[1], m[1]);
      put(m[2], m[1], v[2]);
      put(m[0], m[1], m[2]);
    }
  }
  return divided;
}

}  // namespace arete
