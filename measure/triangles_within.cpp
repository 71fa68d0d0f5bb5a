// SPDX-License-Identifier: GPL-3.0-or-later
//
// Halves of equal size along the longest side of the box of the middles, so the tree is balanced whatever the
// mesh is.
#include "measure/triangles_within.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace arete {
namespace {

double squaredToBox(const Box3& box, const Vec3& p) {
  const auto beyond = [](double low, double high, double at) { return std::max({low - at, at - high, 0.0}); };
  const Vec3 to{beyond(box.low.x, box.high.x, p.x), beyond(box.low.y, box.high.y, p.y),
                beyond(box.low.z, box.high.z, p.z)};
  return dot(to, to);
}

}  // namespace

TrianglesWithin::TrianglesWithin(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<Vec3> middles;
  middles.reserve(order_.size());
  for (std::uint32_t t = 0; t < order_.size(); ++t) {
    const SpaceTriangle s = at(t);
    middles.push_back((1.0 / 3) * (s[0] + s[1] + s[2]));
  }
  build(0, static_cast<std::uint32_t>(order_.size()), middles);
}

std::uint32_t TrianglesWithin::build(std::uint32_t begin, std::uint32_t end, std::span<const Vec3> middles) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  Node node{.begin = begin, .end = end};
  Box3 around = Box3::empty();
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Vec3& corner : at(order_[i])) node.box.include(corner);
    around.include(middles[order_[i]]);
  }
  nodes_.push_back(node);
  if (end - begin <= kInLeaf) return number;
  const Vec3 size = around.high - around.low;
  const auto key = [&](std::uint32_t t) {
    const Vec3& m = middles[t];
    return size.x >= size.y && size.x >= size.z ? m.x : size.y >= size.z ? m.y : m.z;
  };
  const std::uint32_t half = begin + (end - begin) / 2;
  std::ranges::nth_element(
      order_.begin() + begin, order_.begin() + half, order_.begin() + end,
      [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b) || (key(a) == key(b) && a < b); });
  build(begin, half, middles);
  const std::uint32_t second = build(half, end, middles);
  nodes_[number].second = second;
  return number;
}

bool TrianglesWithin::find(const Vec3& p, double distance, std::vector<Near>& found, std::size_t most) const {
  found.clear();
  const double squares = distance * distance;
  std::array<std::uint32_t, 64> open;
  std::size_t count = 1;
  open[0] = 0;
  while (count > 0) {
    const std::uint32_t number = open[--count];
    const Node& node = nodes_[number];
    // Boxes are a little larger than they need to be: what decides is the triangle.
    if (squaredToBox(node.box, p) > squares * (1 + 1e-12)) continue;
    if (node.second != 0) {
      open[count++] = node.second;
      open[count++] = number + 1;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const Vec3 nearest = nearestOnTriangle(p, at(order_[i]));
      const double squared = squaredDistance(p, nearest);
      if (squared > squares) continue;
      found.push_back({order_[i], nearest, squared});
      if (found.size() > most) return false;
    }
  }
  std::ranges::sort(found, {}, &Near::triangle);
  return true;
}

}  // namespace arete
